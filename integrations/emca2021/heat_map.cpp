#include "heat_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace emca::bridge {

const LayerDescription& heatMapColors() {
    static const LayerDescription layer{"published heat map", LayerKind::meanColor, "",
                                        "What the published server collected, as the colours that it sends; 0 also where it has no data."};
    return layer;
}

const LayerDescription& heatMapNumbers() {
    static const LayerDescription layer{"published heat map (number)", LayerKind::mean, "",
                                        "What the published server collected: the value where red, green and blue are equal, else their luminance."};
    return layer;
}

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A position by its bits; 0 and -0 are one.
using Place = std::array<std::uint32_t, 3>;
Place place(Vec3f p) {
    return {std::bit_cast<std::uint32_t>(p.x + 0.f), std::bit_cast<std::uint32_t>(p.y + 0.f), std::bit_cast<std::uint32_t>(p.z + 0.f)};
}

struct PlaceHash {
    std::size_t operator()(const Place& p) const { return (p[0] * std::size_t(0x9e3779b1) ^ p[1]) * std::size_t(0x85ebca77c2b2ae63) ^ p[2]; }
};

using Corners = std::array<Vec3f, 3>;
/// A triangle by its corners, whichever comes first and whichever way it turns.
using Key = std::array<Place, 3>;
Key key(const Corners& corners) {
    Key k{place(corners[0]), place(corners[1]), place(corners[2])};
    std::sort(k.begin(), k.end());
    return k;
}
struct KeyHash {
    std::size_t operator()(const Key& k) const {
        const PlaceHash hash;
        return (hash(k[0]) * 31 + hash(k[1])) * 31 + hash(k[2]);
    }
};

Vec3f midpoint(Vec3f a, Vec3f b) { return {(a.x + b.x) * 0.5f, (a.y + b.y) * 0.5f, (a.z + b.z) * 0.5f}; }

/// The triangles of one shape of a heat map, to be taken one by one.
class Faces {
  public:
    explicit Faces(const PublishedShape& shape) : shape_(shape) {
        for (const Vec3f& p : shape.positions) places_.insert(place(p));
        for (std::uint32_t i = static_cast<std::uint32_t>(shape.triangles.size()); i-- > 0;) {
            if (const auto corners = at(i)) found_[key(*corners)].push_back(i);
        }
    }

    /// The colour of the triangle with these corners; where several coincide, each is given once, in their order.
    std::optional<Color> take(const Corners& corners) {
        const auto here = found_.find(key(corners));
        if (here == found_.end() || here->second.empty()) return std::nullopt;
        const std::uint32_t face = here->second.back();
        here->second.pop_back();
        return shape_.faceColors[face];
    }
    bool has(Vec3f p) const { return places_.contains(place(p)); }

  private:
    std::optional<Corners> at(std::uint32_t face) const {
        const Triangle& t = shape_.triangles[face];
        const std::size_t n = shape_.positions.size();
        if (t[0] >= n || t[1] >= n || t[2] >= n) return std::nullopt;
        return Corners{shape_.positions[t[0]], shape_.positions[t[1]], shape_.positions[t[2]]};
    }

    const PublishedShape& shape_;
    std::unordered_set<Place, PlaceHash> places_;
    std::unordered_map<Key, std::vector<std::uint32_t>, KeyHash> found_;
};

/// The subdivision of one mesh, and the colours of its faces in that order.
class Tree {
  public:
    explicit Tree(Faces& faces) : faces_(faces) {}

    /// One triangle of the scene. \return false if the heat map does not have it: it stays whole, without a value
    bool add(const Corners& corners) {
        const std::size_t bits = bits_, colors = colors_.size();
        if (walk(corners, 0)) return true;
        bits_ = bits;
        bytes_.resize((bits + 7) / 8);
        if (bits % 8 != 0) bytes_.back() &= static_cast<std::uint8_t>((1u << bits % 8) - 1);
        colors_.resize(colors);
        leaf(Color(kNaN));
        return false;
    }

