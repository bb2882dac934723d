#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <optional>

#include "emca/core/image.h"
#include "emca/core/result.h"
#include "image/image_display.h"

namespace emca::explorer {

/// Which numbers: of one image, or of two. Images count as equal if they are the same object.
struct ContentWish {
    std::shared_ptr<const RenderedImage> image;       ///< null: none
    std::shared_ptr<const RenderedImage> reference;   ///< of differences
    std::optional<analysis::ImageMetric> metric;      ///< how they differ
    std::optional<analysis::SamplingError> error;     ///< of `image` alone
    friend bool operator==(const ContentWish&, const ContentWish&) = default;

    /// The numbers are there already: nothing has to be computed.
    bool isImage() const { return image && !metric && !error; }
    /// Takes more than a frame, by what is known before.
    bool isSlow() const;
};

/// The numbers behind a picture.
struct ImageContent {
    std::shared_ptr<const Image> values;              ///< null: none
    double mean = std::numeric_limits<double>::quiet_NaN();   ///< of a metric, over all finite entries
    std::size_t incomparable = 0;                     ///< pixels whose difference is no number
};

/// How far a computation has come; any thread.
struct ContentProgress {
    std::atomic<double> fraction{0};
    std::atomic<bool> cancelled{false};
};

/// Any thread. Errors: of analysis::differenceImage and samplingErrorImage; cancelled.
Result<ImageContent> computeContent(const ContentWish& wish, ContentProgress& progress);

}  // namespace emca::explorer
