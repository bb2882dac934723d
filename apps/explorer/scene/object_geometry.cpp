#include "object_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace emca::explorer {
namespace {

bool finite(const ObjectBox& b) { return isFinite(b.centre) && isFinite(b.x) && isFinite(b.y) && isFinite(b.z); }

Vec3f corner(const ObjectBox& b, int i) {
    return b.centre + b.x * (i & 1 ? 1.f : -1.f) + b.y * (i & 2 ? 1.f : -1.f) + b.z * (i & 4 ? 1.f : -1.f);
}

QColor inkOf(analysis::Color8 c) { return {c.r, c.g, c.b, c.a}; }

analysis::Color8 faded(analysis::Color8 c, float opacity) {
    c.a = static_cast<std::uint8_t>(std::lround(float(c.a) * std::clamp(opacity, 0.f, 1.f)));
    return c;
}

void addTriangle(ColoredTriangles& out, Vec3f a, Vec3f b, Vec3f c, analysis::Color8 color) {
    out.positions.insert(out.positions.end(), {a, b, c});
    out.colors.push_back(color);
    out.translucent = out.translucent || color.a < 255;
}

void addQuad(ColoredTriangles& out, Vec3f a, Vec3f b, Vec3f c, Vec3f d, analysis::Color8 color) {
    addTriangle(out, a, b, c, color);
    addTriangle(out, a, c, d, color);
}

/// Corners of the six sides, seen from outside counterclockwise.
constexpr int kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

/// Every how many elements one is drawn.
std::size_t strideFor(std::size_t elements, std::size_t strokesEach) {
    return std::max<std::size_t>(1, (elements * strokesEach + kMaximumStrokes - 1) / kMaximumStrokes);
}

class Builder {
  public:
    explicit Builder(const SceneObject& object) : object_(object), colors_(colorsOf(object)) {}

    void operator()(const PointSet& set) {
        each(set.points.size(), 1, [&](std::size_t i) {
            out.strokes.push_back({set.points[i], set.points[i], set.size, StrokeStyle::dot, ink(i)});
        });
    }
    void operator()(const ArrowSet& set) {
        each(set.arrows.size(), 2, [&](std::size_t i) {
            const ObjectArrow& a = set.arrows[i];
            out.strokes.push_back({a.from, a.to, set.lineWidth, StrokeStyle::line, ink(i)});
            if (set.heads) out.strokes.push_back({a.from, a.to, 4 * set.lineWidth, StrokeStyle::head, ink(i)});
        });
    }
    void operator()(const BoxSet& set) {
        each(set.boxes.size(), 12, [&](std::size_t i) {
            if (!finite(set.boxes[i])) return;
            for (const Edge& e : edgesOf(set.boxes[i])) out.strokes.push_back({e.from, e.to, set.lineWidth, StrokeStyle::line, ink(i)});
        });
        if (!(set.filled > 0)) return;
        for (std::size_t i = 0; i < set.boxes.size(); ++i) {
            if (!finite(set.boxes[i])) continue;
            const analysis::Color8 color = faded(colors_[i], set.filled * object_.opacity);
            for (const auto& s : kSides)
                addQuad(out.triangles, corner(set.boxes[i], s[0]), corner(set.boxes[i], s[1]), corner(set.boxes[i], s[2]),
                        corner(set.boxes[i], s[3]), color);
        }
    }
    void operator()(const TriangleSet& set) {
        for (std::size_t i = 0; i < set.triangles.size(); ++i) {
            const Triangle& t = set.triangles[i];
            const Vec3f a = set.positions[t[0]], b = set.positions[t[1]], c = set.positions[t[2]];
            if (isFinite(a) && isFinite(b) && isFinite(c)) addTriangle(out.triangles, a, b, c, faded(colors_[i], object_.opacity));
        }
    }
    void operator()(const VoxelGrid& grid) {
        const auto [nx, ny, nz] = grid.size;
        const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return (std::size_t(z) * ny + y) * nx + x; };
        const auto shown = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
            return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz &&
                   isShown(grid, object_.colors.values[at(std::uint32_t(x), std::uint32_t(y), std::uint32_t(z))]);
        };
        constexpr int kTo[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
        for (std::uint32_t z = 0; z < nz; ++z)
            for (std::uint32_t y = 0; y < ny; ++y)
                for (std::uint32_t x = 0; x < nx; ++x) {
                    if (!shown(x, y, z)) continue;
                    const Vec3f low = grid.origin + Vec3f{grid.cell.x * float(x), grid.cell.y * float(y), grid.cell.z * float(z)};
                    const ObjectBox box = ObjectBox::between(low, low + grid.cell);
                    const analysis::Color8 color = faded(colors_[at(x, y, z)], object_.opacity);
                    for (int s = 0; s < 6; ++s) {
                        if (shown(std::int64_t(x) + kTo[s][0], std::int64_t(y) + kTo[s][1], std::int64_t(z) + kTo[s][2])) continue;
                        addQuad(out.triangles, corner(box, kSides[s][0]), corner(box, kSides[s][1]), corner(box, kSides[s][2]),
                                corner(box, kSides[s][3]), color);
                    }
                }
    }

    ObjectGeometry out;

  private:
    QColor ink(std::size_t i) const { return inkOf(faded(colors_[i], object_.opacity)); }

    template <typename Add>
    void each(std::size_t count, std::size_t strokesEach, Add add) {
        const std::size_t stride = strideFor(count, strokesEach);
        for (std::size_t i = 0; i < count; i += stride) add(i);
        out.leftOut = count - (count + stride - 1) / stride;
    }

    const SceneObject& object_;
    std::vector<analysis::Color8> colors_;
};

}  // namespace

std::vector<Edge> edgesOf(const ObjectBox& box) {
    std::vector<Edge> edges;
    for (int i = 0; i < 8; ++i)
        for (const int axis : {1, 2, 4})
            if (!(i & axis)) edges.push_back({corner(box, i), corner(box, i | axis)});
    return edges;
}

bool isShown(const VoxelGrid& grid, float value) { return double(value) >= grid.shownFrom && double(value) <= grid.shownTo; }

ObjectGeometry geometryOf(const SceneObject& object) {
    Builder builder(object);
    std::visit([&](const auto& shape) { builder(shape); }, object.shape);
    return std::move(builder.out);
}

}  // namespace emca::explorer
