#pragma once

#include <cstdint>

namespace emca {

/// What happened at a vertex, in Heckbert's and OSL's terms; light path expressions read it
/// (first letter of an event pair: R, T, V; B is the environment, O an emitting surface that ends the path).
enum class Event : std::uint8_t {
    none = 0,        ///< nothing recorded: an expression that needs it is unknown here
    reflect = 1,     ///< R
    transmit = 2,    ///< T
    volume = 3,      ///< V, scattering in a medium
    emission = 4,    ///< the walk ended on an emitter
    background = 5,  ///< the walk left the scene
    absorb = 6,      ///< the walk ended here without light: no valid direction, absorbed, or roulette
    pass = 7,        ///< went straight through (mask, index-matched boundary)
};

/// How concentrated the scattering was (second letter of the pair: D, G, S, s).
enum class Lobe : std::uint8_t { none = 0, diffuse = 1, glossy = 2, specular = 3, straight = 4 };

/// Which end of a path a vertex was generated from.
enum class Subpath : std::uint8_t { camera = 0, light = 1 };

/// How a contribution met its light.
enum class LightEnd : std::uint8_t {
    automatic = 0,  ///< hit if the vertex has emission or is the environment, else connected
    hit = 1,        ///< this vertex is on the light
    connected = 2,  ///< from this vertex straight to a sampled point on a light
};

inline constexpr std::uint8_t kEventCount = 8, kLobeCount = 5, kLightEndCount = 3;

/// "reflect", "diffuse", …; the spelling of JSON and queries.
const char* name(Event event);
const char* name(Lobe lobe);
const char* name(Subpath subpath);
const char* name(LightEnd end);

}  // namespace emca
