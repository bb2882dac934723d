#include "emca/analysis/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "color_map_data.h"

namespace emca::analysis {
namespace {

constexpr std::string_view kNames[kColorMapCount] = {"viridis", "plasma", "inferno",   "magma",      "turbo",
                                                     "cividis", "grey",   "red-green", "blue-orange"};
constexpr std::string_view kTables[] = {kViridis, kPlasma, kInferno, kMagma, kTurbo, kCividis};

constexpr std::uint8_t digit(char c) { return static_cast<std::uint8_t>(c <= '9' ? c - '0' : c - 'a' + 10); }

Color8 tabulated(std::string_view table, std::size_t i) {
    const auto byte = [&](std::size_t at) {
        return static_cast<std::uint8_t>(digit(table[6 * i + at]) * 16 + digit(table[6 * i + at + 1]));
    };
    return {byte(0), byte(2), byte(4), 255};
}

std::uint8_t fraction(double f, int end) { return static_cast<std::uint8_t>(std::lround(f * end)); }

/// Even steps of the encoded value towards one of two ends, black in the middle.
Color8 diverging(std::size_t i, Color8 negative, Color8 positive) {
    const double t = (static_cast<double>(i) + 0.5) / 128 - 1;  // symmetric: entries 127 and 128 are equally dark
    const Color8 end = t < 0 ? negative : positive;
    const double f = (std::abs(t) - 1.0 / 256) / (1 - 1.0 / 128);
    return {fraction(f, end.r), fraction(f, end.g), fraction(f, end.b), 255};
}

Color8 entry(ColorMapId id, std::size_t i) {
    const auto grey = static_cast<std::uint8_t>(i);
    switch (id) {
        case ColorMapId::grey:
            return {grey, grey, grey, 255};
        case ColorMapId::redGreen:
            return diverging(i, {255, 40, 40, 255}, {40, 255, 40, 255});
        case ColorMapId::blueOrange:
            return diverging(i, {60, 150, 255, 255}, {255, 160, 30, 255});
        default:
            return tabulated(kTables[static_cast<std::size_t>(id)], i);
    }
}

}  // namespace

struct ColorMapTable {
    std::array<ColorMap, kColorMapCount> maps;
    template <std::size_t... I>
    explicit ColorMapTable(std::index_sequence<I...>) : maps{((void)I, ColorMap())...} {
        for (std::size_t m = 0; m < kColorMapCount; ++m) {
            maps[m].id_ = static_cast<ColorMapId>(m);
            for (std::size_t i = 0; i < 256; ++i) maps[m].entries_[i] = entry(maps[m].id_, i);
        }
    }
};

const ColorMap& ColorMap::get(ColorMapId id) {
    static const ColorMapTable kTable{std::make_index_sequence<kColorMapCount>()};
    return kTable.maps[std::min(static_cast<std::size_t>(id), kColorMapCount - 1)];
}

std::string_view ColorMap::name() const { return analysis::name(id_); }

Color8 ColorMap::map(double t) const {
    if (std::isnan(t)) return kNaNColor;
    return entries_[static_cast<std::size_t>(std::clamp(t * 256, 0.0, 255.0))];
}

std::string_view name(ColorMapId id) { return kNames[std::min(static_cast<std::size_t>(id), kColorMapCount - 1)]; }

std::optional<ColorMapId> colorMapByName(std::string_view name) {
    for (std::size_t i = 0; i < kColorMapCount; ++i)
        if (kNames[i] == name) return static_cast<ColorMapId>(i);
    return std::nullopt;
}

bool ValueRange::isValid() const {
    return std::isfinite(min) && std::isfinite(max) && min < max && std::isfinite(max - min) && (!log || min > 0);
}

double ValueRange::position(double value) const {
    if (std::isnan(value)) return value;
    if (!isValid()) return 0.5;
    if (!log) return (value - min) / (max - min);
    if (value <= 0) return -std::numeric_limits<double>::infinity();
    return std::log(value / min) / std::log(max / min);
}

double ValueRange::value(double position) const {
    if (!isValid()) return min;
    if (!log) return position == 1 ? max : min + position * (max - min);
    return position == 1 ? max : min * std::pow(max / min, position);
}

ValueRange ValueRange::repaired() const {
    if (isValid()) return *this;
    ValueRange r = *this;
    if (r.min > r.max) std::swap(r.min, r.max);
    if (r.isValid()) return r;
    constexpr double kDecades = 1e-6;
    // Halves of the largest double, so that max - min stays finite.
    constexpr double kLargest = std::numeric_limits<double>::max() / 4;
    if (std::isfinite(r.min)) r.min = std::clamp(r.min, -kLargest, kLargest);
    if (std::isfinite(r.max)) r.max = std::clamp(r.max, -kLargest, kLargest);
    if (r.log) {
        if (!std::isfinite(r.max) || r.max <= 0) r.max = std::isfinite(r.min) && r.min > 0 ? r.min * 10 : 1;
        if (!std::isfinite(r.min) || r.min <= 0) r.min = r.max * kDecades;
        if (r.min == 0) return {kDecades, 1, true};  // max so small that its share vanished
        if (r.min == r.max) r = {r.min / 10, r.max * 10, true};
        return r.isValid() ? r : ValueRange{kDecades, 1, true};
    }
    if (!std::isfinite(r.min) && !std::isfinite(r.max)) return {};
    if (!std::isfinite(r.min)) r.min = r.max - 1;
    if (!std::isfinite(r.max)) r.max = r.min + 1;
    if (r.min > r.max) std::swap(r.min, r.max);
    if (r.min == r.max) {
        const double half = r.min == 0 ? 0.5 : std::abs(r.min) * 0.5;
        r.min -= half;
        r.max += half;
    }
    return r.isValid() ? r : ValueRange{};
}

}  // namespace emca::analysis
