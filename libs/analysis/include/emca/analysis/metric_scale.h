#pragma once

#include <string_view>

#include "emca/analysis/color_map.h"
#include "emca/analysis/image_metrics.h"
#include "emca/analysis/sampling_error.h"

namespace emca::analysis {

// How the numbers of a comparison are shown: unit, colour map, range.

/// Unit of a metric of radiance: "W/(sr m²)", its square, or "" for what has none.
std::string_view unit(ImageMetric metric);
std::string_view unit(SamplingError error);

constexpr bool isSigned(ImageMetric metric) { return metric == ImageMetric::error; }

/// Red and green for signed errors (as in EMCA), magma for FLIP (as in its papers), inferno for the others.
ColorMapId suggestedMap(ImageMetric metric);

/// Signed: around 0; FLIP: [0, 1]; others from 0 (logarithmic: from the lower quantile) to the upper quantile.
/// \param tail  share of the pixels left out at an end
ValueRange metricRange(const Image& difference, ImageMetric metric, ChannelChoice channel = {}, double tail = 0.005, bool log = false);

}  // namespace emca::analysis
