#include "monitor.h"

#include <algorithm>

namespace emca {

void JobMonitor::progress(double fraction) {
    using Clock = std::chrono::steady_clock;
    constexpr Clock::duration kShortestPause = std::chrono::milliseconds(50);  // at most 20 messages a second
    if (!(fraction >= 0)) return;                                              // NaN too
    const auto shown = static_cast<float>(std::min(fraction, 1.0));
    request_->fraction.store(shown, std::memory_order_relaxed);
    const auto now = Clock::now().time_since_epoch().count();
    auto last = lastSent_.load(std::memory_order_relaxed);
    if (now - last < kShortestPause.count()) return;
    if (!lastSent_.compare_exchange_strong(last, now)) return;  // another thread just did
    request_->client->inform(*request_, protocol::Progress{shown, false});
}

void JobMonitor::preview(PixelRect rect, const std::vector<Color>& colors) {
    if (!preview_ || cancelled() || rect.count() == 0 || rect.count() != colors.size()) return;
    request_->client->inform(*request_, protocol::PreviewTile{rect, SharedArray<Color>(colors)});
}

void JobMonitor::beginPixel(Pixel pixel) {
    for (const auto& tool : tools_) tool->beginPixel(pixel);
}

void JobMonitor::endPixel(Pixel pixel) {
    for (const auto& tool : tools_) tool->endPixel(pixel);
}

}  // namespace emca
