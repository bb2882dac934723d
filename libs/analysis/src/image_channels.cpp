#include "emca/analysis/image_channels.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "emca/analysis/statistics.h"

namespace emca::analysis {
namespace {

constexpr std::size_t kPicked = 65536;

/// Position of a channel's own name among the three of a colour, and which triple it belongs to.
struct Component {
    int triple = -1, index = 0;   // triple 0: R, G, B; 1: X, Y, Z
};

Component componentOf(std::string_view name) {
    if (name.size() != 1) return {};
    const char c = name.front() >= 'a' ? static_cast<char>(name.front() - 'a' + 'A') : name.front();
    for (int triple = 0; triple < 2; ++triple) {
        const auto found = std::string_view(triple == 0 ? "RGB" : "XYZ").find(c);
        if (found != std::string_view::npos) return {triple, static_cast<int>(found)};
    }
    return {};
}

std::vector<float> pickedValues(const Image& image, ChannelChoice channel) {
    std::vector<float> values;
    if (image.empty()) return values;
    const std::size_t pixels = std::size_t(image.width()) * image.height();
    const std::size_t count = std::min(pixels, kPicked);
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = pixels * i / count;
        values.push_back(scalar(image, {static_cast<std::uint32_t>(at % image.width()), static_cast<std::uint32_t>(at / image.width())}, channel));
    }
    return values;
}

}  // namespace

std::vector<ColorLayer> colorLayers(const Image& image) {
    struct Candidate {
        std::string_view layer;
        int triple;
        std::uint32_t channels[3];
        int found;
    };
    std::vector<Candidate> candidates;
    for (std::uint32_t c = 0; c < image.channelCount(); ++c) {
        const std::string_view name = image.channels()[c];
        const auto point = name.rfind('.');
        const std::string_view layer = point == std::string_view::npos ? std::string_view() : name.substr(0, point);
        const Component part = componentOf(point == std::string_view::npos ? name : name.substr(point + 1));
        if (part.triple < 0) continue;
        auto known = std::find_if(candidates.begin(), candidates.end(),
                                  [&](const Candidate& k) { return k.layer == layer && k.triple == part.triple; });
        if (known == candidates.end()) known = candidates.insert(candidates.end(), Candidate{layer, part.triple, {}, 0});
        known->channels[part.index] = c;
        known->found |= 1 << part.index;
    }
    std::vector<ColorLayer> layers;
    for (const Candidate& k : candidates)
        if (k.found == 7) layers.push_back({std::string(k.layer), {k.channels[0], k.channels[1], k.channels[2]}});
    return layers;
}

Image pickChannels(const Image& image, std::span<const std::uint32_t> channels) {
    std::vector<std::string> names;
    for (const std::uint32_t c : channels) names.push_back(image.channels()[c]);
    Image picked(image.width(), image.height(), std::move(names));
    const std::size_t stride = image.channelCount(), pixels = std::size_t(image.width()) * image.height();
    const float* in = image.data();
    float* out = picked.data();
    for (std::size_t i = 0; i < pixels; ++i, in += stride)
        for (const std::uint32_t c : channels) *out++ = in[c];
    return picked;
}

ValueRange imageRange(const Image& image, ChannelChoice channel, double tail, bool log) {
    return percentileRange(pickedValues(image, channel), tail, 1 - tail, log);
}

ValueRange symmetricRange(const Image& image, ChannelChoice channel, double tail) {
    std::vector<float> values = pickedValues(image, channel);
    for (float& v : values) v = std::abs(v);
    // Both tails of the signed values are one tail of the absolute ones.
    const double end = percentileRange(values, 0, 1 - 2 * std::clamp(tail, 0.0, 0.49)).max;
    return ValueRange{-end, end, false}.repaired();
}

}  // namespace emca::analysis
