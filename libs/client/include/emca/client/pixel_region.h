#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "emca/core/pixel.h"

namespace emca::client {

/// A set of pixels of an image: a rectangle that a person drew, or single ones picked together. A value: copies share
/// the list, which never changes, so that each step of an undo history may hold one of millions of pixels.
class PixelRegion {
  public:
    PixelRegion() = default;
    /// \param pixels  in any order; duplicates count once
    explicit PixelRegion(std::vector<Pixel> pixels);
    explicit PixelRegion(const PixelRect& rect);

    std::size_t size() const { return pixels_ ? pixels_->size() : 0; }
    bool empty() const { return size() == 0; }
    /// In reading order. As long as this region, or a copy of it, lives.
    std::span<const Pixel> pixels() const { return pixels_ ? std::span<const Pixel>(*pixels_) : std::span<const Pixel>(); }
    bool contains(Pixel pixel) const;
    /// The smallest rectangle around them; empty if there are none.
    PixelRect bounds() const { return bounds_; }
    /// Every pixel of bounds() belongs to it.
    bool isRectangle() const { return size() == bounds_.count(); }

    PixelRegion with(const PixelRegion& others) const;
    /// Adds the pixel, or takes it away if it is there.
    PixelRegion toggled(Pixel pixel) const;

    /// "pixel (3, 4)", "region 8x8 at (12, 30)", "5 pixels around (12, 30)": the place is the top-left corner of a
    /// rectangle and else the middle of the bounds. Empty if there are none.
    std::string text() const;

    friend bool operator==(const PixelRegion& a, const PixelRegion& b) {
        return a.pixels_ == b.pixels_ || (a.size() == b.size() && a.bounds_ == b.bounds_ &&
                                          (a.isRectangle() || a.size() == 0 || *a.pixels_ == *b.pixels_));
    }

  private:
    std::shared_ptr<const std::vector<Pixel>> pixels_;   // null if empty
    PixelRect bounds_;
};

}  // namespace emca::client
