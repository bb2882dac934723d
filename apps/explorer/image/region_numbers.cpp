#include "image/region_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace emca::explorer {
namespace {

constexpr std::size_t kBins = 64, kMostChannels = 4;

std::vector<float> valuesOf(const Image& image, analysis::ChannelChoice channel, const client::PixelRegion& region) {
    return region.empty() ? analysis::regionValues(image, channel) : analysis::regionValues(image, channel, region.pixels());
}

std::vector<analysis::ChannelStatistics> statisticsOf(const Image& image, const client::PixelRegion& region) {
    return region.empty() ? analysis::imageStatistics(image) : analysis::imageStatistics(image, region.pixels());
}

/// At most so many values say where the range ends.
constexpr std::size_t kPicked = 1u << 16;

/// Of all channels together: one firefly must not flatten the rest. Linear ranges of what is never negative begin at 0.
analysis::ValueRange rangeOf(const std::vector<std::vector<float>>& series, bool log) {
    analysis::ValueRange all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), log};
    for (const auto& values : series) {
        std::vector<double> picked;
        const std::size_t step = values.size() / kPicked + 1;
        for (std::size_t i = 0; i < values.size(); i += step) picked.push_back(double(values[i]));
        if (std::ranges::none_of(picked, [log](double v) { return std::isfinite(v) && (!log || v > 0); })) continue;
        const analysis::ValueRange one = analysis::robustRange(picked, {.log = log, .includeZero = true}).range;
        all.min = std::min(all.min, one.min);
        all.max = std::max(all.max, one.max);
    }
    return all.repaired();
}

}  // namespace

RegionNumbers regionNumbers(const RegionWish& wish) {
    RegionNumbers numbers;
    if (!wish.image) return numbers;
    const Image& image = wish.image->color;
    const Image* reference = wish.reference ? &wish.reference->color : nullptr;
    if (reference && (reference->width() != image.width() || reference->height() != image.height())) reference = nullptr;
    numbers.hasReference = reference != nullptr;

    const std::vector<analysis::ChannelStatistics> all = statisticsOf(image, wish.region);
    std::vector<analysis::ChannelStatistics> referenceAll;
    if (reference) referenceAll = statisticsOf(*reference, wish.region);
    std::vector<std::vector<float>> series, referenceSeries;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool luminance = image.channelCount() >= 3 && i + 1 == all.size();
        if (i >= kMostChannels && !luminance) continue;
        // Beside colours the other channels that a file may have (samples, layers) have no place; alpha has.
        if (i == 3 && !luminance && image.channelCount() >= 3 && all[i].channel != "A") continue;
        RegionChannel channel;
        channel.image = all[i];
        series.push_back(valuesOf(image, {luminance ? analysis::ChannelChoice::kLuminance : static_cast<int>(i)}, wish.region));
        std::vector<float>& other = referenceSeries.emplace_back();
        const auto same = std::ranges::find(referenceAll, all[i].channel, &analysis::ChannelStatistics::channel);
        if (same != referenceAll.end()) {
            const bool last = luminance && same + 1 == referenceAll.end();
            channel.reference = *same;
            other = valuesOf(*reference, {last ? analysis::ChannelChoice::kLuminance : static_cast<int>(same - referenceAll.begin())}, wish.region);
        }
        numbers.channels.push_back(std::move(channel));
    }
    if (!series.empty()) numbers.pixels = series.front().size();
    std::vector<std::vector<float>> everything = series;
    everything.insert(everything.end(), referenceSeries.begin(), referenceSeries.end());
    const analysis::ValueRange range = rangeOf(everything, wish.log);
    for (std::size_t i = 0; i < numbers.channels.size(); ++i) {
        RegionChannel& channel = numbers.channels[i];
        channel.histogram = analysis::histogram(std::span<const float>(series[i]), range, kBins);
        if (channel.reference) channel.referenceHistogram = analysis::histogram(std::span<const float>(referenceSeries[i]), range, kBins);
    }
    return numbers;
}

}  // namespace emca::explorer
