#pragma once

#include <optional>
#include <span>
#include <vector>

#include "emca/analysis/path_quantities.h"
#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"
#include "picking.h"

namespace emca::explorer {

/// Where the 3D view draws a PathSet: positions made fit for a picture. Environment hits, however far the renderer put
/// them, lie on a dome around the scene; what is absurdly far is pulled in along its segment; what is not finite has no
/// place. World space. Made once per traced pixel; selecting only reads it.
struct PathGeometry {
    std::vector<analysis::Segment> segments;            ///< by path, in the order of the walk
    std::vector<Index> firstSegment;                    ///< paths + 1
    std::vector<analysis::NextEventSegment> nextEvents; ///< by path
    std::vector<Index> firstNextEvent;                  ///< paths + 1
    std::vector<Vec3f> points;                          ///< one per vertex; NaN where it cannot be drawn
    Index unplacedVertices = 0;                         ///< vertices with a position that is not finite

    Index pathCount() const { return firstSegment.empty() ? 0 : static_cast<Index>(firstSegment.size() - 1); }
    std::span<const analysis::Segment> segmentsOf(Index path) const {
        return std::span(segments).subspan(firstSegment[path], firstSegment[path + 1] - firstSegment[path]);
    }
    std::span<const analysis::NextEventSegment> nextEventsOf(Index path) const {
        return std::span(nextEvents).subspan(firstNextEvent[path], firstNextEvent[path + 1] - firstNextEvent[path]);
    }
};

/// \param camera  start of camera paths that have no origin of their own; spherical and orthographic ones have none
/// \param box     of the scene; if empty, that of the paths' finite surface positions takes its place
PathGeometry makePathGeometry(const PathSet& paths, const std::optional<Camera>& camera, std::span<const Mesh> meshes,
                              BoundingBox box);

/// Radius of the dome of environment hits, for a box of the scene.
float domeRadius(const BoundingBox& box);

/// At most `count` paths, evenly spread over all of them (which lie in the order of pixel and sample), always the same
/// ones; all of them if there are no more.
std::vector<Index> evenlyChosen(Index pathCount, Index count);

}  // namespace emca::explorer
