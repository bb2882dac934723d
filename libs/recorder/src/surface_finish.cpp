// From the nodes of the subdivision to values per refined face.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "surface_fill.h"
#include "surface_store.h"

namespace emca::detail {
namespace {

/// How much an even distribution weighs against the samples below a divided face, in samples, when they decide how it is
/// shared out. Without it, the first sample below a face that has just divided would draw everything to its child.
constexpr double kEvenSharePart = 0.25;  // of samplesPerDivision

/// Doubles per node while it is shared out: points, then for each layer its count and its sums.
struct Columns {
    explicit Columns(const SurfaceStore& store) {
        for (const SurfaceLayerLayout& layer : store.layouts()) {
            first.push_back(width);
            channels.push_back(layer.channels);
            width += 1u + layer.channels;
        }
    }
    std::vector<std::uint32_t> first, channels;
    std::uint32_t width = 1;
};

/// Adds what a node holds to a row.
void addNode(const SurfaceStore& store, const SurfaceNode* node, double factor, double* row) {
    *row++ += double(store.points(node)) * factor;
    for (const SurfaceLayerLayout& layer : store.layouts()) {
        *row++ += double(store.count(node, layer)) * factor;
        for (int c = 0; c < layer.channels; ++c) *row++ += store.sums(node, layer)[c] * factor;
    }
}

/// Exact counts and totals of the layers, over all nodes.
struct Totals {
    std::vector<std::uint64_t> counts;
    std::vector<double> sums;

    explicit Totals(std::size_t layers) : counts(layers, 0), sums(layers, 0) {}
    void add(const SurfaceStore& store, const SurfaceNode* node) {
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const SurfaceLayerLayout& layer = store.layouts()[i];
            counts[i] += store.count(node, layer);
            const double* s = store.sums(node, layer);
            sums[i] += layer.channels == 1 ? s[0] : 0.2126 * s[0] + 0.7152 * s[1] + 0.0722 * s[2];
        }
    }
};

/// What each face without storage gets of the bin that it shares: its part of their area.
class BinShares {
  public:
    explicit BinShares(const SurfaceStore& store) : store_(store) {}

    /// The bin with samples that a face takes part in, or null.
    const SurfaceNode* bin(std::uint32_t face) {
        const SurfaceNode* found = store_.bin(face);
        return found != nullptr && !store_.root(face) ? found : nullptr;
    }
    double share(std::uint32_t face) {
        if (store_.run(face) != run_) measure(face);
        return area_ > 0 ? areaOf(face) / area_ : 1.0 / double(faces_);
    }

  private:
    double areaOf(std::uint64_t face) const {
        const std::uint32_t mesh = store_.meshOf(static_cast<std::uint32_t>(face));
        return store_.area(mesh, static_cast<std::uint32_t>(face - store_.faceStarts()[mesh]));
    }
    void measure(std::uint32_t face) {
        run_ = store_.run(face);
        area_ = 0;
        faces_ = 0;
        const std::uint64_t end = std::min((run_ + 1) * store_.facesPerRun(), store_.faceStarts().back());
        for (std::uint64_t f = run_ * store_.facesPerRun(); f < end; ++f) {
            if (store_.root(static_cast<std::uint32_t>(f))) continue;
            area_ += areaOf(f);
            ++faces_;
        }
    }

    const SurfaceStore& store_;
    std::uint64_t run_ = ~std::uint64_t(0), faces_ = 0;
    double area_ = 0;
};

/// The refined faces of one mesh while they are made.
struct Leaves {
    SurfaceSubdivision subdivision;
    std::uint64_t bits = 0;
    bool divided = false, sampled = false;
    std::vector<double> rows;    ///< Columns::width per face
    std::vector<float> areas;

