#pragma once

#include <cstdint>
#include <vector>

#include "emca/core/color.h"

namespace emca {

/// What the samples of a pixel have added up to, in double precision, where neither a million samples nor their squares
/// lose digits that a float could show. Added in the order of their indices, they give the same bits in an image and in
/// a replay. A plain value.
class PixelSums {
  public:
    void add(Color radiance) { red_.add(radiance.r), green_.add(radiance.g), blue_.add(radiance.b), ++count_; }
    std::uint32_t count() const { return count_; }
    /// 0 / 0, so NaN, without samples.
    Color mean() const { return {red_.mean(count_), green_.mean(count_), blue_.mean(count_)}; }
    /// Unbiased, of the samples (not of their mean); 0 with fewer than 2.
    Color variance() const { return {red_.variance(count_), green_.variance(count_), blue_.variance(count_)}; }

  private:
    struct Channel {
        double sum = 0, squares = 0;
        void add(float value) {
            sum += double(value);
            squares += double(value) * double(value);
        }
        float mean(double count) const { return static_cast<float>(sum / count); }
        float variance(double count) const {
            if (count < 2) return 0.f;
            const double variance = (squares - sum * sum / count) / (count - 1);
            return static_cast<float>(variance < 0 ? 0 : variance);  // NaN stays NaN
        }
    };
    Channel red_, green_, blue_;
    std::uint32_t count_ = 0;
};

/// Part of the samples of every pixel of an image.
struct SampleRange {
    std::uint32_t first = 0, last = 0;  ///< indices; `last` is the first one that is not part of it
    friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

/// In how many goes over the image to take its samples. A pixel's samples all at once are best for the caches. But a face
/// on which samples are collected hands those that it had before it was divided down by the density of those after: they
/// must not come from another part of it. So where surface layers are collected, faces divide between passes over the
/// image (SurfaceRecorder::passDone), which get longer: each doubles the samples, as long as three quarters of all are
/// still to come.
std::vector<SampleRange> samplePasses(std::uint32_t samplesPerPixel, bool collectsLayers);

}  // namespace emca
