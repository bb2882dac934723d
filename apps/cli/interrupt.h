#pragma once

#include <atomic>
#include <memory>

namespace emca::cli {

/// While one lives, the first Ctrl-C (or SIGTERM) sets its flag instead of ending the program; a second one ends it.
/// One at a time, from the main thread.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// For RequestObserver::cancel.
    const std::shared_ptr<std::atomic<bool>>& flag() const { return flag_; }
    bool interrupted() const { return *flag_; }

  private:
    std::shared_ptr<std::atomic<bool>> flag_;
};

}  // namespace emca::cli
