#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>

#include "emca/core/vector.h"

/// Pearson's chi-square test of samplers: do samples fall where the density that is claimed for them says?
/// Used by the tests of this library alone. Source of the procedure: Subr and Arvo, "Statistical Hypothesis Testing for
/// Assessing Monte Carlo Estimators", Pacific Graphics 2007.

namespace emca::render::testing {

/// Uniform numbers for tests: the same everywhere for a seed, and never 1.
class TestRandom {
  public:
    explicit TestRandom(std::uint64_t seed) : engine_(seed) {}
    float next() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
    Vec2f next2() {
        const float x = next();
        return {x, next()};
    }

  private:
    std::mt19937_64 engine_;
};

struct ChiSquareOptions {
    int samples = 100'000;
    int xBins = 16;  ///< directions: bins of theta; even, so that the horizon is between two bins
    int yBins = 32;  ///< directions: bins of phi
    std::uint64_t seed = 1;
    double significance = 0.01;  ///< probability that any of `tests` correct samplers is rejected
    int tests = 1;               ///< how many tests share that probability (Šidák's correction)
};

struct ChiSquareResult {
    bool accepted = false;
    double pValue = 0;     ///< probability of a statistic at least this large, if the density is right
    double threshold = 0;  ///< the p-value below which the sampler is rejected
    double statistic = 0;
    int degreesOfFreedom = 0;
    double integral = 0;  ///< of the density; what is missing to 1 must be the share of samples that were nothing
    std::string text;     ///< all of it in a sentence, for the test's message
};

/// Directions: all of the sphere, in the frame of the caller's choice.
/// \param sample  draws one direction, or nothing (ended below the surface, delta lobe): that counts as a bin of its
/// own \param pdf     density per steradian, also where sample() never goes
ChiSquareResult testDirections(const std::function<std::optional<Vec3f>(TestRandom&)>& sample,
                               const std::function<double(Vec3f)>& pdf, const ChiSquareOptions& options = {});

/// Rectangle of the plane.
struct Rectangle {
    double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
};

/// Points in a rectangle. Points outside count as nothing. \param pdf  density per unit of area
ChiSquareResult testPoints(const Rectangle& domain, const std::function<std::optional<Vec2d>(TestRandom&)>& sample,
                           const std::function<double(Vec2d)>& pdf, const ChiSquareOptions& options = {});

/// Integral of f over a rectangle by adaptive Gauss-Legendre quadrature; error around 1e-4 of the value or 1e-7.
double integrate(const Rectangle& domain, const std::function<double(Vec2d)>& f);

/// Integral of f over the directions of the sphere whose angles to z are in [thetaMin, thetaMax].
double integrateDirections(double thetaMin, double thetaMax, const std::function<double(Vec3f)>& f);

/// Direction of polar angle and azimuth in radians.
Vec3f directionOf(double theta, double phi);

}  // namespace emca::render::testing
