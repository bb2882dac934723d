#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emca/core/vector.h"

namespace emca::render {

/// Discrete choice in proportion to given weights. Negative and non-finite weights count as zero; if all are zero,
/// every entry is as likely.
class Distribution1D {
  public:
    Distribution1D() = default;
    explicit Distribution1D(std::span<const float> weights);

    struct Choice {
        std::size_t index = 0;
        float probability = 0;
        float remainder = 0;  ///< what is left of u, again uniform in [0, 1)
    };
    /// \param u in [0, 1). Not for empty distributions.
    Choice sample(float u) const;
    float probability(std::size_t index) const { return cumulative_[index + 1] - cumulative_[index]; }
    std::size_t size() const { return cumulative_.empty() ? 0 : cumulative_.size() - 1; }
    double total() const { return total_; }  ///< sum of the weights

  private:
    std::vector<float> cumulative_;  ///< size() + 1 values from 0 to 1
    double total_ = 0;
};

/// Point in [0, 1)^2 with a density that is constant in each cell of a grid.
class Distribution2D {
  public:
    Distribution2D() = default;
    /// \param weights row by row, width * height; each proportional to the density in its cell
    Distribution2D(std::span<const float> weights, std::uint32_t width, std::uint32_t height);

    struct Choice {
        Vec2f point;
        float pdf = 0;  ///< per unit of the square's area
    };
    Choice sample(Vec2f u) const;
    float pdf(Vec2f point) const;

  private:
    std::uint32_t width_ = 0, height_ = 0;
    Distribution1D rows_;
    std::vector<Distribution1D> columns_;  ///< one per row
};

}  // namespace emca::render
