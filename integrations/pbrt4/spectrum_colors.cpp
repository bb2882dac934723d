#include "spectrum_colors.h"

#include "inside.h"

namespace emca::pbrt4 {

SpectrumColors::SpectrumColors(pbrt::Film film) : sensor_(film.GetPixelSensor()) {
    const pbrt::RGBColorSpace& space = *inside::settings(film).colorSpace;
    const pbrt::RGBColorSpace& rec709 = *pbrt::RGBColorSpace::sRGB;  // the same primaries and white, linear
    isRec709_ = space == rec709;
    rec709FromFilm_ = pbrt::ConvertRGBColorSpace(space, rec709);
    rec709FromSensor_ = rec709.RGBFromXYZ * sensor_->XYZFromSensorRGB;
    const pbrt::XYZ white = rec709.ToXYZ(pbrt::RGB(1, 1, 1));
    rec709FromWeighted_ = rec709.RGBFromXYZ * pbrt::SquareMatrix<3>::Diag(white.X, white.Y, white.Z);
}

Color SpectrumColors::factor(const pbrt::SampledSpectrum& spectrum, const pbrt::SampledWavelengths& lambda) const {
    const pbrt::SampledSpectrum density = lambda.PDF();
    const pbrt::SampledSpectrum matching[3] = {pbrt::Spectra::X().Sample(lambda), pbrt::Spectra::Y().Sample(lambda),
                                               pbrt::Spectra::Z().Sample(lambda)};
    float means[3];
    for (int c = 0; c < 3; ++c) {
        float sum = 0, weights = 0, plain = 0;
        int wavelengths = 0;
        for (int i = 0; i < pbrt::NSpectrumSamples; ++i) {
            if (density[i] == 0) continue;  // a path that disperses goes on with its first wavelength alone
            const float weight = matching[c][i] / density[i];
            sum += weight * spectrum[i], weights += weight;
            plain += spectrum[i], ++wavelengths;
        }
        means[c] = weights > 0 ? sum / weights : wavelengths > 0 ? plain / float(wavelengths) : 0.f;
    }
    return toColor(pbrt::Mul<pbrt::RGB>(rec709FromWeighted_, pbrt::XYZ(means[0], means[1], means[2])));
}

Color SpectrumColors::rec709(const pbrt::RGB& rgb) const {
    return toColor(isRec709_ ? rgb : pbrt::Mul<pbrt::RGB>(rec709FromFilm_, rgb));
}

}  // namespace emca::pbrt4
