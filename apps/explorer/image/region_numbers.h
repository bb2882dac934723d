#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "emca/analysis/image_metrics.h"
#include "emca/client/pixel_region.h"
#include "emca/core/image.h"

namespace emca::explorer {

/// What is asked of an image's pixels.
struct RegionWish {
    std::shared_ptr<const RenderedImage> image;       ///< null: none
    std::shared_ptr<const RenderedImage> reference;   ///< of the same size, or null
    client::PixelRegion region;                       ///< empty: all pixels
    bool log = false;                                 ///< of the histogram's values
    friend bool operator==(const RegionWish&, const RegionWish&) = default;
};

/// The same channel in both images.
struct RegionChannel {
    analysis::ChannelStatistics image;
    std::optional<analysis::ChannelStatistics> reference;   ///< nothing if the reference lacks the channel
    analysis::Histogram histogram;
    std::optional<analysis::Histogram> referenceHistogram;  ///< over the same range
};

struct RegionNumbers {
    std::size_t pixels = 0;
    /// Colours, alpha if there is one, and luminance last; of images without colours their first channels.
    std::vector<RegionChannel> channels;
    bool hasReference = false;
};

/// Any thread, as long as nobody writes to the images.
RegionNumbers regionNumbers(const RegionWish& wish);

}  // namespace emca::explorer
