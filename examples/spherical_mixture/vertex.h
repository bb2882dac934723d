#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/client/selection.h"
#include "emca/probe/sphere_map.h"
#include "von_mises_fisher.h"

namespace mixture {

/// The selected vertex, as far as a mixture needs it. World space.
struct Vertex {
    emca::client::VertexId id;
    emca::Vec3f position;
    emca::Vec3f normal;                          ///< geometric, unit, on the side from which the path came; 0: unknown
    std::vector<WeightedDirection> directions;   ///< in which the paths of the pixel went on that are here too
    emca::probe::SphereFrame frame;              ///< the world's up, and back to the camera
};
/// Nothing if none is selected, or none on a surface. Paths are here if they are nearer than 2 % of the length of the
/// segment that leads here.
std::optional<Vertex> selectedVertex(const emca::client::Dataset& dataset, const emca::client::Selection& selection);

}  // namespace mixture
