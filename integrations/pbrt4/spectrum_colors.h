#pragma once

#include "emca/core/color.h"
#include "pbrt_headers.h"

namespace emca::pbrt4 {

/// Spectra at the wavelengths of a path as linear Rec. 709. A plain value; reads only, from any thread.
class SpectrumColors {
  public:
    explicit SpectrumColors(pbrt::Film film);

    /// Radiance as the film's sensor sees it: linear in the spectrum, so that parts add up to the whole and samples to
    /// the pixel. Four wavelengths tell little about colour: that of one sample is noise, that of many is right.
    Color radiance(const pbrt::SampledSpectrum& spectrum, const pbrt::SampledWavelengths& lambda) const {
        return toColor(pbrt::Mul<pbrt::RGB>(rec709FromSensor_, sensor_->ToSensorRGB(spectrum, lambda)));
    }

    /// A factor without unit, such as a throughput: the mean of its values, weighted by how much each wavelength has to
    /// do with X, Y and Z. What is the same for all wavelengths is grey in every sample; products are products of
    /// colours only roughly.
    Color factor(const pbrt::SampledSpectrum& spectrum, const pbrt::SampledWavelengths& lambda) const;

    /// A colour of the film.
    Color rec709(const pbrt::RGB& rgb) const;

  private:
    static Color toColor(const pbrt::RGB& rgb) { return {float(rgb.r), float(rgb.g), float(rgb.b)}; }

    const pbrt::PixelSensor* sensor_;
    bool isRec709_;
    pbrt::SquareMatrix<3> rec709FromFilm_, rec709FromSensor_;
    pbrt::SquareMatrix<3> rec709FromWeighted_;  ///< of the weighted means at X, Y and Z
};

}  // namespace emca::pbrt4