    void bit(bool value) {
        if (bits % 8 == 0) subdivision.bits.push_back(0);
        if (value) subdivision.bits.back() = static_cast<std::uint8_t>(subdivision.bits.back() | 1u << (bits % 8));
        ++bits;
        divided |= value;
    }
};

/// Hands the data of divided faces down. Two walks over a tree: the first adds up what is below each divided triangle,
/// the second shares out. Only rows of divided triangles are kept, a quarter of all, so that most of the time goes into
/// reading the nodes.
class TreeWalk {
  public:
    TreeWalk(const SurfaceStore& store, const Columns& columns, Totals& totals)
        : store_(store), columns_(columns), totals_(totals), width_(columns.width),
          even_(kEvenSharePart * double(store.options().samplesPerDivision)),
          shares_(std::size_t(kMaxSurfaceLevel + 1) * 8 * width_) {}

    /// A face that was divided or not, of so much area.
    void walk(SurfaceRef root, double area, Leaves& leaves) {
        below_.clear();
        inner_.clear();
        row_.assign(width_, 0.0);
        addNode(store_, root.own(store_.nodeBytes()), 1, row_.data());
        if (root.isDivided()) {
            sumUp(root);
        } else {
            totals_.add(store_, root.node());
        }
        next_ = 0;
        handDown(root, row_.data(), area, 0, leaves);
    }

  private:
    /// All that the children lead to, before the first of them is looked at.
    void prefetchChildren(SurfaceRef ref) const {
        if (ref.kind() != SurfaceRef::inner) return;  // its children were fetched with it
        for (std::uint32_t k = 0; k < 4; ++k) {
            const SurfaceRef child = ref.children()[k];
            const auto* bytes = reinterpret_cast<const std::byte*>(child.node());
            const std::size_t size = child.kind() == SurfaceRef::leaves  ? 4 * store_.nodeBytes()
                                     : child.kind() == SurfaceRef::inner ? 4 * sizeof(SurfaceRef)
                                                                         : store_.nodeBytes();
            for (std::size_t line = 0; line < size; line += 64) __builtin_prefetch(bytes + line);
        }
    }

    /// A divided triangle: appends to `below_` what its children and all below them hold. Returns the place of its row.
    std::size_t sumUp(SurfaceRef ref) {
        const std::size_t index = inner_.size();
        inner_.push_back(0);
        below_.resize(below_.size() + width_);
        totals_.add(store_, ref.own(store_.nodeBytes()));
        prefetchChildren(ref);
        for (std::uint32_t k = 0; k < 4; ++k) {
            const SurfaceRef child = ref.child(k, store_.nodeBytes());
            if (child.isDivided()) {
                const std::size_t of = sumUp(child);
                addNode(store_, child.own(store_.nodeBytes()), 1, &below_[index * width_]);
                for (std::uint32_t c = 0; c < width_; ++c) below_[index * width_ + c] += below_[of * width_ + c];
            } else {
                totals_.add(store_, child.node());
                addNode(store_, child.node(), 1, &below_[index * width_]);
            }
        }
        inner_[index] = static_cast<std::uint32_t>(inner_.size());  // the first one behind its subtree
        return index;
    }

    /// `row`: what a triangle holds and has inherited.
    void handDown(SurfaceRef ref, const double* row, double area, std::uint32_t level, Leaves& leaves) {
        if (level < kMaxSurfaceLevel) leaves.bit(ref.isDivided());
        if (!ref.isDivided()) {
            leaves.areas.push_back(static_cast<float>(std::ldexp(area, -2 * static_cast<int>(level))));
            leaves.rows.insert(leaves.rows.end(), row, row + width_);
            return;
        }
        ++next_;  // the row of this triangle in below_
        double* held = &shares_[std::size_t(level) * 8 * width_];  // per child: its own and all below it
        double* given = held + 4 * width_;                         // per child: its own and its share
        prefetchChildren(ref);
        std::fill(held, held + 8 * width_, 0.0);
        std::size_t at = next_;
        for (std::uint32_t k = 0; k < 4; ++k) {
            const SurfaceRef child = ref.child(k, store_.nodeBytes());
            addNode(store_, child.own(store_.nodeBytes()), 1, held + k * width_);
            std::copy_n(held + k * width_, width_, given + k * width_);
            if (!child.isDivided()) continue;
            for (std::uint32_t c = 0; c < width_; ++c) held[k * width_ + c] += below_[at * width_ + c];
            at = inner_[at];
        }
        share(row, held, given);
        for (std::uint32_t k = 0; k < 4; ++k)
            handDown(ref.child(k, store_.nodeBytes()), given + k * width_, area, level + 1, leaves);
    }

