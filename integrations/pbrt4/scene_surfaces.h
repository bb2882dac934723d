#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/mesh.h"
#include "hit_watch.h"
#include "shape_sources.h"
#include "spectrum_colors.h"
#include "tessellation.h"

namespace emca::pbrt4 {

/// What the scene calls its materials.
class MaterialNames {
  public:
    MaterialNames() = default;
    MaterialNames(const std::map<std::string, pbrt::Material>& named, const std::vector<pbrt::Material>& unnamed);
    /// Its name; its type and number in the scene where it has none; "interface" for none at all.
    std::string_view of(pbrt::Material material) const;

  private:
    std::map<const void*, std::string> names_;
};

/// A triangle of SceneSurfaces::meshes(); -1: none.
struct SurfacePlace {
    std::int32_t mesh = -1, face = -1;
    bool known() const { return mesh >= 0; }
};

/// The scene's shapes as triangles, and the triangle of a hit. The order of meshes is that of the scene's files,
/// whatever order pbrt's threads made the shapes in; instances stand behind each other. Immutable: any thread may ask.
class SceneSurfaces {
  public:
    struct Scene {
        pbrt::Primitive root;
        pbrt::Camera camera;
        std::vector<pbrt::Light> lights;
        const ShapeSources& sources;
        const MaterialNames& materials;
        std::size_t largestTriangleCount;  ///< of all meshes: instances beyond are left out
    };
    explicit SceneSurfaces(const Scene& scene);
    ~SceneSurfaces();
    SceneSurfaces(const SceneSurfaces&) = delete;
    SceneSurfaces& operator=(const SceneSurfaces&) = delete;

    const std::vector<Mesh>& meshes() const;
    std::size_t trianglesLeftOut() const;
    /// Whether any surface has a material, which boundaries of media need not.
    bool anyScatters() const;

    /// \param at  the interaction that came with this chain, render space
    SurfacePlace at(const HitChain& chain, const pbrt::SurfaceInteraction& at) const;
    /// A point that light sampling chose. Unknown for lights without a surface.
    SurfacePlace onLight(pbrt::Light light, const pbrt::Interaction& point) const;
    /// The mesh that emits, or the light's type and number in the scene. Empty for null.
    std::string_view lightName(pbrt::Light light) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace emca::pbrt4
