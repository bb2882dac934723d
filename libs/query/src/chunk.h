#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "emca/core/path_set.h"
#include "syntax.h"

namespace emca::query::detail {

/// Consecutive paths of a set, with all that belongs to them: what is evaluated at a time. Elements of each domain are
/// consecutive in the set, too, and counted from the begin of the chunk.
class Chunk {
  public:
    Chunk(const PathSet& paths, IndexRange range);

    const PathSet& paths() const { return *paths_; }
    /// Positions in the set.
    IndexRange range(Domain domain) const { return ranges_[static_cast<std::size_t>(domain)]; }
    std::size_t size(Domain domain) const { return domain == Domain::constant ? 1 : range(domain).size(); }

    /// For each element of `inner` the element of `outer`, which encloses it, that it belongs to.
    const std::vector<Index>& ownersOf(Domain inner, Domain outer);
    /// For each element of `outer` the first element of `inner`, and the end.
    const std::vector<Index>& firstOf(Domain outer, Domain inner);

  private:
    std::vector<Index> directFirst(Domain outer, Domain inner) const;
    const PathSet* paths_;
    std::array<IndexRange, kDomainCount> ranges_{};
    std::array<std::array<std::vector<Index>, kDomainCount>, kDomainCount> owners_, firsts_;
};

/// The next paths from `first` on: about as many as keep intermediate results in the cache, whole pixels if asked for.
IndexRange nextChunk(const PathSet& paths, Index first, bool wholePixels);

}  // namespace emca::query::detail
