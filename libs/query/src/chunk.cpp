#include "chunk.h"

#include <algorithm>

namespace emca::query::detail {

namespace {

/// Positions of values whose owners are in `range`; owners ascend.
IndexRange positionsOf(const SharedArray<Index>& owners, IndexRange range) {
    const auto first = std::lower_bound(owners.begin(), owners.end(), range.first);
    const auto last = std::lower_bound(first, owners.end(), range.last);
    return {static_cast<Index>(first - owners.begin()), static_cast<Index>(last - owners.begin())};
}

/// The begin of the values of each owner in `range`, and the end, counted from the first value.
std::vector<Index> beginsOf(const SharedArray<Index>& owners, IndexRange values, IndexRange range) {
    std::vector<Index> begins(range.size() + 1, 0);
    for (Index i = values.first; i < values.last; ++i) ++begins[owners[i] - range.first + 1];
    for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
    return begins;
}

std::size_t at(Domain domain) { return static_cast<std::size_t>(domain); }

}  // namespace

Chunk::Chunk(const PathSet& paths, IndexRange range) : paths_(&paths) {
    const PathColumns& c = paths.columns();
    ranges_[at(Domain::path)] = range;
    ranges_[at(Domain::vertex)] = {c.firstVertex[range.first], c.firstVertex[range.last]};
    ranges_[at(Domain::contribution)] = positionsOf(c.contributionOwners, ranges_[at(Domain::vertex)]);
    ranges_[at(Domain::nextEvent)] = positionsOf(c.nextEventOwners, ranges_[at(Domain::vertex)]);
    Index pixels = 0;
    for (Index p = range.first; p < range.last; ++p)
        if (p == range.first || !(c.pixels[p] == c.pixels[p - 1])) ++pixels;
    ranges_[at(Domain::pixel)] = {0, pixels};
}

std::vector<Index> Chunk::directFirst(Domain outer, Domain inner) const {
    const PathColumns& c = paths_->columns();
    const IndexRange paths = range(Domain::path), vertices = range(Domain::vertex);
    std::vector<Index> firsts;
    switch (inner) {
        case Domain::path:
            for (Index p = paths.first; p < paths.last; ++p)
                if (p == paths.first || !(c.pixels[p] == c.pixels[p - 1])) firsts.push_back(p - paths.first);
            firsts.push_back(paths.size());
            return firsts;
        case Domain::vertex:
            firsts.reserve(paths.size() + 1);
            for (Index p = paths.first; p <= paths.last; ++p) firsts.push_back(c.firstVertex[p] - vertices.first);
            return firsts;
        case Domain::contribution: return beginsOf(c.contributionOwners, range(inner), vertices);
        case Domain::nextEvent: return beginsOf(c.nextEventOwners, range(inner), vertices);
        default: break;
    }
    return {0, static_cast<Index>(size(outer == Domain::constant ? inner : outer))};
}

const std::vector<Index>& Chunk::firstOf(Domain outer, Domain inner) {
    std::vector<Index>& firsts = firsts_[at(outer)][at(inner)];
    if (!firsts.empty()) return firsts;
    const Domain between = parent(inner);
    if (outer == Domain::constant) {
        firsts = {0, static_cast<Index>(size(inner))};
    } else if (between == outer) {
        firsts = directFirst(outer, inner);
    } else {
        const std::vector<Index>&above = firstOf(outer, between), &below = firstOf(between, inner);
        std::vector<Index> composed(above.size());
        for (std::size_t i = 0; i < above.size(); ++i) composed[i] = below[above[i]];
        firsts = std::move(composed);
    }
    return firsts;
}

const std::vector<Index>& Chunk::ownersOf(Domain inner, Domain outer) {
    std::vector<Index>& owners = owners_[at(inner)][at(outer)];
    if (!owners.empty()) return owners;
    const std::vector<Index>& firsts = firstOf(outer, inner);
    owners.resize(size(inner));
    for (std::size_t i = 0; i + 1 < firsts.size(); ++i) std::fill(owners.begin() + firsts[i], owners.begin() + firsts[i + 1], static_cast<Index>(i));
    return owners;
}

IndexRange nextChunk(const PathSet& paths, Index first, bool wholePixels) {
    constexpr Index kVertices = 4096, kPaths = 4096;
    const PathColumns& c = paths.columns();
    const Index count = paths.pathCount();
    // The first path that begins beyond the wanted number of vertices ends the chunk; one path at least is in it.
    const auto begin = c.firstVertex.begin() + first + 1;
    const auto end = c.firstVertex.begin() + std::min<std::size_t>(count, std::size_t(first) + kPaths) + 1;
    const std::uint64_t most = std::uint64_t(c.firstVertex[first]) + kVertices;
    Index last = static_cast<Index>(std::upper_bound(begin, end, most, [](std::uint64_t a, Index b) { return a < b; }) - c.firstVertex.begin()) - 1;
    last = std::max(last, first + 1);
    while (wholePixels && last < count && c.pixels[last] == c.pixels[last - 1]) ++last;
    return {first, last};
}

}  // namespace emca::query::detail
