#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/result.h"

namespace emca::render {

/// Pixels of an image file as a texture reads them: linear Rec. 709, row 0 at the top. Images of 8 bits stay so in
/// memory and are made linear by a table at each look-up, others become floats.
class TextureImage {
  public:
    /// How the numbers of a file become linear.
    struct Options {
        /// Exponent; 1: they are linear; nothing: sRGB for integer formats, linear for floating-point ones.
        std::optional<float> gamma;
        std::string channel;  ///< one channel as a grey image ("r", "a", or a layer's full name); empty: colours
    };
    /// Errors: fileNotFound, fileUnreadable, notSupported (no such channel), tooLarge, outOfMemory.
    static Result<std::shared_ptr<const TextureImage>> read(const std::filesystem::path& file, const Options& options);

    /// \param channels  1 or 3 floats per pixel, rows from the top; linear
    TextureImage(int width, int height, int channels, std::vector<float> linear);
    /// \param channels  1 or 3 bytes per pixel, rows from the top
    /// \param toLinear  value of each byte
    TextureImage(int width, int height, int channels, std::vector<std::uint8_t> bytes,
                 const std::array<float, 256>& toLinear);

    int width() const { return width_; }
    int height() const { return height_; }
    /// \param x, y  inside the image
    Color texel(int x, int y) const {
        const std::size_t at =
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
            static_cast<std::size_t>(channels_);
        if (!bytes_.empty()) {
            if (channels_ == 1) return Color(toLinear_[bytes_[at]]);
            return {toLinear_[bytes_[at]], toLinear_[bytes_[at + 1]], toLinear_[bytes_[at + 2]]};
        }
        if (channels_ == 1) return Color(floats_[at]);
        return {floats_[at], floats_[at + 1], floats_[at + 2]};
    }
    /// Average over all pixels; computed when first asked for. Any thread.
    Color mean() const;

  private:
    Color computedMean() const;

    int width_, height_, channels_;
    std::vector<std::uint8_t> bytes_;
    std::array<float, 256> toLinear_{};
    std::vector<float> floats_;
    mutable Color mean_;
    mutable std::once_flag meanComputed_;
};

/// Linear value of an sRGB-encoded one in [0, 1] (IEC 61966-2-1).
float linearFromSrgb(float encoded);

}  // namespace emca::render