    const std::vector<Color>& colors() const { return colors_; }
    SurfaceSubdivision subdivision() const { return divided_ ? SurfaceSubdivision{bytes_} : SurfaceSubdivision{}; }

  private:
    bool walk(const Corners& c, std::uint32_t level) {
        if (const auto color = faces_.take(c)) {
            leaf(*color, level);
            return true;
        }
        const Vec3f m01 = midpoint(c[0], c[1]), m12 = midpoint(c[1], c[2]), m20 = midpoint(c[2], c[0]);
        if (level == kMaxSurfaceLevel || !faces_.has(m01) || !faces_.has(m12) || !faces_.has(m20)) return false;
        bit(true);
        divided_ = true;
        return walk({c[0], m01, m20}, level + 1) && walk({m01, c[1], m12}, level + 1) && walk({m20, m12, c[2]}, level + 1) &&
               walk({m12, m20, m01}, level + 1);
    }
    void leaf(Color color, std::uint32_t level = 0) {
        if (level < kMaxSurfaceLevel) bit(false);
        colors_.push_back(color);
    }
    void bit(bool value) {
        if (bits_ % 8 == 0) bytes_.push_back(0);
        if (value) bytes_.back() |= static_cast<std::uint8_t>(1u << bits_ % 8);
        ++bits_;
    }

    Faces& faces_;
    std::vector<std::uint8_t> bytes_;
    std::size_t bits_ = 0;
    std::vector<Color> colors_;
    bool divided_ = false;
};

float number(Color c) { return c.r == c.g && c.g == c.b ? c.r : luminance(c); }

SurfaceLayerData layer(const LayerDescription& description, const std::vector<Color>& colors) {
    SurfaceLayerData data;
    data.description = description;
    std::vector<float> values;
    for (const Color& c : colors) {
        const float one = number(c);
        if (channelCount(description.kind) == 3) {
            values.insert(values.end(), {c.r, c.g, c.b});
        } else {
            values.push_back(one);
        }
        if (std::isfinite(one)) {
            ++data.samples;
            data.total += double(one);
        }
    }
    data.values = SharedArray<float>(std::move(values));
    return data;
}

}  // namespace

HeatMap heatMapOn(std::span<const Mesh> meshes, std::span<const PublishedShape> shapes, std::span<const LayerDescription> layers) {
    HeatMap map;
    std::vector<Color> colors;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        SurfaceMesh part;
        part.firstFace = colors.size();
        if (m < shapes.size() && !shapes[m].faceColors.empty()) {
            map.faces += shapes[m].faceColors.size();
            Faces faces(shapes[m]);
            Tree tree(faces);
            const auto& p = meshes[m].positions;
            for (const Triangle& t : meshes[m].triangles) {
                if (!tree.add({p[t[0]], p[t[1]], p[t[2]]})) ++map.without;
            }
            colors.insert(colors.end(), tree.colors().begin(), tree.colors().end());
            part.subdivision = tree.subdivision();
            part.faceCount = static_cast<std::uint32_t>(tree.colors().size());
        }
        map.field.meshes.push_back(std::move(part));
    }
    std::vector<float> points;
    for (const Color& c : colors) points.push_back(isFinite(c) ? 1.f : 0.f);
    // The wire does not say how many samples a face got: each that has a value counts as one.
    map.field.counts.points = static_cast<std::uint64_t>(std::count(points.begin(), points.end(), 1.f));
    map.field.points = SharedArray<float>(std::move(points));
    map.field.counts.bytesUsed = map.field.points.size() * sizeof(float);
    for (const LayerDescription& description : layers) {
        map.field.layers.push_back(layer(description, colors));
        map.field.counts.bytesUsed += map.field.layers.back().values.size() * sizeof(float);
    }
    return map;
}

}  // namespace emca::bridge
