#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/pixel.h"

namespace emca {

/// Pixels as interleaved 32-bit floats, row by row from the top. Colour channels are linear Rec. 709.
class Image {
  public:
    Image() = default;
    /// All values 0. Channel names as in OpenEXR: "R", "G", "B", "A", "Y" or any other.
    Image(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels = {"R", "G", "B"});

    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    std::uint32_t channelCount() const { return static_cast<std::uint32_t>(channels_.size()); }
    const std::vector<std::string>& channels() const { return channels_; }
    bool empty() const { return data_.empty(); }
    bool contains(Pixel p) const { return p.x < width_ && p.y < height_; }

    float* data() { return data_.data(); }
    const float* data() const { return data_.data(); }
    std::size_t size() const { return data_.size(); }  ///< width * height * channelCount

    /// First value of a pixel inside the image.
    float* at(Pixel p) { return &data_[(std::size_t(p.y) * width_ + p.x) * channels_.size()]; }
    const float* at(Pixel p) const { return &data_[(std::size_t(p.y) * width_ + p.x) * channels_.size()]; }

    /// The first three channels as a colour; a single channel as grey.
    Color color(Pixel p) const;
    void setColor(Pixel p, Color c);  ///< Only for images with at least three channels.

    /// Index of a channel by name, or -1.
    int channelIndex(std::string_view channel) const;

  private:
    std::uint32_t width_ = 0, height_ = 0;
    std::vector<std::string> channels_;
    std::vector<float> data_;
};

/// What a render delivers. All three have the same size.
struct RenderedImage {
    Image color;      ///< R, G, B: mean radiance of each pixel
    Image samples;    ///< one channel "samples": how many samples each pixel got
    Image variance;   ///< R, G, B: unbiased sample variance of the samples of a pixel (not of their mean); 0 if fewer than 2
};

}  // namespace emca
