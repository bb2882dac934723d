#pragma once

#include <functional>
#include <mutex>
#include <thread>

#include <signal.h>

namespace emca::adapter {

/// Turns SIGINT and SIGTERM into a clean end. Make it before any other thread exists: it blocks the signals for all
/// that come later and waits for them in a thread of its own.
class EndingSignal {
  public:
    EndingSignal();
    ~EndingSignal();
    EndingSignal(const EndingSignal&) = delete;
    EndingSignal& operator=(const EndingSignal&) = delete;

    /// What to do at the signal. Before that is said, the signal ends the program at once, as it always does.
    void setAction(std::function<void()> action);

  private:
    void wait();

    sigset_t signals_;
    std::mutex mutex_;
    std::function<void()> action_;
    bool finished_ = false;
    std::thread thread_;
};

}  // namespace emca::adapter
