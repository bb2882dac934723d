#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "emca/core/match_counts.h"
#include "emca/core/path_set.h"

namespace emca {

/// Holds the matching paths of a scan within a budget, whatever the order in which batches of pixels come: of too many,
/// those of the first pixels are kept, or the brightest (half as many, and so on, if not even these fit).
class MatchKeeper {
  public:
    MatchKeeper(KeepMatches keep, std::uint32_t count, std::size_t budgetBytes)
        : keep_(keep), count_(count), budget_(budgetBytes) {}

    /// Of batch number `batch` those paths at the positions `matches`.
    void add(std::size_t batch, const PathSet& paths, const std::vector<Index>& matches);
    /// All that are kept, in order.
    PathSet finish();
    std::uint64_t kept() const { return keptPaths_; }

  private:
    struct Batch {
        PathSet paths;
        std::size_t bytes = 0;
    };
    void keepBrightest();
    KeepMatches keep_;
    std::uint32_t count_;
    std::size_t budget_, bytes_ = 0, end_ = SIZE_MAX;   ///< batches from `end_` on have been left out
    std::uint64_t keptPaths_ = 0;
    std::map<std::size_t, Batch> batches_;
};

/// Bytes of all columns.
std::size_t bytesOf(const PathSet& paths);

}  // namespace emca
