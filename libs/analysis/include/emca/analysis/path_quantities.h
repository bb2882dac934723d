#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/path_set.h"

namespace emca::analysis {

/// One number per path.
enum class PathQuantity : std::uint8_t {
    sample = 0,     ///< sample index
    luminance = 1,  ///< of the final estimate
    red = 2, green = 3, blue = 4,
    depth = 5,      ///< largest depth index with a position
    vertexCount = 6,
};
/// "sample index", "luminance", …: the label of an axis.
std::string_view label(PathQuantity quantity);
/// Unit for the axis, or empty: radiance in "W/(sr m²)".
std::string_view unit(PathQuantity quantity);

/// Numbers of those paths that have one. values[i] belongs to the path at position paths[i] of the PathSet; positions
/// ascend. A path without final estimate has no luminance, which is not the same as a NaN estimate.
struct PathSeries {
    std::vector<double> values;
    std::vector<Index> paths;
    std::size_t size() const { return values.size(); }
};
PathSeries pathSeries(const PathSet& paths, PathQuantity quantity);
std::optional<double> pathValue(const PathSet& paths, Index path, PathQuantity quantity);

/// All paths: NaN and infinity first, then by luminance, those without final estimate last; equal ones in their order.
std::vector<Index> brightestFirst(const PathSet& paths);

inline constexpr Index kNoIndex = 0xffffffffu;

/// True if light is emitted at a vertex: a recorded emission decides; without one, the event "emission" or "background",
/// an environment hit, or (with `meshes`, those of the scene) an emitting surface.
bool isEmitterVertex(const PathSet& paths, Index vertex, std::span<const Mesh> meshes = {});

/// How a segment is drawn: scatter white, the other two yellow.
enum class SegmentKind : std::uint8_t { scatter = 0, toEmitter = 1, toEnvironment = 2 };

/// A straight piece of a path between two recorded positions.
struct Segment {
    Index path = 0;
    Index from = kNoIndex;    ///< vertex; kNoIndex: the path's origin
    Index to = 0;             ///< vertex
    Vec3f start, end;         ///< world space
    SegmentKind kind = SegmentKind::scatter;
    Subpath subpath = Subpath::camera;
    bool gap = false;         ///< vertices without position (or missing depths) lie between
};
/// Next-event estimation: from a vertex to the sampled point on a light.
struct NextEventSegment {
    Index path = 0;
    Index vertex = 0;
    Index nextEvent = 0;      ///< position in the PathSet's nextEvents
    Vec3f start, end;
    bool visible = false;
};

/// Segments of one path in order: the camera subpath from the origin (or its first vertex), then the light subpath from
/// its first vertex; a light subpath's segment is toEmitter if it begins on a light. Positions that are not finite
/// are left out, as are segments of no length.
std::vector<Segment> pathSegments(const PathSet& paths, Index path, std::span<const Mesh> meshes = {});
std::vector<NextEventSegment> nextEventSegments(const PathSet& paths, Index path);
/// Appends to what is there: for all paths of a set without one allocation each.
void appendSegments(const PathSet& paths, Index path, std::span<const Mesh> meshes, std::vector<Segment>& out);
void appendNextEventSegments(const PathSet& paths, Index path, std::vector<NextEventSegment>& out);

/// Where the walk came from when it reached a vertex: the position before it on its subpath, or the origin.
std::optional<Vec3f> previousPosition(const PathSet& paths, Index vertex);
/// Where the walk went from a vertex: the next position on its subpath.
std::optional<Vec3f> nextPosition(const PathSet& paths, Index vertex);

}  // namespace emca::analysis
