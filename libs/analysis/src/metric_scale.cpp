#include "emca/analysis/metric_scale.h"

#include "emca/analysis/image_channels.h"

namespace emca::analysis {
namespace {

constexpr std::string_view kRadiance = "W/(sr m²)", kSquaredRadiance = "(W/(sr m²))²";

}  // namespace

std::string_view unit(ImageMetric metric) {
    switch (metric) {
        case ImageMetric::error:
        case ImageMetric::absoluteError:
            return kRadiance;
        case ImageMetric::squaredError:
            return kSquaredRadiance;
        default:
            return {};
    }
}

std::string_view unit(SamplingError error) {
    switch (error) {
        case SamplingError::variance:
            return kSquaredRadiance;
        case SamplingError::standardError:
            return kRadiance;
        case SamplingError::relativeError:
            break;
    }
    return {};
}

ColorMapId suggestedMap(ImageMetric metric) {
    if (isSigned(metric)) return ColorMapId::redGreen;
    return isPerChannel(metric) ? ColorMapId::inferno : ColorMapId::magma;
}

ValueRange metricRange(const Image& difference, ImageMetric metric, ChannelChoice channel, double tail, bool log) {
    if (isSigned(metric)) return symmetricRange(difference, channel, tail);
    if (!isPerChannel(metric) && !log) return {0, 1, false};
    ValueRange range = imageRange(difference, channel, tail, log);
    if (!log) range.min = 0;
    return range.repaired();
}

}  // namespace emca::analysis
