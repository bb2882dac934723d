#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>

#include "picking.h"
#include "scene_objects.h"
#include "surface_picker.h"

namespace emca::explorer {

struct ObjectHit {
    ObjectId id;
    std::size_t element = 0;
    double depth = 0;     ///< along the view direction for lines and points, else along the ray
};

/// Finds the element of an object under the cursor, on the CPU. Points and lines come before what has sides, of each the
/// front-most; objects that are switched off are never hit.
class ObjectPicker {
  public:
    std::optional<ObjectHit> pick(std::span<const SceneObjects::Entry> entries, const Projection& projection, const Ray& ray,
                                  double x, double y);
    /// Forgets what it made of objects that are not there any more.
    void tidy(std::span<const SceneObjects::Entry> entries);

  private:
    /// Sets of triangles, made ready when the cursor first looks for them.
    std::map<const SceneObject*, std::pair<std::shared_ptr<const SceneObject>, SurfacePicker>> triangles_;
};

/// The first cell that is drawn along a ray, and its distance. Source: Amanatides and Woo, "A fast voxel traversal
/// algorithm for ray tracing", Eurographics 1987.
std::optional<std::pair<std::size_t, double>> firstCell(const VoxelGrid& grid, std::span<const float> values, const Ray& ray);
/// Distance at which a ray enters the box, or leaves it if it begins inside; nothing if it misses.
std::optional<double> distanceTo(const ObjectBox& box, const Ray& ray);

}  // namespace emca::explorer
