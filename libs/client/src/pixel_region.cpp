#include "emca/client/pixel_region.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace emca::client {
namespace {

std::string placeText(std::uint32_t x, std::uint32_t y) { return "(" + std::to_string(x) + ", " + std::to_string(y) + ")"; }

}  // namespace

PixelRegion::PixelRegion(std::vector<Pixel> pixels) {
    if (pixels.empty()) return;
    std::sort(pixels.begin(), pixels.end());
    pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    bounds_ = {pixels.front().x, pixels.front().y, pixels.front().x + 1, pixels.back().y + 1};
    for (const Pixel pixel : pixels) {
        bounds_.x0 = std::min(bounds_.x0, pixel.x);
        bounds_.x1 = std::max(bounds_.x1, pixel.x + 1);
    }
    pixels_ = std::make_shared<const std::vector<Pixel>>(std::move(pixels));
}

PixelRegion::PixelRegion(const PixelRect& rect) {
    if (rect.empty()) return;
    std::vector<Pixel> pixels;
    pixels.reserve(rect.count());
    for (std::uint32_t y = rect.y0; y < rect.y1; ++y)
        for (std::uint32_t x = rect.x0; x < rect.x1; ++x) pixels.push_back({x, y});
    bounds_ = rect;
    pixels_ = std::make_shared<const std::vector<Pixel>>(std::move(pixels));
}

bool PixelRegion::contains(Pixel pixel) const {
    if (!bounds_.contains(pixel)) return false;
    return isRectangle() || std::binary_search(pixels_->begin(), pixels_->end(), pixel);
}

PixelRegion PixelRegion::with(const PixelRegion& others) const {
    if (others.empty()) return *this;
    if (empty()) return others;
    std::vector<Pixel> all;
    all.reserve(size() + others.size());
    std::set_union(pixels_->begin(), pixels_->end(), others.pixels_->begin(), others.pixels_->end(), std::back_inserter(all));
    return PixelRegion(std::move(all));
}

PixelRegion PixelRegion::toggled(Pixel pixel) const {
    std::vector<Pixel> all(pixels().begin(), pixels().end());
    const auto at = std::lower_bound(all.begin(), all.end(), pixel);
    if (at != all.end() && *at == pixel) all.erase(at);
    else all.insert(at, pixel);
    return PixelRegion(std::move(all));
}

std::string PixelRegion::text() const {
    if (empty()) return {};
    const std::string corner = placeText(bounds_.x0, bounds_.y0);
    const std::uint32_t width = bounds_.x1 - bounds_.x0, height = bounds_.y1 - bounds_.y0;
    if (size() == 1) return "pixel " + corner;
    if (isRectangle()) return "region " + std::to_string(width) + "x" + std::to_string(height) + " at " + corner;
    return std::to_string(size()) + " pixels around " + placeText(bounds_.x0 + width / 2, bounds_.y0 + height / 2);
}

}  // namespace emca::client
