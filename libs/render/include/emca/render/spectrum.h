#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"

namespace emca::render {

// Spectra of scene files, which become colours when they are read: the renderer calculates with RGB.

/// A spectrum is linear between its samples and 0 outside.
struct SpectrumSample {
    double wavelength = 0;  ///< nm
    double value = 0;
    friend bool operator==(const SpectrumSample&, const SpectrumSample&) = default;
};

/// Whether a spectrum is a ratio (reflectance, index of refraction; white is what reflects all equally) or light
/// (white is D65, so that a spectrum that is equal everywhere is slightly reddish).
enum class SpectrumUse { ratio, light };

/// The standard observer's response to one wavelength in nm: CIE 1931 XYZ, 2 degrees.
/// Source: Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions",
/// JCGT 2013, equation 4 (multi-lobe fit).
Vec3d cieXyz(double wavelength);

/// Linear Rec. 709; negative components (colours outside of its gamut) become 0. \param samples in any order.
/// Ratios: adapted from illuminant E to D65 (Bradford transform; Lam 1985), so that the spectrum that is 1 everywhere
/// gives (1, 1, 1). Light: XYZ divided by the integral of y, so that a flat spectrum of 1 per nm has luminance 1.
Color toRgb(std::span<const SpectrumSample> samples, SpectrumUse use);

/// Radiance of a black body, W/(sr m^2) per nm of a spectrum as in toRgb(…, light). Planck's law.
/// \param kelvin  > 0
Color blackbodyRgb(double kelvin);

/// "400:0.1, 500:0.2": pairs separated by commas or blanks. Errors: parseFailed.
Result<std::vector<SpectrumSample>> parseSpectrum(std::string_view text);

/// A file with "wavelength value" in each line; # begins a comment.
/// Errors: fileNotFound, fileUnreadable (with the line).
Result<std::vector<SpectrumSample>> readSpectrumFile(const std::filesystem::path& path);

/// Linear value of an sRGB-encoded one (IEC 61966-2-1), per component.
float srgbToLinear(float encoded);

}  // namespace emca::render
