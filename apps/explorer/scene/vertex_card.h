#pragma once

#include <QString>

#include "emca/core/path_set.h"
#include "scene_overlay.h"

namespace emca::explorer {

/// What the label under the cursor says of a vertex: depth, path, event, position, estimate, emission, next-event
/// estimation and the first few recorded values.
OverlayContent::Card vertexCard(const PathSet& paths, Index vertex, QPointF at);

/// "path 17" or, where paths of several pixels are shown, "path 17 of (12, 34)"; parts beyond the first are named.
QString pathTitle(const PathSet& paths, Index path);

}  // namespace emca::explorer
