#include "emca/render/spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "file_bytes.h"
#include "text_numbers.h"

namespace emca::render {

namespace {

constexpr double kFirst = 360, kLast = 830;  // nm, the range of CIE 1931

using Matrix = std::array<Vec3d, 3>;  // rows

Vec3d operator*(const Matrix& m, Vec3d v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

/// XYZ with white D65 to linear Rec. 709 (IEC 61966-2-1, inverse of the primaries' matrix).
constexpr Matrix kXyzToRgb = {Vec3d{3.2404542, -1.5371385, -0.4985314}, Vec3d{-0.9692660, 1.8760108, 0.0415560},
                              Vec3d{0.0556434, -0.2040259, 1.0572252}};

/// XYZ with white E to XYZ with white D65: cone responses scaled by the ratio of those to the whites.
Vec3d adaptToD65(Vec3d xyz) {
    constexpr Matrix kBradford = {Vec3d{0.8951, 0.2664, -0.1614}, Vec3d{-0.7502, 1.7135, 0.0367},
                                  Vec3d{0.0389, -0.0685, 1.0296}};
    constexpr Matrix kInverse = {Vec3d{0.9869929, -0.1470543, 0.1599627}, Vec3d{0.4323053, 0.5183603, 0.0492912},
                                 Vec3d{-0.0085287, 0.0400428, 0.9684867}};
    const Vec3d from = kBradford * Vec3d{1, 1, 1};
    const Vec3d to = kBradford * Vec3d{0.95047, 1, 1.08883};
    const Vec3d cones = kBradford * xyz;
    return kInverse * Vec3d{cones.x * to.x / from.x, cones.y * to.y / from.y, cones.z * to.z / from.z};
}

/// Integral of a function times the matching functions from a to b, by Simpson's rule in steps of at most 1 nm.
template <typename Function>
Vec3d integrate(double a, double b, Function value) {
    Vec3d sum;
    const int steps = std::max(1, static_cast<int>(std::ceil(b - a)));
    const double h = (b - a) / steps;
    for (int i = 0; i < steps; ++i) {
        const double l = a + i * h, r = i + 1 == steps ? b : l + h, m = (l + r) / 2;
        sum += (cieXyz(l) * value(l) + cieXyz(m) * (4 * value(m)) + cieXyz(r) * value(r)) * (h / 6);
    }
    return sum;
}

Vec3d integralOfOne() {
    static const Vec3d integral = integrate(kFirst, kLast, [](double) { return 1.0; });
    return integral;
}

Vec3d integral(std::span<const SpectrumSample> samples) {
    std::vector<SpectrumSample> sorted(samples.begin(), samples.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](auto& a, auto& b) { return a.wavelength < b.wavelength; });
    Vec3d sum;
    for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
        const auto [w0, v0] = sorted[i];
        const auto [w1, v1] = sorted[i + 1];
        const double a = std::max(w0, kFirst), b = std::min(w1, kLast);
        if (a < b)
            sum += integrate(a, b, [&](double w) { return v0 + (v1 - v0) * (w - w0) / (w1 - w0); });
    }
    return sum;
}

Color withoutNegatives(Vec3d rgb) {
    return {static_cast<float>(std::max(0.0, rgb.x)), static_cast<float>(std::max(0.0, rgb.y)),
            static_cast<float>(std::max(0.0, rgb.z))};
}

Color ratioToRgb(Vec3d xyz) {
    const auto adapted = [](Vec3d v) { return kXyzToRgb * adaptToD65(v); };
    const Vec3d one = integralOfOne();
    const auto scaled = [&](Vec3d v) { return Vec3d{v.x / one.x, v.y / one.y, v.z / one.z}; };
    // The matrices' digits end somewhere; dividing by what they make of white makes white exact.
    const Vec3d white = adapted({1, 1, 1}), rgb = adapted(scaled(xyz));
    return withoutNegatives({rgb.x / white.x, rgb.y / white.y, rgb.z / white.z});
}

Color lightToRgb(Vec3d xyz) { return withoutNegatives(kXyzToRgb * (xyz / integralOfOne().y)); }

}  // namespace

Vec3d cieXyz(double wavelength) {
    const auto lobe = [&](double height, double centre, double left, double right) {
        const double t = (wavelength - centre) / (wavelength < centre ? left : right);
        return height * std::exp(-0.5 * t * t);
    };
    return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
            lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
            lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

Color toRgb(std::span<const SpectrumSample> samples, SpectrumUse use) {
    const Vec3d xyz = integral(samples);
    return use == SpectrumUse::ratio ? ratioToRgb(xyz) : lightToRgb(xyz);
}

Color blackbodyRgb(double kelvin) {
    constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;  // SI, exact since 2019
    const auto radiance = [&](double nm) {
        const double m = nm * 1e-9;
        return 2 * h * c * c / (m * m * m * m * m) / std::expm1(h * c / (m * k * kelvin)) * 1e-9;
    };
    return lightToRgb(integrate(kFirst, kLast, radiance));
}

Result<std::vector<SpectrumSample>> parseSpectrum(std::string_view text) {
    std::vector<SpectrumSample> samples;
    for (const auto part : splitList(text)) {
        const auto colon = part.find(':');
        const auto wavelength = parseNumber<double>(part.substr(0, colon));
        const auto value = colon == part.npos ? std::nullopt : parseNumber<double>(part.substr(colon + 1));
        if (!wavelength || !value)
            return Error{ErrorCode::parseFailed,
                         '"' + std::string(part.substr(0, 40)) + "\" is no \"wavelength:value\" of a spectrum."};
        samples.push_back({*wavelength, *value});
    }
    return samples;
}

Result<std::vector<SpectrumSample>> readSpectrumFile(const std::filesystem::path& path) {
    constexpr std::uint64_t kLimit = std::uint64_t(64) << 20;
    const auto bytes = readFileBytes(path, kLimit);
    if (!bytes)
        return bytes.error();
    std::vector<SpectrumSample> samples;
    std::string_view rest = *bytes;
    for (int line = 1; !rest.empty(); ++line) {
        const auto end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const auto content = trimmed(text.substr(0, text.find('#')));
        if (content.empty())
            continue;
        const auto numbers = parseNumbers(content);
        if (!numbers || numbers->size() != 2)
            return Error{ErrorCode::fileUnreadable, path.string() + ":" + std::to_string(line) +
                                                        ": a spectrum file has a wavelength and a value in each line, not \"" +
                                                        std::string(content.substr(0, 40)) + "\"."};
        samples.push_back({(*numbers)[0], (*numbers)[1]});
    }
    return samples;
}

float srgbToLinear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace emca::render
