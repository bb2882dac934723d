#include "emca/core/image.h"

namespace emca {

Image::Image(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels)
    : width_(width), height_(height), channels_(std::move(channels)),
      data_(std::size_t(width) * height * channels_.size(), 0.f) {}

Color Image::color(Pixel p) const {
    const float* v = at(p);
    return channels_.size() >= 3 ? Color(v[0], v[1], v[2]) : Color(v[0]);
}

void Image::setColor(Pixel p, Color c) {
    float* v = at(p);
    v[0] = c.r;
    v[1] = c.g;
    v[2] = c.b;
}

int Image::channelIndex(std::string_view channel) const {
    for (std::size_t i = 0; i < channels_.size(); ++i)
        if (channels_[i] == channel) return static_cast<int>(i);
    return -1;
}

}  // namespace emca
