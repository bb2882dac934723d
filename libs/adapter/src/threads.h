#pragma once

#include <atomic>
#include <functional>

#include "emca/core/result.h"

namespace emca::adapter {

/// Runs `work` in several new threads and waits for all. The first error, or what was thrown first, sets `stop` for the
/// others and comes back. Threads instead of a pool, since a renderer may bind state to threads and expects them to end.
/// \param threads  0: one per processor
Result<void> onThreads(unsigned threads, const std::function<Result<void>(const std::atomic<bool>& stop)>& work);

}  // namespace emca::adapter
