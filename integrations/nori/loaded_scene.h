#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "filter_sampler.h"
#include "nori_headers.h"
#include "observer.h"

namespace emca::nori_adapter {

/// A scene that Nori has read, and what EMCA asks about it. Its BSDFs are observed. Immutable: any thread may read it.
class LoadedScene {
  public:
    /// Reads the scene and lets its integrator prepare. Errors: fileNotFound, fileUnreadable (with Nori's own message).
    static Result<std::unique_ptr<LoadedScene>> load(const std::filesystem::path& file);

    const nori::Scene& scene() const { return *scene_; }
    const std::string& name() const { return name_; }
    const std::string& integratorName() const { return integratorName_; }
    const FilterSampler& filter() const { return filter_; }
    const MeshIndices& meshIndices() const { return meshIndices_; }
    nori::Point3f centre() const { return centre_; }
    float radius() const { return radius_; }

    /// From rays that the camera gives: it may be of any class.
    Camera camera() const;
    std::vector<Mesh> meshes() const;

  private:
    LoadedScene(std::string name, std::unique_ptr<nori::Scene> scene);

    std::string name_, integratorName_;
    std::unique_ptr<nori::Scene> scene_;
    FilterSampler filter_;
    MeshIndices meshIndices_;
    nori::Point3f centre_;
    float radius_ = 1;
};

}  // namespace emca::nori_adapter
