#pragma once

#include "emca/recorder/path_layers.h"
#include "emca/recorder/recorder.h"
#include "scene_surfaces.h"
#include "spectrum_colors.h"

namespace emca::pbrt4 {

/// What turns values of pbrt into those that are recorded. Immutable, shared by all threads.
struct SceneView {
    const SceneSurfaces& surfaces;
    const MaterialNames& materials;
    SpectrumColors colors;
    WorldSpace world;
    pbrt::Point3f centre;  ///< of the scene, render space
    pbrt::Float radius;

    /// Where a ray that leaves the scene is drawn to: outside of everything.
    Vec3f environmentPoint(const pbrt::Ray& ray) const {
        return world.point(ray.o + ray.d * ((Distance(ray.o, centre) + 2 * radius) / Length(ray.d)));
    }
};

/// What the paths of our integrator add to the path layers.
using SpectrumTally = emca::BasicPathTally<pbrt::SampledSpectrum>;

/// Around one path: who records it. Nothing in it changes the path.
struct PathContext {
    const SceneView& view;
    emca::PathRecorder recorder;            ///< inert unless the thread is inside a RecordScope
    SpectrumTally* tally = nullptr;         ///< null: no layers
    const HitWatch* watch = nullptr;        ///< there while something is recorded or collected
    pbrt::SampledSpectrum cameraWeight{1};  ///< of the camera's ray
};

inline Event eventOf(pbrt::BxDFFlags flags) { return IsTransmissive(flags) ? Event::transmit : Event::reflect; }
/// Of a sample; of a whole BSDF only if it has but one kind.
inline Lobe lobeOf(pbrt::BxDFFlags flags) {
    const bool diffuse = IsDiffuse(flags), glossy = IsGlossy(flags), specular = IsSpecular(flags);
    if (int(diffuse) + int(glossy) + int(specular) != 1) return Lobe::none;
    return diffuse ? Lobe::diffuse : glossy ? Lobe::glossy : Lobe::specular;
}

}  // namespace emca::pbrt4
