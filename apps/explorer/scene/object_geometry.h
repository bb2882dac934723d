#pragma once

#include <vector>

#include "mesh_geometry.h"
#include "scene_objects.h"
#include "stroke.h"

namespace emca::explorer {

/// Flat triangles, each corner with a position and a colour of its own.
struct ColoredTriangles {
    std::vector<Vec3f> positions;                ///< three per triangle
    std::vector<analysis::Color8> colors;        ///< one per triangle
    bool translucent = false;
};

/// An object as what the 3D view draws.
struct ObjectGeometry {
    std::vector<Stroke> strokes;
    ColoredTriangles triangles;
    std::size_t leftOut = 0;                     ///< of more lines or points than kMaximumStrokes, these are not drawn
};

inline constexpr std::size_t kMaximumStrokes = 500000;   ///< more are thinned out evenly

ObjectGeometry geometryOf(const SceneObject& object);

/// The twelve edges and six sides of a box.
std::vector<Edge> edgesOf(const ObjectBox& box);
/// Whether a cell of a grid is drawn.
bool isShown(const VoxelGrid& grid, float value);

}  // namespace emca::explorer
