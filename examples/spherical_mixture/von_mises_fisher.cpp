#include "von_mises_fisher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace mixture {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmall = 1e-3;   ///< below, series are exact to double precision
/// A lobe that has less of all weight than this has nothing to say.
constexpr double kLeastWeight = 1e-6;

Vec3d anyOrthogonal(Vec3d n) {
    const Vec3d helper = std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    return normalize(cross(n, helper));
}

/// The input of a fit, without what cannot be used. Weights add up to 1.
struct Data {
    std::vector<Vec3d> directions;
    std::vector<double> weights;
    double effectiveCount = 0;   ///< (sum w)^2 / sum w^2: how many equally heavy directions it is worth
    std::size_t size() const { return directions.size(); }
};

Data usable(std::span<const WeightedDirection> input) {
    Data data;
    double sum = 0, squares = 0;
    for (const WeightedDirection& item : input) {
        const double size = length(item.direction);
        if (!std::isfinite(size) || !(size > 0) || !std::isfinite(item.weight) || !(item.weight > 0)) continue;
        data.directions.push_back(item.direction / size);
        data.weights.push_back(item.weight);
        sum += item.weight;
        squares += item.weight * item.weight;
    }
    for (double& weight : data.weights) weight /= sum;
    data.effectiveCount = data.size() == 0 ? 0 : sum * sum / squares;
    return data;
}

/// Means spread over the data: each new one is drawn in proportion to weight times distance (Arthur and Vassilvitskii,
/// "k-means++", 2007, with 1 - cos as the squared distance).
std::vector<Lobe> beginning(const Data& data, int components, std::mt19937_64& random) {
    std::vector<Lobe> lobes;
    std::vector<double> distance(data.size(), 1.0);
    std::uniform_real_distribution<double> uniform(0, 1);
    while (static_cast<int>(lobes.size()) < components) {
        double sum = 0;
        for (std::size_t i = 0; i < data.size(); ++i) sum += data.weights[i] * distance[i];
        if (!(sum > 1e-15)) break;   // fewer different directions than lobes
        double left = uniform(random) * sum;
        std::size_t chosen = 0;
        for (std::size_t i = 0; i < data.size() && left >= 0; ++i) {
            if (data.weights[i] * distance[i] > 0) chosen = i;
            left -= data.weights[i] * distance[i];
        }
        lobes.push_back({data.directions[chosen], 10, 1});
        for (std::size_t i = 0; i < data.size(); ++i) {
            const double apart = std::max(0.0, 1 - dot(data.directions[i], lobes.back().mean));
            distance[i] = lobes.size() == 1 ? apart : std::min(distance[i], apart);
        }
    }
    for (Lobe& lobe : lobes) lobe.weight = 1.0 / static_cast<double>(lobes.size());
    return lobes;
}

/// What an expectation step adds up for each lobe.
struct Sums {
    double weight = 0;
    Vec3d direction;
};

/// \return the mean log-likelihood of the lobes as they are
double expectation(const Data& data, std::span<const Lobe> lobes, std::vector<Sums>& sums) {
    std::fill(sums.begin(), sums.end(), Sums());
    std::vector<double> logs(lobes.size());
    double likelihood = 0;
    for (std::size_t i = 0; i < data.size(); ++i) {
        double largest = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < lobes.size(); ++k) {
            logs[k] = std::log(lobes[k].weight) + logDensity(lobes[k].kappa, dot(lobes[k].mean, data.directions[i]));
            largest = std::max(largest, logs[k]);
        }
        double sum = 0;
        for (double& value : logs) sum += value = std::exp(value - largest);
        likelihood += data.weights[i] * (largest + std::log(sum));
        for (std::size_t k = 0; k < lobes.size(); ++k) {
            const double share = data.weights[i] * logs[k] / sum;
            sums[k].weight += share;
            sums[k].direction += data.directions[i] * share;
        }
    }
    return likelihood;
}

void maximisation(const Data& data, const FitOptions& options, std::span<const Sums> sums, std::vector<Lobe>& lobes) {
    const double prior = options.priorSamples / data.effectiveCount;
    double all = 0;
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        const double resultant = length(sums[k].direction);
        lobes[k].weight = sums[k].weight;
        all += sums[k].weight;
        if (resultant > 0) lobes[k].mean = sums[k].direction / resultant;
        lobes[k].kappa = kappaOf(resultant / (sums[k].weight + prior), options.largestKappa);
    }
    for (Lobe& lobe : lobes) lobe.weight /= all;
    // All that is left of the lobe that lost everything would be divisions by 0.
    if (std::erase_if(lobes, [](const Lobe& lobe) { return !(lobe.weight >= kLeastWeight); }) > 0) {
        all = 0;
        for (const Lobe& lobe : lobes) all += lobe.weight;
        for (Lobe& lobe : lobes) lobe.weight /= all;
    }
}

