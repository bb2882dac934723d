#include "progress_bar.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace emca {

namespace {

constexpr std::chrono::milliseconds kRedraw{100};

std::size_t terminalColumns() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

std::string duration(double seconds) {
    const auto whole = static_cast<long>(std::min(seconds + 0.5, 1e8));
    char text[32];
    if (whole < 60) {
        std::snprintf(text, sizeof text, "%ld s", whole);
    } else {
        std::snprintf(text, sizeof text, "%ld:%02ld min", whole / 60, whole % 60);
    }
    return text;
}

}  // namespace

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)), visible_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), lastDrawn_(start_) {}

ProgressBar::~ProgressBar() {
    if (visible_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::update(double fraction) {
    if (!visible_) return;
    const std::lock_guard lock(mutex_);
    shown_ = std::max(shown_, std::clamp(fraction, 0.0, 1.0));
    const auto now = Clock::now();
    if (now - lastDrawn_ < kRedraw) return;
    lastDrawn_ = now;
    draw(shown_);
}

void ProgressBar::draw(double fraction) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    char share[16];
    std::snprintf(share, sizeof share, " %3d %%", static_cast<int>(fraction * 100));
    const std::string left = title_ + " [", right = "]" + std::string(share) + ", " +
                             (fraction > 0 ? duration(elapsed / fraction - elapsed) + " left" : "");
    const std::size_t columns = terminalColumns();
    const std::size_t taken = left.size() + right.size() + 1;
    const std::size_t width = columns > taken + 10 ? std::min<std::size_t>(columns - taken, 60) : 10;
    const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
    const std::string line = "\r" + left + std::string(filled, '=') + std::string(width - filled, ' ') + right + "\x1b[K";
    std::fputs(line.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace emca
