#include "emca/analysis/tone_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace emca::analysis {
namespace {

constexpr int kMantissaBits = 9;  // fine enough that a cell holds at most one step of the 8-bit curve
constexpr int kShift = 23 - kMantissaBits;
constexpr int kSmallestExponent = -73;  // below 2^-73 every curve up to gamma 8 rounds to 0
constexpr std::uint32_t kFirstCell = static_cast<std::uint32_t>(127 + kSmallestExponent) << kMantissaBits;
// Up to infinity, so that bright pixels need no branch, which noise would make unpredictable.
constexpr std::uint32_t kCells =
    (std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity()) >> kShift) - kFirstCell + 1;

double encodeSrgbExact(double x) { return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055; }

double encodeExact(double x, const ToneMap& settings) {
    switch (settings.transfer) {
        case Transfer::srgb:
            return encodeSrgbExact(x);
        case Transfer::gamma:
            return std::pow(x, 1.0 / static_cast<double>(settings.gamma));
        case Transfer::linear:
            break;
    }
    return x;
}

ToneMap sanitized(ToneMap settings) {
    settings.exposure = std::isfinite(settings.exposure) ? std::clamp(settings.exposure, -100.f, 100.f) : 0.f;
    settings.gamma = std::isfinite(settings.gamma) ? std::clamp(settings.gamma, 0.25f, 8.f) : 2.2f;
    return settings;
}

void store(Color8 color, std::uint8_t* out) {
    out[0] = color.r;
    out[1] = color.g;
    out[2] = color.b;
    out[3] = color.a;
}

/// Diagonal stripes, so that clipping is seen on white as on saturated colours.
bool onStripe(std::uint32_t x, std::uint32_t y) { return ((x + y) & 7u) < 3u; }

}  // namespace

float encodeSrgb(float linear) {
    const double x = static_cast<double>(linear);
    return static_cast<float>(x < 0 ? -encodeSrgbExact(-x) : encodeSrgbExact(x));
}

float decodeSrgb(float encoded) {
    const double sign = encoded < 0 ? -1 : 1, x = std::abs(static_cast<double>(encoded));
    // 0.04045: the threshold of the standard, where both pieces meet to 8 digits.
    return static_cast<float>(sign * (x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4)));
}

/// For each cell of float bits the 8-bit level at its start; `next[level]` is the smallest float that rounds to a
/// higher level, so that the result is exact.
struct ToneMapper::Table {
    std::array<std::uint8_t, kCells> level{};
    std::array<float, 256> next{};

    explicit Table(const ToneMap& settings) {
        for (int k = 0; k < 255; ++k) next[static_cast<std::size_t>(k)] = threshold((k + 0.5) / 255, settings);
        next[255] = std::numeric_limits<float>::quiet_NaN();  // nothing is beyond
        std::size_t current = 0;
        for (std::uint32_t cell = 0; cell < kCells; ++cell) {
            const float start = std::bit_cast<float>((cell + kFirstCell) << kShift);
            while (current < 255 && start >= next[current]) ++current;
            level[cell] = static_cast<std::uint8_t>(current);
        }
    }

    /// Smallest float in (0, 1] whose encoded value reaches `encoded`; bits of positive floats are in their order.
    static float threshold(double encoded, const ToneMap& settings) {
        std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.f);
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            const bool reached = encodeExact(static_cast<double>(std::bit_cast<float>(middle)), settings) >= encoded;
            (reached ? high : low) = reached ? middle : middle + 1;
        }
        return std::bit_cast<float>(low);
    }
};

ToneMapper::ToneMapper(const ToneMap& settings)
    : settings_(sanitized(settings)),
      scale_(std::exp2(settings_.exposure)),
      table_(std::make_shared<const Table>(settings_)) {}

std::uint8_t ToneMapper::encode(float x) const {
    const std::uint32_t cell = (std::bit_cast<std::uint32_t>(x) >> kShift) - kFirstCell;
    if (cell >= kCells)
        return 0;  // zero and tiny values wrap to large numbers; negative ones and NaN are beyond infinity
    const std::uint8_t level = table_->level[cell];
    return static_cast<std::uint8_t>(level + (x >= table_->next[level]));
}

std::uint8_t ToneMapper::channel(float linear) const { return encode(linear * scale_); }

Color8 ToneMapper::color(Color linear) const {
    if (settings_.markInvalid && !isFinite(linear)) {
        const bool nan = std::isnan(linear.r) || std::isnan(linear.g) || std::isnan(linear.b);
        return nan ? kNaNColor : kInfinityColor;
    }
    return {channel(linear.r), channel(linear.g), channel(linear.b), 255};
}

