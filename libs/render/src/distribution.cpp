#include "emca/render/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "emca/render/sampling_functions.h"

namespace emca::render {

namespace {

constexpr std::size_t kShortDistribution = 8;

}  // namespace

Distribution1D::Distribution1D(std::span<const float> weights) {
    if (weights.empty()) return;
    const auto usable = [](float weight) { return std::isfinite(weight) && weight > 0.f ? double(weight) : 0.0; };
    for (const float weight : weights) total_ += usable(weight);

    cumulative_.resize(weights.size() + 1);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += total_ > 0 ? usable(weights[i]) / total_ : 1.0 / static_cast<double>(weights.size());
        cumulative_[i + 1] = static_cast<float>(std::min(sum, 1.0));
    }
    // Entries of weight zero at the end must stay impossible.
    std::size_t last = weights.size();
    while (total_ > 0 && last > 1 && usable(weights[last - 1]) == 0) --last;
    for (std::size_t i = last; i < cumulative_.size(); ++i) cumulative_[i] = 1.f;
}

Distribution1D::Choice Distribution1D::sample(float u) const {
    assert(!cumulative_.empty());
    // The first entry whose upper end is beyond u: entries of width zero are never chosen.
    std::size_t index = 0;
    const std::size_t last = size() - 1;
    if (last < kShortDistribution) {
        for (std::size_t i = 1; i <= last; ++i) index += u >= cumulative_[i] ? 1u : 0u;  // no branch to mispredict
    } else {
        index = static_cast<std::size_t>(std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u) -
                                         cumulative_.begin()) - 1;
    }
    const float width = probability(index);
    const float remainder = width > 0.f ? (u - cumulative_[index]) / width : 0.f;
    return {index, width, std::clamp(remainder, 0.f, kOneMinusEpsilon)};
}

Distribution2D::Distribution2D(std::span<const float> weights, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height) {
    assert(weights.size() == std::size_t(width) * height && width > 0 && height > 0);
    std::vector<float> rowWeights(height);
    columns_.reserve(height);
    for (std::uint32_t y = 0; y < height; ++y) {
        columns_.emplace_back(weights.subspan(std::size_t(y) * width, width));
        rowWeights[y] = static_cast<float>(columns_.back().total());
    }
    rows_ = Distribution1D(rowWeights);
}

Distribution2D::Choice Distribution2D::sample(Vec2f u) const {
    const auto row = rows_.sample(u.y);
    const auto column = columns_[row.index].sample(u.x);
    const auto place = [](std::size_t index, float remainder, std::uint32_t count) {
        return std::min((static_cast<float>(index) + remainder) / static_cast<float>(count), kOneMinusEpsilon);
    };
    return {{place(column.index, column.remainder, width_), place(row.index, row.remainder, height_)},
            row.probability * column.probability * static_cast<float>(width_) * static_cast<float>(height_)};
}

float Distribution2D::pdf(Vec2f point) const {
    const auto cell = [](float x, std::uint32_t count) {
        return static_cast<std::size_t>(std::clamp(x * static_cast<float>(count), 0.f, static_cast<float>(count - 1)));
    };
    const std::size_t row = cell(point.y, height_);
    return rows_.probability(row) * columns_[row].probability(cell(point.x, width_)) * static_cast<float>(width_) *
           static_cast<float>(height_);
}

}  // namespace emca::render
