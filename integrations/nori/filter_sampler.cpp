#include "filter_sampler.h"

#include <algorithm>
#include <cmath>

namespace emca::nori_adapter {

FilterSampler::FilterSampler(const nori::ReconstructionFilter& filter) : radius_(filter.getRadius()) {
    constexpr int kSteps = 512;
    std::vector<double> values;
    double sum = 0, absolute = 0;
    for (int i = 0; i < kSteps; ++i) {
        values.push_back(double(filter.eval((2 * (float(i) + 0.5f) / kSteps - 1) * radius_)));
        sum += values.back();
        absolute += std::abs(values.back());
    }
    double running = 0;
    for (const double value : values) {
        running += std::abs(value);
        cumulative_.push_back(static_cast<float>(running / absolute));
        weights_.push_back(static_cast<float>((value < 0 ? -1 : 1) * absolute / sum));
    }
}

FilterSampler::Offset FilterSampler::sample(float u) const {
    const auto step = std::min(static_cast<std::size_t>(std::upper_bound(cumulative_.begin(), cumulative_.end(), u) - cumulative_.begin()),
                               cumulative_.size() - 1);
    const float before = step > 0 ? cumulative_[step - 1] : 0.f, width = cumulative_[step] - before;
    const float within = width > 0 ? std::clamp((u - before) / width, 0.f, 1.f) : 0.5f;
    return {(2 * (float(step) + within) / float(cumulative_.size()) - 1) * radius_, weights_[step]};
}

}  // namespace emca::nori_adapter
