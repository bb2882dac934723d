#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "emca/core/vector.h"

/// Mixtures of von Mises-Fisher distributions on the sphere, and how to fit them. Nothing here knows of renderers.
namespace mixture {

using emca::Vec2d;
using emca::Vec3d;

/// One lobe: density kappa / (2 pi (1 - exp(-2 kappa))) exp(kappa (cos - 1)), cos the cosine to the mean. Per steradian.
/// Source of the stable form: Jakob, "Numerically stable sampling of the von Mises-Fisher distribution on S2", 2012.
struct Lobe {
    Vec3d mean{0, 0, 1};   ///< unit
    double kappa = 0;      ///< concentration, at least 0 (0: uniform over the sphere)
    double weight = 1;     ///< of the lobe in its mixture
    double density(Vec3d direction) const;
    friend bool operator==(const Lobe&, const Lobe&) = default;
};

/// log of a lobe's density at a cosine; accurate from kappa 0 to beyond 1e8.
double logDensity(double kappa, double cosine);
/// Mean cosine of a lobe: coth(kappa) - 1 / kappa, in [0, 1).
double meanCosine(double kappa);
/// Its inverse. Source: Banerjee et al., "Clustering on the Unit Hypersphere using von Mises-Fisher Distributions", JMLR 6,
/// 2005, equation 4.4 as a start; then Newton's steps (Sra, Computational Statistics 27, 2012).
/// \param largest  what it never exceeds
double kappaOf(double meanCosine, double largest);
/// Half angle of the cone around the mean that holds this part of the lobe, in radians.
double coneOf(double kappa, double part);
/// A direction of the lobe. \param u  in [0, 1)^2
Vec3d sample(const Lobe& lobe, Vec2d u);

/// Weights of the lobes add up to 1.
double density(std::span<const Lobe> lobes, Vec3d direction);

struct WeightedDirection {
    Vec3d direction;       ///< unit
    double weight = 1;     ///< at least 0
};

struct FitOptions {
    int components = 8;            ///< lobes at most: those that end with no weight are left out
    int iterations = 200;          ///< at most
    int starts = 4;                ///< the most likely result of so many beginnings is taken
    double tolerance = 1e-7;       ///< ends when the mean log-likelihood grows by less
    double largestKappa = 1e5;     ///< no lobe is narrower: a lobe around one single direction would have no limit
    /// Directions without any preference that each lobe is assumed to have seen before (a conjugate prior, as in Vorba et al.,
    /// "On-line Learning of Parametric Mixture Models for Light Transport Simulation", 2014, section 4.3); 0: none, maximum likelihood.
    double priorSamples = 0;
    std::uint64_t seed = 1;        ///< the same input gives the same bits
    std::function<bool()> cancelled;
};

struct Fit {
    std::vector<Lobe> lobes;       ///< the heaviest first; empty if all weights are 0 or it was cancelled
    double logLikelihood = 0;      ///< weighted mean of log(density) over the directions
    int iterations = 0;            ///< of the result that was taken
    bool converged = false;
};

/// Weighted expectation maximisation (Banerjee et al. 2005, section 3; weights as in Vorba et al. 2014). Directions that
/// are not finite or whose weight is not positive are left out.
Fit fit(std::span<const WeightedDirection> directions, const FitOptions& options);

}  // namespace mixture
