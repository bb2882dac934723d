#pragma once

#include <QColor>
#include <QImage>

#include <memory>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"

namespace emca::explorer::testing {

/// A box of 2 x 2 x 2 units around the origin, open towards +z: white floor, ceiling and back, red and green sides, a
/// block, a ball and a light below the ceiling. What leaves by the open side meets the environment.
std::vector<Mesh> roomMeshes();
/// Looks into the room from (0, 0, 4.4) with 38 degrees.
Camera roomCamera();

/// Paths that really bounce in the room (diffuse, by brute force over its triangles), all through one pixel; next-event
/// estimation at every vertex with its true visibility. Fixed seed.
/// \param closed  no path escapes or ends at the light: each has maximumDepth vertices
PathSet roomPaths(std::uint32_t paths, std::uint32_t maximumDepth, float spread = 0.01f, bool closed = false);

/// One hand-made path per sample: `points` are its vertices with depths from 1; it begins at `origin`.
PathSet pathOf(Vec3f origin, const std::vector<Vec3f>& points, const std::vector<NextEvent>& nextEventsAtFirst = {});

/// As received for one pixel.
std::shared_ptr<const client::Trace> traceOf(PathSet paths);
/// Room, camera, an image size of 640 x 480, and paths.
void fillRoom(client::Dataset& dataset, PathSet paths);

/// Finely triangulated waves over the floor of the room, for measurements.
Mesh waves(std::uint32_t triangles);

}  // namespace emca::explorer::testing
