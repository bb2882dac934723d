#include "match_keeper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace emca {

namespace {

/// Of a path for "brightest": luminance, NaN above everything.
float brightness(const PathSet& paths, Index path) {
    const float value = luminance(paths.estimate(path).value_or(Color(0.f)));
    return std::isnan(value) ? std::numeric_limits<float>::infinity() : value;
}

/// The brightest `count` of some paths, in their own order. Of equal ones the first are taken.
std::vector<Index> brightest(const PathSet& paths, std::vector<Index> chosen, std::size_t count) {
    if (chosen.size() <= count) return chosen;
    const auto brighter = [&](Index a, Index b) {
        return std::tuple(-brightness(paths, a), a) < std::tuple(-brightness(paths, b), b);
    };
    std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(count), chosen.end(), brighter);
    chosen.resize(count);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace

std::size_t bytesOf(const PathSet& paths) {
    const PathColumns& c = paths.columns();
    std::size_t bytes = 0;
    const auto add = [&](const auto&... arrays) { ((bytes += arrays.size() * sizeof(*arrays.data())), ...); };
    add(c.pixels, c.samples, c.parts, c.pathFlags, c.origins, c.estimates, c.firstVertex, c.depths, c.vertexFlags, c.positions,
        c.vertexEstimates, c.emissions, c.meshes, c.faces, c.events, c.lobes, c.labels, c.nextEventOwners, c.nextEvents,
        c.contributionOwners, c.contributions, c.splatOwners, c.splats);
    for (const Column& column : c.columns) add(column.owners, column.bytes, column.spectrumOffsets, column.locations);
    for (const std::string& string : c.strings) bytes += string.size() + sizeof string;
    return bytes;
}

void MatchKeeper::add(std::size_t batch, const PathSet& paths, const std::vector<Index>& matches) {
    if (keep_ == KeepMatches::none || matches.empty() || batch >= end_) return;
    PathSet kept = paths.subset(keep_ == KeepMatches::brightest ? brightest(paths, matches, count_) : matches);
    const std::size_t bytes = bytesOf(kept);
    bytes_ += bytes;
    keptPaths_ += kept.pathCount();
    batches_.emplace(batch, Batch{std::move(kept), bytes});
    // Several times as many as wanted, so that each path is looked at a few times only.
    if (keep_ == KeepMatches::brightest) {
        if (keptPaths_ > 4 * std::uint64_t(count_) + 1024) keepBrightest();
        for (; bytes_ > budget_ && count_ > 0; count_ /= 2) keepBrightest();
        return;
    }
    while (bytes_ > budget_) {
        // What is held lies before end_, so that in the end it is the longest run of batches that fits.
        const auto last = std::prev(batches_.end());
        end_ = last->first;
        bytes_ -= last->second.bytes;
        keptPaths_ -= last->second.paths.pathCount();
        batches_.erase(last);
    }
}

/// Puts the brightest of all batches into one.
void MatchKeeper::keepBrightest() {
    PathSet all = finish();
    batches_.clear();
    bytes_ = bytesOf(all);
    keptPaths_ = all.pathCount();
    // Later batches are merged with this one by the order of pixels, so that any number will do.
    batches_.emplace(SIZE_MAX, Batch{std::move(all), bytes_});
}

PathSet MatchKeeper::finish() {
    std::vector<PathSet> sets;
    for (auto& [number, batch] : batches_) sets.push_back(batch.paths);
    PathSet all = PathSet::merged(sets);
    if (keep_ != KeepMatches::brightest || all.pathCount() <= count_) return all;
    std::vector<Index> every(all.pathCount());
    for (Index i = 0; i < all.pathCount(); ++i) every[i] = i;
    keptPaths_ = count_;
    return all.subset(brightest(all, std::move(every), count_));
}

}  // namespace emca
