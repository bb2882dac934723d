#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/adapter/parametric_mesh.h"
#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "lajolla_headers.h"

namespace emca::lajolla {

/// A scene that lajolla has read, and what EMCA asks about it. Immutable: any thread may read it.
class LoadedScene {
  public:
    /// Errors: fileNotFound, fileUnreadable (with lajolla's own message).
    static Result<std::unique_ptr<LoadedScene>> load(const std::filesystem::path& file);
    ~LoadedScene();
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    const ::Scene& scene() const { return *scene_; }
    const std::string& name() const { return name_; }
    std::uint32_t width() const { return static_cast<std::uint32_t>(scene_->camera.width); }
    std::uint32_t height() const { return static_cast<std::uint32_t>(scene_->camera.height); }

    Camera camera() const;
    /// One per shape, in lajolla's order, so that a shape_id is the index of its mesh. Spheres come tessellated.
    std::vector<Mesh> meshes() const;
    /// Triangle of meshes() that a hit is on.
    std::int32_t faceOf(const PathVertex& hit) const;

    /// A point that a light was asked for.
    struct LightPlace {
        std::int32_t mesh = 0, face = 0;
    };
    /// Where on a mesh it is; nothing for environment maps.
    /// \param shapeChoice  the random number that chose the triangle
    std::optional<LightPlace> placeOf(const Light& light, const PointAndNormal& point, Real shapeChoice) const;

    /// "Sphere 3": lajolla keeps no names.
    const std::string& shapeName(int shape) const { return shapeNames_[static_cast<std::size_t>(shape)]; }
    /// "Lambertian 2"; "no material" for -1, the border between media.
    const std::string& materialName(int material) const;
    /// "DiffuseAreaLight 0".
    const std::string& lightName(int light) const { return lightNames_[static_cast<std::size_t>(light)]; }
    /// Of the type of light, by address in scene().lights.
    int lightIndex(const Light& light) const { return static_cast<int>(&light - scene_->lights.data()); }

    /// Where a viewer draws the hit of a ray that leaves the scene: outside of everything.
    Vector3 beyond(const Ray& ray) const;

  private:
    explicit LoadedScene(std::string name) : name_(std::move(name)) {}
    Mesh meshOf(const TriangleMesh& shape) const;
    Mesh meshOf(const Sphere& shape) const;
    void nameEverything();

    std::string name_;
    RTCDevice device_ = nullptr;
    std::unique_ptr<::Scene> scene_;
    std::vector<std::string> shapeNames_, materialNames_, lightNames_;
    adapter::ParametricMesh sphere_{.columns = 64, .rows = 32, .firstRowIsPoint = true, .lastRowIsPoint = true};
};

}  // namespace emca::lajolla