bool ToneMapper::mark(const float* rgb, std::uint32_t x, std::uint32_t y, std::uint8_t* out) const {
    const Color c(rgb[0], rgb[1], rgb[2]);
    if (settings_.markInvalid && !isFinite(c)) {
        store(color(c), out);
        return true;
    }
    if (settings_.markInvalid && (c.r < 0 || c.g < 0 || c.b < 0)) {
        store(kNegativeColor, out);
        return true;
    }
    if (settings_.markClipped && clips(c) && onStripe(x, y)) {
        store({0, 0, 0, 255}, out);
        return true;
    }
    return false;
}

void ToneMapper::convert(const Image& image, std::span<std::uint8_t> rgba, std::uint32_t firstRow,
                         std::uint32_t lastRow) const {
    assert(rgba.size() == std::size_t(4) * image.width() * image.height());
    const std::size_t channels = image.channelCount();
    if (channels == 0) return;
    const float limit = settings_.markClipped ? 1.f / scale_ : std::numeric_limits<float>::max();
    const std::size_t second = channels >= 3 ? 1 : 0, third = channels >= 3 ? 2 : 0;
    lastRow = std::min(lastRow, image.height());
    for (std::uint32_t y = firstRow; y < lastRow; ++y) {
        const float* in = image.at({0, y});
        std::uint8_t* out = rgba.data() + std::size_t(4) * y * image.width();
        for (std::uint32_t x = 0; x < image.width(); ++x, in += channels, out += 4) {
            const float rgb[3] = {in[0], in[second], in[third]};
            const bool plain =
                rgb[0] >= 0 && rgb[0] <= limit && rgb[1] >= 0 && rgb[1] <= limit && rgb[2] >= 0 && rgb[2] <= limit;
            if (!plain && mark(rgb, x, y, out)) continue;
            out[0] = encode(rgb[0] * scale_);
            out[1] = encode(rgb[1] * scale_);
            out[2] = encode(rgb[2] * scale_);
            out[3] = 255;
        }
    }
}

void ToneMapper::convertChannel(const Image& image, ChannelChoice choice, std::span<std::uint8_t> rgba) const {
    assert(rgba.size() == std::size_t(4) * image.width() * image.height());
    std::uint8_t* out = rgba.data();
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x, out += 4) {
            const float value = scalar(image, {x, y}, choice);
            const float grey[3] = {value, value, value};
            if (mark(grey, x, y, out)) continue;
            const std::uint8_t level = channel(value);
            store({level, level, level, 255}, out);
        }
}

float scalar(const Image& image, Pixel pixel, ChannelChoice choice) {
    const std::uint32_t channels = image.channelCount();
    if (channels == 0) return 0;
    const float* v = image.at(pixel);
    if (choice.index >= 0) return v[std::min(static_cast<std::uint32_t>(choice.index), channels - 1)];
    return channels >= 3 ? luminance(Color(v[0], v[1], v[2])) : v[0];
}

std::vector<float> scalars(const Image& image, ChannelChoice choice) {
    std::vector<float> values(std::size_t(image.width()) * image.height());
    std::size_t i = 0;
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) values[i++] = scalar(image, {x, y}, choice);
    return values;
}

void falseColor(const Image& image, ChannelChoice choice, const ColorMap& map, const ValueRange& range,
                std::span<std::uint8_t> rgba) {
    assert(rgba.size() == std::size_t(4) * image.width() * image.height());
    const ValueRange valid = range.repaired();
    // entry = scale * f(value) + offset, with f the logarithm on logarithmic ranges.
    const double start = valid.log ? std::log(valid.min) : valid.min, end = valid.log ? std::log(valid.max) : valid.max;
    const double scale = 256 / (end - start), offset = -start * scale;
    const std::span<const Color8, 256> entries = map.entries();
    std::uint8_t* out = rgba.data();
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x, out += 4) {
            const float value = scalar(image, {x, y}, choice);
            if (!std::isfinite(value)) {
                store(std::isnan(value) ? kNaNColor : kInfinityColor, out);
                continue;
            }
            double position = 0;
            if (!valid.log)
                position = static_cast<double>(value) * scale + offset;
            else if (value > 0)
                position = static_cast<double>(std::log(value)) * scale + offset;
            store(entries[static_cast<std::size_t>(std::clamp(position, 0.0, 255.0))], out);
        }
}

}  // namespace emca::analysis
