#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/analysis/tone_map.h"
#include "emca/core/image.h"

namespace emca::analysis {

/// Channels of an image that are one colour together.
struct ColorLayer {
    std::string name;                    ///< what stands before the last point of the names: "variance"; "" for R, G, B themselves
    std::uint32_t channels[3] = {0, 1, 2};
};
/// Layers with channels R, G, B or X, Y, Z (upper or lower case), in the order of their first channel. OpenEXR's
/// convention: a layer's name, a point, the channel's name.
std::vector<ColorLayer> colorLayers(const Image& image);

/// An image of some channels of another one, with their names and in the order given.
/// \param channels  indices of channels of `image`
Image pickChannels(const Image& image, std::span<const std::uint32_t> channels);

/// What false colour should span so that a few pixels do not flatten the rest: between two quantiles of at most 65536
/// evenly picked pixels, so that it costs the same for every image. Always valid.
/// \param tail  share of the pixels left out at either end, in [0, 0.5)
ValueRange imageRange(const Image& image, ChannelChoice channel, double tail = 0.005, bool log = false);
/// The same around 0, for signed values on a diverging map.
ValueRange symmetricRange(const Image& image, ChannelChoice channel, double tail = 0.005);

}  // namespace emca::analysis
