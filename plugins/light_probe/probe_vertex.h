#pragma once

#include <QObject>
#include <QString>
#include <optional>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/client/selection.h"
#include "emca/probe/light_probe.h"

namespace emca::light_probe {

/// Where a direction at a vertex leads or comes from.
enum class DirectionKind { incoming, outgoing, emitter, nextEventVisible, nextEventOccluded, other };
inline constexpr int kDirectionKinds = 6;

/// A direction at the vertex that paths took.
struct Direction {
    DirectionKind kind = DirectionKind::outgoing;
    Vec3f towards;                              ///< unit, away from the vertex
    std::optional<client::VertexId> end;        ///< the vertex at its other end, where there is one
    float length = 0;                           ///< scene units; of environment hits without meaning
};

/// What a light probe needs to know of the selected vertex.
struct ProbeVertex {
    client::VertexId id;
    Vec3f position;
    Vec3f normal;             ///< geometric, unit, on the side from which the path came; 0 if the surface is not known
    Vec3f towardsPrevious;    ///< unit; 0 if there is nothing before it
    std::vector<Direction> directions;   ///< those of other paths first, so that the vertex' own are painted last
    QString label() const;               ///< "path 12, vertex 3"
};

/// The selected vertex, or why there is no light probe of it, in words.
struct VertexAnswer {
    std::optional<ProbeVertex> vertex;
    QString obstacle;
};
/// Directions of other paths, at most; evenly picked if there are more.
inline constexpr std::size_t kMostOthers = 4096;
/// Other paths are at this vertex if one of their vertices is nearer than 2 % of the length of the segment that leads here.
VertexAnswer probeVertex(const client::Dataset& dataset, const client::Selection& selection);

enum class Orientation { world, surface };
/// World: up is the axis that is nearest to the camera's up, the middle looks back to the camera,
/// since surfaces that it sees face it. Surface: up is the
/// normal, the middle is the side to which a mirror would send the path.
probe::SphereFrame frameOf(const ProbeVertex& vertex, Orientation orientation, const std::optional<Camera>& camera);

}  // namespace emca::light_probe
