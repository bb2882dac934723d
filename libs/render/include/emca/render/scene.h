#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "emca/render/camera.h"
#include "emca/render/distribution.h"
#include "emca/render/emitter.h"
#include "emca/render/integrator_settings.h"
#include "emca/render/interaction.h"
#include "emca/render/ray.h"
#include "emca/render/reconstruction_filter.h"
#include "emca/render/sampler.h"
#include "emca/render/scene_node.h"
#include "emca/render/shape.h"

namespace emca::render {

/// What a scene is made of.
struct SceneParts {
    std::string name;
    std::vector<std::unique_ptr<Shape>> shapes;
    std::vector<std::unique_ptr<Emitter>> emitters;  ///< area lights are also pointed to by their shapes
    CameraSettings camera;
    std::uint32_t width = 768, height = 576;  ///< of the image, in pixels; Mitsuba's default
    ReconstructionFilter filter;
    std::uint32_t samplesPerPixel = 4;        ///< Mitsuba's default
    SamplerKind sampler = SamplerKind::independent;
    IntegratorSettings integrator;
    std::vector<Diagnostic> diagnostics;      ///< what a person should know about the scene file
};

/// A scene ready to be rendered: geometry in Embree, lights with their probabilities. Immutable; all functions may be
/// called from all threads.
class Scene {
  public:
    /// Builds the acceleration structure. Errors: outOfMemory, internal (Embree's words).
    static Result<std::shared_ptr<const Scene>> make(SceneParts parts);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// Nearest surface along the ray. \return false if there is none; `at` is then unspecified.
    bool intersect(const Ray& ray, SurfaceInteraction& at) const;

    /// How much of the light's radiance reaches the point: 0 if something opaque is in between, the product of what
    /// masks let through otherwise.
    float transmittance(const SurfaceInteraction& from, const EmitterSample& light) const;

    /// A light to sample, in proportion to its power, but with at least a share for each.
    struct EmitterChoice { const Emitter* emitter = nullptr; float probability = 0; };
    /// \param u in [0, 1). Null if the scene has no light.
    EmitterChoice chooseEmitter(float u) const;
    float emitterProbability(const Emitter& emitter) const { return choice_.probability(emitter.index); }

    const std::vector<std::unique_ptr<Emitter>>& emitters() const { return parts_.emitters; }
    const Emitter* environment() const { return environment_; }  ///< null if there is none
    const std::vector<std::unique_ptr<Shape>>& shapes() const { return parts_.shapes; }
    /// What surrounds all shapes. World space.
    Vec3f center() const { return center_; }
    float radius() const { return radius_; }

    const std::string& name() const { return parts_.name; }
    const RayCamera& camera() const { return camera_; }
    std::uint32_t width() const { return parts_.width; }
    std::uint32_t height() const { return parts_.height; }
    const ReconstructionFilter& filter() const { return parts_.filter; }
    std::uint32_t samplesPerPixel() const { return parts_.samplesPerPixel; }
    SamplerKind sampler() const { return parts_.sampler; }
    const IntegratorSettings& integrator() const { return parts_.integrator; }
    const std::vector<Diagnostic>& diagnostics() const { return parts_.diagnostics; }

    /// Triangles of every shape for the explorer, in the order of the mesh indices. Made anew at each call.
    std::vector<emca::Mesh> meshes() const;
    std::uint64_t triangleCount() const;

  private:
    explicit Scene(SceneParts parts);
    Result<void> build();
    void prepareEmitters();

    struct Embree;  // keeps Embree's headers out of here
    SceneParts parts_;
    std::unique_ptr<Embree> embree_;
    RayCamera camera_;
    const Emitter* environment_ = nullptr;
    Distribution1D choice_;
    Vec3f center_;
    float radius_ = 1;
    bool hasMasks_ = false;
};

}  // namespace emca::render
