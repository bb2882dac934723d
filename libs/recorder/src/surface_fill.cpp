// Gaps between samples. Where the mesh is finer than the samples, most faces are empty by chance, and a map of them would
// show the sampling and not the light (Ruppert et al., "EMCA", VMV 2021, section 4.1).
#include "surface_fill.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace emca::detail {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// Samples that a face may lack, or have, by chance: exp(-3) = 5 % is the probability of none where three are expected.
constexpr double kByChance = 3;
constexpr int kRelaxations = 16;

/// Number of samples per area of the whole mesh.
double meanDensity(std::span<const float> counts, std::span<const float> areas) {
    double count = 0, area = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        count += double(counts[i]);
        area += double(areas[i]);
    }
    return area > 0 ? count / area : 0;
}

/// A few samples on a face that is much smaller than the place that a sample stands for. Not those without any area:
/// what arrives there is no chance, but an error of the scene or the renderer, and has no density.
bool isSliver(float count, float area, double density) {
    return count > 0 && area > 0 && double(count) <= kByChance && double(area) * density < 0.25;
}

}  // namespace

void fillMeans(const SurfaceNeighbours& neighbours, std::span<float> values, std::uint32_t channels) {
    const std::size_t faces = values.size() / channels;
    std::vector<std::uint32_t> filled, ring;
    std::vector<char> waiting(faces, 0);
    const auto known = [&](std::size_t face) { return !std::isnan(values[face * channels]); };
    const auto addRing = [&](std::size_t face) {
        for (const std::uint32_t other : neighbours.of(face))
            if (!known(other) && !waiting[other]) {
                waiting[other] = 1;
                ring.push_back(other);
            }
    };
    for (std::size_t face = 0; face < faces; ++face)
        if (known(face)) addRing(face);
    std::vector<float> fresh;
    /// Mean of the neighbours that are known; zero neighbours cannot happen.
    const auto mean = [&](std::uint32_t face, std::uint32_t channel) {
        double sum = 0, count = 0;
        for (const std::uint32_t other : neighbours.of(face))
            if (known(other)) {
                sum += double(values[std::size_t(other) * channels + channel]);
                ++count;
            }
        return static_cast<float>(sum / count);
    };
    const auto replace = [&](const std::vector<std::uint32_t>& which) {
        fresh.clear();
        for (const std::uint32_t face : which)
            for (std::uint32_t c = 0; c < channels; ++c) fresh.push_back(mean(face, c));
        // Together, so that nothing depends on the order of faces.
        for (std::size_t i = 0; i < which.size(); ++i)
            std::copy_n(&fresh[i * channels], channels, &values[std::size_t(which[i]) * channels]);
    };
    while (!ring.empty()) {
        const std::vector<std::uint32_t> current = std::exchange(ring, {});
        replace(current);
        filled.insert(filled.end(), current.begin(), current.end());
        for (const std::uint32_t face : current) addRing(face);
    }
    for (int i = 0; i < kRelaxations && !filled.empty(); ++i) replace(filled);
}

bool densitiesNeedFilling(std::span<const float> counts, std::span<const float> areas) {
    const double density = meanDensity(counts, areas);
    if (density <= 0) return false;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if ((counts[i] <= 0 && areas[i] > 0) || isSliver(counts[i], areas[i], density)) return true;
    return false;
}

namespace {

/// Faces that share what arrived on all of them.
struct Cluster {
    double sum = 0, count = 0, area = 0;
    double joined = 0;  ///< part of the area that was empty
};

/// The work of fillDensities().
class DensityFill {
  public:
    DensityFill(const SurfaceNeighbours& neighbours, std::span<double> sums, std::span<const float> counts,
                std::span<const float> areas)
        : neighbours_(neighbours), areas_(areas), density_(meanDensity(counts, areas)), clusters_(sums.size()),
          clusterOf_(sums.size(), kNone) {
        for (std::uint32_t face = 0; face < clusters_.size(); ++face) {
            if (counts[face] <= 0) continue;
            clusters_[face] = {sums[face], double(counts[face]), double(areas[face]), 0};
            clusterOf_[face] = face;
        }
    }

