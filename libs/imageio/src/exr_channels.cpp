#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

#include "exr.h"
#include "lower_case.h"

namespace emca::imageio {
namespace {

/// "diffuse.R": layer "diffuse", name "R". Layers may be nested.
std::pair<std::string_view, std::string_view> split(std::string_view channel) {
    const std::size_t dot = channel.rfind('.');
    if (dot == std::string_view::npos) return {{}, channel};
    return {channel.substr(0, dot), channel.substr(dot + 1)};
}

/// Place of a name in its layer; the same as in OpenImageIO, so that a file has one order whoever reads it. In a layer of
/// positions or directions x, y and z belong together; among colours y is luminance and z depth.
std::size_t placeOf(std::string_view name, bool vectors) {
    using Names = std::array<std::string_view, 22>;
    static constexpr Names kColors{"r",  "red", "g",  "green", "b",  "blue", "y",  "real", "imag",  "a",    "alpha",
                                   "ar", "ra",  "ag", "ga",    "ab", "ba",   "z",  "depth", "zback"};
    static constexpr Names kVectors{"r",    "red", "g",     "green", "b",  "blue", "x",  "y",  "z",     "real", "imag",
                                    "a",    "alpha", "ar",  "ra",    "ag", "ga",   "ab", "ba", "depth", "zback"};
    const Names& names = vectors ? kVectors : kColors;
    const auto place = std::find(names.begin(), names.end(), lowerCase(std::string(name)));
    return static_cast<std::size_t>(place - names.begin());
}

}  // namespace

std::vector<std::string> inLayerOrder(std::vector<std::string> channels) {
    const auto isVectorLayer = [&](std::string_view layer) {
        bool x = false, yOrZ = false;
        for (const std::string& channel : channels) {
            const auto [its, name] = split(channel);
            if (its != layer) continue;
            const std::string lower = lowerCase(std::string(name));
            x = x || lower == "x";
            yOrZ = yOrZ || lower == "y" || lower == "z";
        }
        return x && yOrZ;
    };
    using Key = std::tuple<std::string, std::size_t, std::string>;
    std::vector<std::pair<Key, std::string>> keyed;
    for (const std::string& channel : channels) {
        const auto [layer, name] = split(channel);
        const std::size_t place = placeOf(name, isVectorLayer(layer));
        keyed.emplace_back(Key{layer, place, name}, channel);
    }
    std::sort(keyed.begin(), keyed.end());
    std::transform(keyed.begin(), keyed.end(), channels.begin(), [](const auto& entry) { return entry.second; });
    return channels;
}

int alphaOf(const std::vector<std::string>& channels) {
    const auto isAlpha = [](const std::string& channel) {
        const std::string name = lowerCase(std::string(split(channel).second));
        return name == "a" || name == "alpha";
    };
    const auto found = std::find_if(channels.begin(), channels.end(), isAlpha);
    return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

}  // namespace emca::imageio
