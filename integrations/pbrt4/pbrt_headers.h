#pragma once

// pbrt's headers, as one: they need each other, and are C++17. Two of its classes are aggregates there that C++20 takes
// for none, because they name their default constructor: `Class() = default;`. While their headers are read, that line is
// a comparison, which also may be `= default` and leaves an aggregate an aggregate.

#define Quaternion() friend bool operator==(const Quaternion&, const Quaternion&)
#include <pbrt/util/vecmath.h>
#undef Quaternion
#define LightBVHNode() friend bool operator==(const LightBVHNode&, const LightBVHNode&)
#include <pbrt/lightsamplers.h>
#undef LightBVHNode

#include <pbrt/pbrt.h>

#include <pbrt/bsdf.h>
#include <pbrt/cameras.h>
#include <pbrt/cpu/aggregates.h>
#include <pbrt/cpu/integrators.h>
#include <pbrt/cpu/primitive.h>
#include <pbrt/film.h>
#include <pbrt/filters.h>
#include <pbrt/interaction.h>
#include <pbrt/lights.h>
#include <pbrt/lightsamplers.h>
#include <pbrt/materials.h>
#include <pbrt/options.h>
#include <pbrt/paramdict.h>
#include <pbrt/parser.h>
#include <pbrt/samplers.h>
#include <pbrt/scene.h>
#include <pbrt/shapes.h>
#include <pbrt/textures.h>
#include <pbrt/util/colorspace.h>
#include <pbrt/util/mesh.h>
#include <pbrt/util/parallel.h>
#include <pbrt/util/pmj02tables.h>
#include <pbrt/util/sampling.h>
#include <pbrt/util/spectrum.h>
