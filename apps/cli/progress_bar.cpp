#include "progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "emca/analysis/format.h"

namespace emca::cli {
namespace {

std::size_t terminalColumns() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

std::string progressLine(const std::string& title, double fraction, double elapsedSeconds, std::size_t columns) {
    fraction = std::clamp(fraction, 0.0, 1.0);
    std::string right = fmt::format(" {:3.0f} %", std::floor(fraction * 100));
    // The first moments say nothing about the rest.
    if (fraction > 0 && elapsedSeconds > 0.5) {
        const double left = elapsedSeconds * (1 - fraction) / fraction;
        right +=
            ", " + (left < 59.5 ? fmt::format("{:.0f} s", std::ceil(left)) : analysis::formatDuration(left)) + " left";
    }
    const std::size_t text = title.size() + 1 + right.size() + 1;
    if (text + 8 > columns) return (title + right).substr(0, columns > 0 ? columns - 1 : 0);
    const std::size_t width = std::min<std::size_t>(columns - text, 50);
    const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(width));
    return title + " " + std::string(filled, '#') + std::string(width - filled, '.') + right;
}

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)), visible_(::isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}

ProgressBar::~ProgressBar() {
    if (visible_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::update(double fraction) {
    if (!visible_) return;
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    fmt::print(stderr, "\r{}\x1b[K", progressLine(title_, fraction, elapsed, terminalColumns()));
    std::fflush(stderr);
}

}  // namespace emca::cli
