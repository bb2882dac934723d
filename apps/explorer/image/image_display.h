#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/analysis/image_metrics.h"
#include "emca/analysis/sampling_error.h"
#include "emca/analysis/tone_map.h"
#include "emca/core/image.h"

namespace emca::explorer {

/// Which image a person looks at. In all of them a pixel is at the same place of the widget.
enum class ImageMode : std::uint8_t {
    image = 0,
    reference = 1,
    split = 2,       ///< the image at the left of a line, the reference at its right
    difference = 3,
};

/// What of an image is shown. Names, not indices, since images that are compared may order their channels differently.
struct ChannelSelect {
    enum class Kind : std::uint8_t { color, luminance, channel, layer };
    Kind kind = Kind::color;
    std::string name = {};           ///< of a channel ("A", "depth.Z") or of a layer of colours ("diffuse")
    friend bool operator==(const ChannelSelect&, const ChannelSelect&) = default;
};
std::string text(const ChannelSelect& select);   ///< "RGB", "Luminance", "A"
/// Everything that an image offers, in the order in which people step through it: RGB, luminance, R, G, B, A, layers, others.
std::vector<ChannelSelect> channelsOf(const Image& image);

/// How numbers become a picture: by a tone map, or through a colour map.
struct ImageStyle {
    analysis::ToneMap toneMap;
    bool falseColor = false;
    analysis::ColorMapId colorMap = analysis::ColorMapId::viridis;
    analysis::ValueRange range;      ///< of false colour
    ChannelSelect channel;
    bool negativeIsInvalid = true;   ///< radiance is never negative; a difference may be
    friend bool operator==(const ImageStyle&, const ImageStyle&) = default;
};

/// Colours for one kind of numbers, so that changing from radiance to a metric and back changes no range.
struct ValueScale {
    bool falseColor = false;
    analysis::ColorMapId colorMap = analysis::ColorMapId::viridis;
    analysis::ValueRange range;
    bool automatic = true;           ///< the range follows the image; false: set by hand
    friend bool operator==(const ValueScale&, const ValueScale&) = default;
};

/// What is displayed, and how: the whole state of the image view besides its images and zoom.
class ImageDisplay {
  public:
    ImageDisplay();

    ImageMode mode = ImageMode::image;
    std::optional<analysis::SamplingError> samplingError;   ///< in place of the pixels' values; not in differences
    analysis::ImageMetric metric = analysis::ImageMetric::error;
    analysis::ToneMap toneMap;
    ChannelSelect channel;
    double tail = 0.005;             ///< share of the pixels that automatic ranges leave out at either end

    /// The scale of what `mode` shows.
    const ValueScale& scale() const { return scales_[scaleIndex()]; }
    ValueScale& scale() { return scales_[scaleIndex()]; }
    ImageStyle style() const;
    /// Signed errors have no tone: they are always shown through a colour map.
    bool mustBeFalseColor() const { return mode == ImageMode::difference && analysis::isPerChannel(metric) && metric == analysis::ImageMetric::error; }
    std::string quantity() const;    ///< "radiance", "absolute error", …
    std::string_view unit() const;   ///< "" for none

    friend bool operator==(const ImageDisplay&, const ImageDisplay&) = default;

  private:
    static constexpr std::size_t kScales = 1 + analysis::kImageMetricCount + analysis::kSamplingErrorCount;
    std::size_t scaleIndex() const;
    std::array<ValueScale, kScales> scales_;
};

/// A channel as `image` has it; what it does not have counts as its colours (false colour: their luminance).
struct ResolvedChannel {
    bool color = true;                       ///< the first three of `channels` are a colour
    std::array<std::uint32_t, 3> channels{0, 1, 2};
    analysis::ChannelChoice choice;          ///< of a number; of a layer other than the first: luminance of `channels`
    bool picked = false;                     ///< `channels` are not the image's first three
};
ResolvedChannel resolve(const ChannelSelect& select, const Image& image);
/// The number of a pixel that false colour shows.
float shownNumber(const Image& image, Pixel pixel, const ChannelSelect& select);

}  // namespace emca::explorer
