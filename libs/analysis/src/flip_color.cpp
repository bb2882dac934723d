#include "flip_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace emca::analysis {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

constexpr Matrix inverse(const Matrix& m) {
    Matrix out{};
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i)
        determinant += m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            out[j][i] = (m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                         m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3]) /
                        determinant;
    return out;
}

/// Linear Rec. 709 to XYZ relative to white, from the chromaticities of primaries and white (ITU-R BT.709-6, section
/// 1).
constexpr Matrix relativeXyzOfRec709() {
    constexpr double kX[] = {0.64, 0.30, 0.15}, kY[] = {0.33, 0.60, 0.06}, kWhiteX = 0.3127, kWhiteY = 0.3290;
    constexpr std::array<double, 3> kWhite = {kWhiteX / kWhiteY, 1, (1 - kWhiteX - kWhiteY) / kWhiteY};
    Matrix primaries{};  // columns
    for (std::size_t c = 0; c < 3; ++c) {
        primaries[0][c] = kX[c] / kY[c];
        primaries[1][c] = 1;
        primaries[2][c] = (1 - kX[c] - kY[c]) / kY[c];
    }
    // As bright as they must be so that they add up to white.
    const Matrix solve = inverse(primaries);
    for (std::size_t c = 0; c < 3; ++c) {
        const double y = solve[c][0] * kWhite[0] + solve[c][1] * kWhite[1] + solve[c][2] * kWhite[2];
        for (std::size_t row = 0; row < 3; ++row) primaries[row][c] *= y / kWhite[row];
    }
    return primaries;
}

struct Coefficients {
    float m[3][3];
};
constexpr Coefficients rounded(const Matrix& m) {
    Coefficients out{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) out.m[i][j] = static_cast<float>(m[i][j]);
    return out;
}
constexpr Coefficients kToXyz = rounded(relativeXyzOfRec709());
constexpr Coefficients kFromXyz = rounded(inverse(relativeXyzOfRec709()));

/// The lightness function of CIE 1976 (ISO/CIE 11664-4).
float lightness(float t) {
    constexpr float kDelta = 6.f / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.f / 29;
}

struct Aces {  // x (a x + b) / (x (c x + d) + e)
    static constexpr double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;
};

constexpr float kExponent = 0.7f;         // q_c
constexpr float kKnee = 0.4f;             // p_c
constexpr float kKneeDifference = 0.95f;  // p_t

}  // namespace

RelativeXyz toRelativeXyz(Color c) {
    const auto& m = kToXyz.m;
    return {m[0][0] * c.r + m[0][1] * c.g + m[0][2] * c.b, m[1][0] * c.r + m[1][1] * c.g + m[1][2] * c.b,
            m[2][0] * c.r + m[2][1] * c.g + m[2][2] * c.b};
}

Color fromRelativeXyz(const RelativeXyz& v) {
    const auto& m = kFromXyz.m;
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

HuntLab toHuntLab(Color linear) {
    const RelativeXyz xyz = toRelativeXyz(linear);
    const float x = lightness(xyz.x), y = lightness(xyz.y), z = lightness(xyz.z);
    const float l = 116 * y - 16;
    return {l, 0.01f * l * 500 * (x - y), 0.01f * l * 200 * (y - z)};
}

float hyab(const HuntLab& a, const HuntLab& b) {
    const float da = a.a - b.a, db = a.b - b.b;
    return std::abs(a.l - b.l) + std::sqrt(da * da + db * db);
}

float flipColorDifference(const HuntLab& a, const HuntLab& b) {
    static const float kLargest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kExponent);
    const float difference = std::pow(hyab(a, b), kExponent), knee = kKnee * kLargest;
    if (difference < knee) return difference * (kKneeDifference / knee);
    return std::min(1.f, kKneeDifference + (difference - knee) / (kLargest - knee) * (1 - kKneeDifference));
}

float acesToneMap(float linear) {
    constexpr auto a = static_cast<float>(Aces::a), b = static_cast<float>(Aces::b), c = static_cast<float>(Aces::c),
                   d = static_cast<float>(Aces::d), e = static_cast<float>(Aces::e);
    // NaN and negative values are black; from some 10 on the curve is above 1 and its squares may not overflow.
    const float x = linear > 0 ? std::min(linear, 1e6f) : 0.f;
    return std::min(1.f, x * (a * x + b) / (x * (c * x + d) + e));
}

double acesInverse(double t) {
    const double a = t * Aces::c - Aces::a, b = t * Aces::d - Aces::b, c = t * Aces::e;
    // a < 0 < c: the roots have different signs.
    return (-b - std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

}  // namespace emca::analysis
