#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/core/color.h"
#include "emca/core/image.h"
#include "emca/core/pixel.h"

namespace emca::analysis {

/// How linear light becomes the numbers of the screen. In [0, 1]; values outside are continued, not clamped, negative
/// ones by the odd continuation. Source: IEC 61966-2-1 (sRGB: slope 12.92 below 0.0031308, 1.055 x^(1/2.4) - 0.055).
float encodeSrgb(float linear);
float decodeSrgb(float encoded);

enum class Transfer : std::uint8_t { srgb = 0, gamma = 1, linear = 2 };

/// Settings of an image view.
struct ToneMap {
    float exposure = 0;                  ///< in stops: values are multiplied by 2^exposure. Not finite counts as 0.
    Transfer transfer = Transfer::srgb;
    float gamma = 2.2f;                  ///< of Transfer::gamma: encoded = linear^(1/gamma); kept within [0.25, 8]
    bool markInvalid = true;             ///< NaN, infinite and negative pixels get their colours of color_map.h
    bool markClipped = false;            ///< pixels with a channel above 1 after exposure get stripes
    friend bool operator==(const ToneMap&, const ToneMap&) = default;
};

/// What of an image is shown as one number or one grey.
struct ChannelChoice {
    static constexpr int kLuminance = -1;
    int index = kLuminance;              ///< a channel of the image, or kLuminance (a single channel is its own)
};

/// Exact 8-bit rounding of a tone curve by one table look-up on the bits of the float. Make it once per setting: making
/// takes some 0.3 ms. Immutable; may be used from several threads at once.
class ToneMapper {
  public:
    explicit ToneMapper(const ToneMap& settings = {});
    const ToneMap& settings() const { return settings_; }

    /// One channel in [0, 255]: exposure, transfer, clamped, rounded to nearest. NaN is 0.
    std::uint8_t channel(float linear) const;
    /// A colour without marks of clipping, e.g. for swatches. NaN and infinite colours are marked if settings say so.
    Color8 color(Color linear) const;
    /// True if a swatch or pixel cannot show how bright it is: a channel above 1 after exposure.
    bool clips(Color linear) const { return maxComponent(linear) * scale_ > 1.f; }

    /// A whole image to RGBA, row by row from the top; images with fewer than three channels become grey. An alpha
    /// channel named "A" is not blended. 1920x1080 takes some 10 ms on one thread.
    /// \param rgba  4 * width * height bytes, exactly
    /// Rows [firstRow, lastRow) only, so that threads can share the work; others stay untouched.
    void convert(const Image& image, std::span<std::uint8_t> rgba, std::uint32_t firstRow, std::uint32_t lastRow) const;
    void convert(const Image& image, std::span<std::uint8_t> rgba) const { convert(image, rgba, 0, image.height()); }
    /// One channel (or luminance) as grey.
    void convertChannel(const Image& image, ChannelChoice channel, std::span<std::uint8_t> rgba) const;

  private:
    std::uint8_t encode(float x) const;
    bool mark(const float* rgb, std::uint32_t x, std::uint32_t y, std::uint8_t* out) const;
    ToneMap settings_;
    float scale_ = 1;
    struct Table;
    std::shared_ptr<const Table> table_;
};

/// Luminance or a channel through a colour map. NaN, infinite and (on logarithmic ranges) values <= 0: NaN and infinity
/// get kNaNColor and kInfinityColor, values <= 0 the first colour.
/// \param rgba  4 * width * height bytes, exactly
void falseColor(const Image& image, ChannelChoice channel, const ColorMap& map, const ValueRange& range,
                std::span<std::uint8_t> rgba);

/// Number of a pixel under a choice: luminance of the first three channels, or the channel's value.
float scalar(const Image& image, Pixel pixel, ChannelChoice channel);
/// The same of all pixels, row by row.
std::vector<float> scalars(const Image& image, ChannelChoice channel);

}  // namespace emca::analysis
