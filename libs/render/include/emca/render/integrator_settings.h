#pragma once

#include <cstdint>

namespace emca::render {

/// How light is looked for. All three have the same expectation, except that bsdfSampling cannot find delta lights.
enum class LightStrategy : std::uint8_t {
    mis,            ///< both, combined by multiple importance sampling
    lightSampling,  ///< next-event estimation, and hits where it cannot reach (directly seen, after delta scattering)
    bsdfSampling,   ///< hits alone
};

/// Settings of the path integrator, with Mitsuba's meanings and defaults.
struct IntegratorSettings {
    int maximumDepth = -1;     ///< longest path in segments: 1 shows emitters, 2 adds direct light; -1: no limit
    int rouletteDepth = 5;     ///< from this depth on, Russian roulette may end a path
    bool strictNormals = false;  ///< no light where geometric and shading normal disagree about the side
    bool hideEmitters = false;   ///< emitters are not seen directly
    LightStrategy strategy = LightStrategy::mis;
    /// An error to be found, built in on purpose (paper, Figure 9): lights that are meshes choose a triangle and the point
    /// on it with the same random number. Takes effect when a scene is built.
    bool reuseTriangleSample = false;
    friend bool operator==(const IntegratorSettings&, const IntegratorSettings&) = default;
};

}  // namespace emca::render