    /// By the density of the samples below; a layer that has few is led by the points, and these by area.
    void share(const double* row, const double* held, double* given) const {
        double points[4], pointSum = 0;
        for (int k = 0; k < 4; ++k) pointSum += points[k] = held[k * width_];
        for (double& p : points) p = (p + even_ / 4) / (pointSum + even_);
        for (int k = 0; k < 4; ++k) given[k * width_] += row[0] * points[k];
        for (std::size_t layer = 0; layer < columns_.first.size(); ++layer) {
            const std::uint32_t first = columns_.first[layer];
            double sum = 0;
            for (int k = 0; k < 4; ++k) sum += held[k * width_ + first];
            for (int k = 0; k < 4; ++k) {
                const double part = (held[k * width_ + first] + even_ * points[k]) / (sum + even_);
                double* to = given + k * width_ + first;
                for (std::uint32_t c = 0; c <= columns_.channels[layer]; ++c) to[c] += row[first + c] * part;
            }
        }
    }

    const SurfaceStore& store_;
    const Columns& columns_;
    Totals& totals_;
    std::size_t width_;
    double even_;
    std::vector<double> below_;         ///< a row per divided triangle, in pre-order
    std::vector<std::uint32_t> inner_;  ///< per divided triangle: the first one that is not below it
    std::vector<double> shares_, row_;
    std::size_t next_ = 0;
};

/// All refined faces of a mesh.
Leaves leavesOf(const SurfaceStore& store, std::uint32_t mesh, std::uint32_t width, TreeWalk& trees, BinShares& bins) {
    Leaves leaves;
    const std::uint64_t first = store.faceStarts()[mesh], end = std::min(store.faceStarts()[mesh + 1], std::uint64_t(1) << 32);
    const auto isSampled = [&](std::uint64_t f) {
        const auto face = static_cast<std::uint32_t>(f);
        return store.root(face) || bins.bin(face);
    };
    std::uint64_t begin = first;
    while (begin < end && !isSampled(begin)) ++begin;
    if (begin == end) return leaves;  // nothing is kept of a mesh that was never sampled
    leaves.sampled = true;
    leaves.areas.reserve(end - first);
    leaves.rows.reserve((end - first) * width);
    for (std::uint64_t f = first; f < end; ++f) {
        const auto face = static_cast<std::uint32_t>(f);
        const double area = store.area(mesh, static_cast<std::uint32_t>(f - first));
        constexpr std::uint64_t kAhead = 12;
        if (f + kAhead < end)
            if (const SurfaceRef soon = store.root(static_cast<std::uint32_t>(f + kAhead)); soon)
                for (std::uint32_t i = 0; i < 4; ++i) __builtin_prefetch(soon.end(i, store.nodeBytes()));
        if (const SurfaceRef root = store.root(face); root) {
            trees.walk(root, area, leaves);
            continue;
        }
        leaves.bit(false);
        leaves.areas.push_back(static_cast<float>(area));
        leaves.rows.resize(leaves.rows.size() + width);
        if (const SurfaceNode* bin = bins.bin(face))
            addNode(store, bin, bins.share(face), &leaves.rows[leaves.rows.size() - width]);
    }
    if (!leaves.divided) leaves.subdivision.bits.clear();
    return leaves;
}

/// The neighbours of a mesh, made when the first layer needs them.
class LazyNeighbours {
  public:
    LazyNeighbours(const SurfaceMeshView& mesh, const Leaves& leaves) : mesh_(mesh), leaves_(leaves) {}
    const SurfaceNeighbours& get() {
        if (!neighbours_) neighbours_.emplace(mesh_, leaves_.subdivision, leaves_.areas.size());
        return *neighbours_;
    }

