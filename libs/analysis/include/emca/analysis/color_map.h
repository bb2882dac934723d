#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace emca::analysis {

/// A colour of the screen: sRGB-encoded, 8 bits each, not premultiplied. Four bytes in this order.
struct Color8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend constexpr bool operator==(const Color8&, const Color8&) = default;
};

// What no colour map contains: values that are no numbers or that an image should not have.
inline constexpr Color8 kNaNColor{255, 0, 220};
inline constexpr Color8 kInfinityColor{255, 120, 255};
inline constexpr Color8 kNegativeColor{0, 90, 255};

/// Interval of values that a colour map, an axis or a histogram spans.
/// Valid: both finite, min < max, and min > 0 if logarithmic.
struct ValueRange {
    double min = 0, max = 1;
    bool log = false;

    bool isValid() const;
    /// Where a value is: 0 at min, 1 at max, beyond for values outside. NaN for NaN, and for an invalid range 0.5;
    /// logarithmic: -infinity for values <= 0.
    double position(double value) const;
    /// Inverse of position().
    double value(double position) const;
    /// The nearest valid range: ends sorted, an empty one widened, a non-positive start of a logarithmic one replaced
    /// by max / 1e6; [0, 1] (log: [1e-6, 1]) where nothing can be kept.
    ValueRange repaired() const;
    friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// Viridis, plasma, inferno, magma: van der Walt and Smith, 2015 (CC0). Turbo: Mikhailov, Google, 2019 (Apache-2.0).
/// Cividis: Nuñez, Anderton, Renslow, PLoS ONE 13(7), 2018. Grey: even steps of sRGB. redGreen: red for negative,
/// black at 0, green for positive; blueOrange: the same for eyes that do not tell red from green.
enum class ColorMapId : std::uint8_t {
    viridis = 0, plasma = 1, inferno = 2, magma = 3, turbo = 4, cividis = 5, grey = 6, redGreen = 7, blueOrange = 8,
};
inline constexpr std::size_t kColorMapCount = 9;

/// 256 colours over [0, 1]. Instances live as long as the program; use them by reference.
class ColorMap {
  public:
    static const ColorMap& get(ColorMapId id);

    ColorMapId id() const { return id_; }
    std::string_view name() const;  ///< "viridis", …, for people and settings
    /// Diverging maps belong on ranges symmetric about 0.
    bool isDiverging() const { return id_ == ColorMapId::redGreen || id_ == ColorMapId::blueOrange; }
    std::span<const Color8, 256> entries() const { return std::span<const Color8, 256>(entries_, 256); }

    /// Colour at t: clamped to [0, 1] (so infinities are the ends), kNaNColor for NaN. Each entry covers 1/256.
    Color8 map(double t) const;
    Color8 map(double value, const ValueRange& range) const { return map(range.position(value)); }

  private:
    friend struct ColorMapTable;
    ColorMap() = default;
    ColorMapId id_ = ColorMapId::viridis;
    Color8 entries_[256];
};

/// Nothing for an unknown name.
std::optional<ColorMapId> colorMapByName(std::string_view name);
std::string_view name(ColorMapId id);

}  // namespace emca::analysis
