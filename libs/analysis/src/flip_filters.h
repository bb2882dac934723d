#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "emca/core/color.h"
#include "flip_color.h"

namespace emca::analysis {

/// One half of a filter of odd length: weights[k] belongs to distance k. An even filter has equal, an odd one opposite
/// weights on both sides.
using HalfKernel = std::vector<float>;

/// The filters of FLIP for one screen. All of them are products of a row filter and a column filter.
struct FlipFilters {
    explicit FlipFilters(double pixelsPerDegree);

    // Contrast sensitivity ([LDR] section 4.1.1, table 1): Gaussians of the opponent channels; blue-yellow is the sum
    // of two.
    HalfKernel achromatic, redGreen, blueYellowWide, blueYellowNarrow;
    float wideShare = 1;  ///< of blue-yellow
    // Detection of features ([LDR] section 4.2): a Gaussian, its first and its second derivative.
    HalfKernel smooth, edge, point;
    std::size_t radius = 0;  ///< of the longest
};

/// What one row of an image is to an eye.
struct PerceivedRow {
    std::vector<HuntLab> color;  ///< after contrast sensitivity, clipped to the screen
    std::vector<float> edge,
        point;  ///< lengths of gradient and of second derivative of the achromatic channel, in [0, √2]
};

/// Filters an image row by row; keeps as many rows as the longest filter is long. Beyond its borders an image continues
/// with its outermost pixels.
class PerceivedImage {
  public:
    /// Writes the pixels of a row, in [0, 1].
    using Source = std::function<void(std::uint32_t y, std::span<Color> row)>;
    PerceivedImage(const FlipFilters& filters, std::uint32_t width, std::uint32_t height, Source source);
    /// Rows are asked for from the top down, each once. The answer is valid until the next call.
    const PerceivedRow& row(std::uint32_t y);

  private:
    enum Plane : std::size_t { kAchromatic, kRedGreen, kWide, kNarrow, kSmooth, kEdge, kPoint, kPlaneCount };
    void load(std::uint32_t y);
    float* line(Plane plane, std::size_t y);
    void column(Plane plane, const HalfKernel& kernel, std::uint32_t y, bool odd, std::vector<float>& out);

    const FlipFilters& filters_;
    std::uint32_t width_, height_, loaded_ = 0;
    std::size_t slots_;
    Source source_;
    std::vector<Color> colors_;
    std::vector<float> padded_[3];   // opponent channels of the row that is being loaded
    std::vector<float> lines_;       // row-filtered planes of `slots_` rows
    std::vector<float> columns_[6];  // of the row that is being answered
    std::vector<const float*> before_, after_;
    PerceivedRow row_;
};

}  // namespace emca::analysis