    /// Slivers, smallest first, hand what they got to their largest neighbour, unless that is as dense as they are: a
    /// single sample on almost no area would else outshine the whole map.
    void mergeSlivers() {
        std::vector<std::uint32_t> order;
        for (std::uint32_t face = 0; face < clusters_.size(); ++face)  // also empty ones, which may get something
            if (isSliver(1, areas_[face], density_)) order.push_back(face);
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return areas_[a] < areas_[b]; });
        for (const std::uint32_t face : order) {
            std::uint32_t target = face;
            for (const std::uint32_t other : neighbours_.of(face))
                if (areas_[other] > areas_[target]) target = other;
            Cluster& from = clusters_[face];
            if (target == face || !isSliver(static_cast<float>(from.count), areas_[face], density_)) continue;
            const std::uint32_t index = clusterOf_[target] == kNone ? target : root(target);
            Cluster& into = clusters_[index];
            if (from.area > 0 && into.count * from.area > 0.25 * into.area && into.area > 0) continue;
            if (clusterOf_[target] == kNone) into.area = double(areas_[target]);
            clusterOf_[target] = clusterOf_[target] == kNone ? target : clusterOf_[target];
            into.sum += from.sum;
            into.count += from.count;
            into.area += from.area;
            from = {};
            clusterOf_[face] = index;
        }
        for (std::uint32_t face = 0; face < clusters_.size(); ++face)
            if (clusterOf_[face] != kNone) clusterOf_[face] = root(face);
    }

    /// Empty faces join, ring by ring, the densest cluster beside them whose samples could as well have missed them.
    void joinEmpty() {
        std::vector<std::uint32_t> ring, next;
        std::vector<char> waiting(clusters_.size(), 0);
        const auto addRing = [&](std::uint32_t face, std::vector<std::uint32_t>& to) {
            for (const std::uint32_t other : neighbours_.of(face)) {
                if (clusterOf_[other] != kNone || waiting[other] || !(areas_[other] > 0)) continue;
                waiting[other] = 1;
                to.push_back(other);
            }
        };
        for (std::uint32_t face = 0; face < clusters_.size(); ++face)
            if (clusterOf_[face] != kNone) addRing(face, ring);
        for (; !ring.empty(); ring.swap(next)) {
            next.clear();
            for (const std::uint32_t face : ring) {
                waiting[face] = 0;  // if none takes it now, another may reach it later
                const std::uint32_t best = clusterFor(face);
                if (best == kNone) continue;
                clusters_[best].area += double(areas_[face]);
                clusters_[best].joined += double(areas_[face]);
                clusterOf_[face] = best;
                addRing(face, next);
            }
        }
    }

    void write(std::span<double> sums) const {
        for (std::size_t face = 0; face < sums.size(); ++face) {
            if (clusterOf_[face] == kNone) continue;
            const Cluster& cluster = clusters_[clusterOf_[face]];
            if (cluster.area > 0) sums[face] = cluster.sum * (double(areas_[face]) / cluster.area);
        }
    }

  private:
    std::uint32_t root(std::uint32_t face) const {
        while (clusterOf_[face] != face) face = clusterOf_[face];
        return face;
    }

    std::uint32_t clusterFor(std::uint32_t face) const {
        const double area = double(areas_[face]);
        std::uint32_t best = kNone;
        for (const std::uint32_t other : neighbours_.of(face)) {
            if (clusterOf_[other] == kNone) continue;
            const Cluster& cluster = clusters_[clusterOf_[other]];
            const bool chance = cluster.count * area <= kByChance * cluster.area &&
                                (cluster.joined + area) * density_ <= kByChance;
            if (chance && (best == kNone || cluster.count * clusters_[best].area > clusters_[best].count * cluster.area))
                best = clusterOf_[other];
        }
        return best;
    }

    const SurfaceNeighbours& neighbours_;
    std::span<const float> areas_;
    double density_;
    std::vector<Cluster> clusters_;          ///< by their first face
    std::vector<std::uint32_t> clusterOf_;   ///< per face
};

}  // namespace

void fillDensities(const SurfaceNeighbours& neighbours, std::span<double> sums, std::span<const float> counts,
                   std::span<const float> areas) {
    DensityFill fill(neighbours, sums, counts, areas);
    fill.mergeSlivers();
    fill.joinEmpty();
    fill.write(sums);
}

}  // namespace emca::detail
