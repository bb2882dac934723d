#pragma once

#include <cstddef>
#include <functional>

#include "emca/core/result.h"
#include "emca/server/renderer.h"

namespace emca {

/// A replay in parts that know nothing of each other, on several threads.
struct Batches {
    std::size_t count = 0;
    unsigned threads = 1;   ///< at most so many at once, the caller's included
    /// One batch, in any thread. Its monitor is cancelled as soon as another batch failed, and swallows what is said of
    /// progress: that goes by whole batches.
    std::function<Result<void>(std::size_t batch, RequestMonitor& monitor)> work;
};

/// Returns when no batch runs any more. Errors: the first one that any batch had; cancelled. What a batch throws is thrown.
Result<void> runBatches(const Batches& batches, RequestMonitor& monitor);

}  // namespace emca
