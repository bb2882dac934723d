#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/result.h"
#include "emca_path.h"

namespace emca::pbrt4 {

inline constexpr const char* kOwnIntegrator = "emcapath";

struct LoadOptions {
    std::vector<std::string> files;                 ///< of the scene, one behind the other as pbrt reads them
    int threads = 0;                                ///< of pbrt while it makes the scene; 0: one per processor
    std::optional<int> seed;                        ///< as pbrt's --seed
    std::size_t largestTriangleCount = 20'000'000;  ///< that the explorer gets
    std::string integrator;                         ///< instead of the scene's
};

/// A sampler as it is before the first pixel, and its memory. Threads clone it.
struct SamplerPrototype {
    pstd::pmr::monotonic_buffer_resource memory;
    pbrt::Sampler sampler;
};

/// pbrt's scene, made by pbrt's own parser and functions, and what EMCA knows about it. Immutable once it is loaded:
/// any thread may use it.
class LoadedScene {
  public:
    /// One in a process. pbrt ends the process, with its own message, where a scene has an error.
    /// Errors: notSupported (integrators and samplers that cannot render a pixel alone; a pbrt whose calls cannot be
    /// watched), invalidArgument.
    static Result<std::unique_ptr<LoadedScene>> load(const LoadOptions& options);
    ~LoadedScene();
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    const pbrt::Camera& camera() const { return camera_; }
    pbrt::Film film() const { return camera_.GetFilm(); }
    const pbrt::Primitive& root() const { return root_; }
    const SceneView& view() const { return *view_; }
    const SceneSurfaces& surfaces() const { return *surfaces_; }
    float sceneRadius() const { return float(view_->radius); }
    Camera viewerCamera() const;

    const std::string& integratorName() const { return integratorName_; }
    const std::string& samplerName() const { return samplerName_; }
    int samplesPerPixel() const { return samplesPerPixel_; }
    int seed() const { return seed_; }

    /// Empty name: the scene's. Errors: notSupported, invalidArgument; never ends the process.
    Result<const pbrt::RayIntegrator*> integrator(const std::string& name) const;

    /// Empty name, no number: the scene's. Errors: invalidArgument (a sampler that cannot have so many samples),
    /// notSupported (unknown name).
    Result<std::shared_ptr<const SamplerPrototype>> sampler(const std::string& name, std::optional<int> samplesPerPixel,
                                                            std::optional<int> seed) const;

  private:
    struct Parsed;
    LoadedScene();
    Result<void> makeIntegrators(const pbrt::BasicScene& scene);
    Result<void> checkWatching() const;

    std::unique_ptr<Parsed> parsed_;  ///< owns what pbrt's objects point to, such as their transforms
    pbrt::Camera camera_;
    pbrt::Primitive root_;
    std::vector<pbrt::Light> lights_;
    MaterialNames materials_;
    std::unique_ptr<SceneSurfaces> surfaces_;
    std::unique_ptr<SceneView> view_;
    std::string integratorName_, samplerName_;
    std::vector<pbrt::ParsedParameter> samplerParameters_;
    int samplesPerPixel_ = 0, seed_ = 0;
    std::map<std::string, std::unique_ptr<pbrt::RayIntegrator>> integrators_;
    std::string whyNoSimpleVolpath_;

    struct CachedSampler {
        std::string name;
        int samplesPerPixel, seed;
        std::shared_ptr<const SamplerPrototype> prototype;
    };
    mutable std::mutex samplerMutex_;
    mutable std::vector<CachedSampler> samplers_;  ///< the newest last; Halton's take megabytes and time
};

}  // namespace emca::pbrt4
