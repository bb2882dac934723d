#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace emca::cli {

/// Progress on standard error where that is a terminal, else nothing. update() may come from any thread.
class ProgressBar {
  public:
    explicit ProgressBar(std::string title);
    ~ProgressBar();  ///< clears the line for what is printed next
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    void update(double fraction);

  private:
    using Clock = std::chrono::steady_clock;
    const std::string title_;
    const bool visible_;
    const Clock::time_point start_;
    std::mutex mutex_;
    Clock::time_point drawn_{};
};

/// "title ########........  50 %, 12.34 s left" in at most `columns` columns.
std::string progressLine(const std::string& title, double fraction, double elapsedSeconds, std::size_t columns);

}  // namespace emca::cli