Fit fitOnce(const Data& data, const FitOptions& options, std::mt19937_64& random) {
    Fit result;
    std::vector<Lobe> lobes = beginning(data, options.components, random);
    double before = -std::numeric_limits<double>::infinity();
    std::vector<Sums> sums;
    for (int i = 0;; ++i) {
        if (options.cancelled && options.cancelled()) return {};
        sums.resize(lobes.size());
        const double likelihood = expectation(data, lobes, sums);
        result.lobes = lobes;
        result.logLikelihood = likelihood;
        result.iterations = i;
        result.converged = std::abs(likelihood - before) < options.tolerance;
        if (result.converged || i == options.iterations) return result;
        before = likelihood;
        maximisation(data, options, sums, lobes);
    }
}

}  // namespace

double logDensity(double kappa, double cosine) {
    if (!(kappa > 1e-12)) return -std::log(4 * kPi);
    return std::log(kappa / (2 * kPi * -std::expm1(-2 * kappa))) + kappa * (cosine - 1);
}

double Lobe::density(Vec3d direction) const { return std::exp(logDensity(kappa, dot(mean, direction))); }

double meanCosine(double kappa) {
    if (kappa < kSmall) return kappa / 3 - kappa * kappa * kappa / 45;
    return 1 / std::tanh(kappa) - 1 / kappa;
}

double kappaOf(double r, double largest) {
    if (!(r > 0)) return 0;
    if (r >= meanCosine(largest)) return largest;
    double kappa = std::min(largest, r * (3 - r * r) / (1 - r * r));
    for (int i = 0; i < 8; ++i) {
        const double a = meanCosine(kappa);
        // For large kappa 1 - a^2 - 2 a / kappa would be a difference of equal numbers: it is 1 / kappa^2.
        const double slope = kappa < kSmall ? 1.0 / 3 : kappa > 20 ? 1 / (kappa * kappa) : 1 - a * a - 2 * a / kappa;
        const double next = std::clamp(kappa - (a - r) / slope, 0.5 * kappa, 2 * kappa);
        if (std::abs(next - kappa) <= 1e-12 * kappa) break;
        kappa = next;
    }
    return std::min(kappa, largest);
}

double coneOf(double kappa, double part) {
    // The distribution of the cosine can be inverted: see sample().
    if (!(kappa > 1e-12)) return std::acos(std::clamp(1 - 2 * part, -1.0, 1.0));
    const double below = 1 + std::log1p(part * std::expm1(-2 * kappa)) / kappa;
    // Of narrow cones 1 - cos is known exactly, cos is not: acos would lose half of the digits.
    return 2 * std::asin(std::sqrt(std::clamp((1 - below) / 2, 0.0, 1.0)));
}

Vec3d sample(const Lobe& lobe, Vec2d u) {
    const double lack = lobe.kappa > 1e-12 ? -std::log1p(u.x * std::expm1(-2 * lobe.kappa)) / lobe.kappa : 2 * u.x;   // 1 - cos
    const double cosine = 1 - lack, sine = std::sqrt(std::max(0.0, lack * (2 - lack)));
    const Vec3d s = anyOrthogonal(lobe.mean), t = cross(lobe.mean, s);
    const double phi = 2 * kPi * u.y;
    return normalize(s * (sine * std::cos(phi)) + t * (sine * std::sin(phi)) + lobe.mean * cosine);
}

double density(std::span<const Lobe> lobes, Vec3d direction) {
    double sum = 0;
    for (const Lobe& lobe : lobes) sum += lobe.weight * lobe.density(direction);
    return sum;
}

Fit fit(std::span<const WeightedDirection> directions, const FitOptions& options) {
    const Data data = usable(directions);
    if (data.size() == 0 || options.components < 1) return {};
    std::mt19937_64 random(options.seed);
    Fit best;
    for (int i = 0; i < std::max(1, options.starts); ++i) {
        Fit next = fitOnce(data, options, random);
        if (next.lobes.empty()) return {};   // cancelled
        if (best.lobes.empty() || next.logLikelihood > best.logLikelihood) best = std::move(next);
    }
    std::sort(best.lobes.begin(), best.lobes.end(), [](const Lobe& a, const Lobe& b) { return a.weight > b.weight; });
    return best;
}

}  // namespace mixture