  private:
    const SurfaceMeshView& mesh_;
    const Leaves& leaves_;
    std::optional<SurfaceNeighbours> neighbours_;
};

void appendMeans(const Leaves& leaves, std::uint32_t width, std::uint32_t first, std::uint32_t channels,
                 LazyNeighbours& neighbours, std::vector<float>& values) {
    const std::size_t begin = values.size();
    values.reserve(begin + leaves.areas.size() * channels);
    bool gaps = false;
    for (std::size_t face = 0; face < leaves.areas.size(); ++face) {
        const double* row = &leaves.rows[face * width + first];
        gaps |= !(row[0] > 0);
        for (std::uint32_t c = 0; c < channels; ++c)
            values.push_back(row[0] > 0 ? static_cast<float>(row[1 + c] / row[0]) : std::numeric_limits<float>::quiet_NaN());
    }
    if (gaps) fillMeans(neighbours.get(), std::span(values).subspan(begin), channels);
}

void appendDensities(const Leaves& leaves, std::uint32_t width, std::uint32_t first, LazyNeighbours& neighbours,
                     std::vector<float>& values) {
    std::vector<double> sums;
    std::vector<float> counts;
    sums.reserve(leaves.areas.size());
    counts.reserve(leaves.areas.size());
    values.reserve(values.size() + leaves.areas.size());
    for (std::size_t face = 0; face < leaves.areas.size(); ++face) {
        counts.push_back(static_cast<float>(leaves.rows[face * width + first]));
        sums.push_back(leaves.rows[face * width + first + 1]);
    }
    if (densitiesNeedFilling(counts, leaves.areas)) fillDensities(neighbours.get(), sums, counts, leaves.areas);
    for (std::size_t face = 0; face < sums.size(); ++face)
        values.push_back(leaves.areas[face] > 0 ? static_cast<float>(sums[face] / double(leaves.areas[face]))
                                                : std::numeric_limits<float>::quiet_NaN());
}

void appendSums(const Leaves& leaves, std::uint32_t width, std::uint32_t first, std::vector<float>& values) {
    for (std::size_t face = 0; face < leaves.areas.size(); ++face)
        values.push_back(static_cast<float>(leaves.rows[face * width + first + 1]));
}

}  // namespace

SurfaceField makeField(const SurfaceStore& store) {
    SurfaceField field;
    field.meshes.resize(store.meshes().size());
    const auto& descriptions = store.descriptions();
    const Columns columns(store);
    Totals totals(descriptions.size());
    std::vector<std::vector<float>> values(descriptions.size());
    std::vector<float> points;
    TreeWalk trees(store, columns, totals);
    BinShares bins(store);
    std::uint64_t next = 0;
    for (std::uint32_t mesh = 0; mesh < field.meshes.size(); ++mesh) {
        field.meshes[mesh].firstFace = next;
        if (!store.isSetUp()) continue;
        Leaves leaves = leavesOf(store, mesh, columns.width, trees, bins);
        if (!leaves.sampled) continue;
        LazyNeighbours neighbours(store.meshes()[mesh], leaves);
        for (std::size_t i = 0; i < descriptions.size(); ++i) {
            const std::uint32_t first = columns.first[i];
            switch (descriptions[i].kind) {
                case LayerKind::mean:
                case LayerKind::meanColor:
                    appendMeans(leaves, columns.width, first, columns.channels[i], neighbours, values[i]);
                    break;
                case LayerKind::sum: appendSums(leaves, columns.width, first, values[i]); break;
                case LayerKind::density: appendDensities(leaves, columns.width, first, neighbours, values[i]); break;
            }
        }
        points.reserve(points.size() + leaves.areas.size());
        for (std::size_t face = 0; face < leaves.areas.size(); ++face)
            points.push_back(static_cast<float>(leaves.rows[face * columns.width]));
        field.meshes[mesh].faceCount = static_cast<std::uint32_t>(leaves.areas.size());
        next += leaves.areas.size();
        field.meshes[mesh].subdivision = std::move(leaves.subdivision);
    }
    for (std::uint64_t run = 0; run < store.runCount(); ++run)
        if (const SurfaceNode* bin = store.binOfRun(run)) totals.add(store, bin);
    for (std::size_t i = 0; i < descriptions.size(); ++i)
        field.layers.push_back({descriptions[i], std::move(values[i]), totals.counts[i], totals.sums[i]});
    field.points = std::move(points);
    field.counts = store.counts();
    return field;
}

}  // namespace emca::detail
