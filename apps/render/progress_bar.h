#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace emca {

/// Bar on the terminal behind standard error, with the remaining time. Shows nothing where that is no terminal.
/// update() may be called from any thread.
class ProgressBar {
  public:
    explicit ProgressBar(std::string title);
    ~ProgressBar();  ///< leaves the line to what is printed next
    void update(double fraction);

  private:
    using Clock = std::chrono::steady_clock;
    void draw(double fraction);

    std::string title_;
    bool visible_;
    std::mutex mutex_;
    double shown_ = 0;  ///< progress never goes back, though tiles report out of order
    Clock::time_point start_, lastDrawn_;
};

}  // namespace emca
