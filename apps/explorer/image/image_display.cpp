#include "image/image_display.h"

#include <algorithm>

#include "emca/analysis/image_channels.h"
#include "emca/analysis/metric_scale.h"

namespace emca::explorer {

std::string text(const ChannelSelect& select) {
    switch (select.kind) {
        case ChannelSelect::Kind::color: return "RGB";
        case ChannelSelect::Kind::luminance: return "Luminance";
        default: return select.name;
    }
}

std::vector<ChannelSelect> channelsOf(const Image& image) {
    using Kind = ChannelSelect::Kind;
    std::vector<ChannelSelect> offered;
    const bool color = image.channelCount() >= 3;
    if (color) offered = {{Kind::color}, {Kind::luminance}};
    const auto layers = analysis::colorLayers(image);
    const auto isPart = [&](std::uint32_t channel, bool named) {
        return std::any_of(layers.begin(), layers.end(), [&](const analysis::ColorLayer& layer) {
            return layer.name.empty() != named && std::find(layer.channels, layer.channels + 3, channel) != layer.channels + 3;
        });
    };
    // Channels of the colour itself and opacity come first, then the colours of layers, then all others.
    for (std::uint32_t c = 0; c < image.channelCount(); ++c)
        if (!isPart(c, true) && (c < 3 || isPart(c, false) || image.channels()[c] == "A")) offered.push_back({Kind::channel, image.channels()[c]});
    for (const analysis::ColorLayer& layer : layers)
        if (!layer.name.empty()) offered.push_back({Kind::layer, layer.name});
    for (const std::string& channel : image.channels()) {
        const ChannelSelect select{Kind::channel, channel};
        if (std::find(offered.begin(), offered.end(), select) == offered.end()) offered.push_back(select);
    }
    return offered;
}

ImageDisplay::ImageDisplay() {
    for (std::size_t m = 0; m < analysis::kImageMetricCount; ++m) {
        const auto each = static_cast<analysis::ImageMetric>(m);
        scales_[1 + m] = {true, analysis::suggestedMap(each), {}, true};
    }
    for (std::size_t e = 0; e < analysis::kSamplingErrorCount; ++e)
        scales_[1 + analysis::kImageMetricCount + e] = {true, analysis::ColorMapId::viridis, {}, true};
}

std::size_t ImageDisplay::scaleIndex() const {
    if (mode == ImageMode::difference) return 1 + static_cast<std::size_t>(metric);
    return samplingError ? 1 + analysis::kImageMetricCount + static_cast<std::size_t>(*samplingError) : 0;
}

ImageStyle ImageDisplay::style() const {
    const ValueScale& s = scale();
    return {toneMap, s.falseColor || mustBeFalseColor(), s.colorMap, s.range, channel, mode != ImageMode::difference};
}

std::string ImageDisplay::quantity() const {
    if (mode == ImageMode::difference) return std::string(analysis::name(metric));
    return samplingError ? std::string(analysis::name(*samplingError)) : "radiance";
}

std::string_view ImageDisplay::unit() const {
    if (mode == ImageMode::difference) return analysis::unit(metric);
    if (samplingError) return analysis::unit(*samplingError);
    return analysis::unit(analysis::ImageMetric::error);
}

ResolvedChannel resolve(const ChannelSelect& select, const Image& image) {
    ResolvedChannel resolved;
    if (select.kind == ChannelSelect::Kind::luminance) {
        resolved.color = false;
    } else if (select.kind == ChannelSelect::Kind::channel) {
        const int index = image.channelIndex(select.name);
        if (index >= 0) {
            resolved.color = false;
            resolved.choice.index = index;
        }
    } else if (select.kind == ChannelSelect::Kind::layer) {
        for (const analysis::ColorLayer& layer : analysis::colorLayers(image)) {
            if (layer.name != select.name) continue;
            std::copy(std::begin(layer.channels), std::end(layer.channels), resolved.channels.begin());
            resolved.picked = true;
        }
    }
    return resolved;
}

float shownNumber(const Image& image, Pixel pixel, const ChannelSelect& select) {
    const ResolvedChannel resolved = resolve(select, image);
    if (!resolved.picked) return analysis::scalar(image, pixel, resolved.choice);
    const float* v = image.at(pixel);
    return luminance(Color(v[resolved.channels[0]], v[resolved.channels[1]], v[resolved.channels[2]]));
}

}  // namespace emca::explorer
