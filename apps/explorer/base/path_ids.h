#pragma once

#include <optional>
#include <span>
#include <vector>

#include "emca/client/selection.h"
#include "emca/core/path_set.h"

namespace emca::explorer {

// Between the identifiers of a Selection and the positions of a PathSet.

inline client::PathId pathId(const PathSet& paths, Index path) {
    return {paths.pixel(path), paths.sample(path), paths.part(path)};
}

inline client::VertexId vertexId(const PathSet& paths, Index vertex) {
    return {pathId(paths, paths.pathOf(vertex)), paths.depthIndex(vertex), paths.subpath(vertex)};
}

inline std::vector<client::PathId> pathIds(const PathSet& paths, std::span<const Index> positions) {
    std::vector<client::PathId> ids;
    ids.reserve(positions.size());
    for (const Index path : positions) ids.push_back(pathId(paths, path));
    return ids;
}

/// Position of a path, nothing if it is not loaded.
inline std::optional<Index> findPath(const PathSet& paths, const client::PathId& id) {
    return paths.findPath(id.pixel, id.sample, id.part);
}

inline std::optional<Index> findVertex(const PathSet& paths, const client::VertexId& id) {
    const std::optional<Index> path = findPath(paths, id.path);
    return path ? paths.findVertex(*path, id.depth, id.subpath) : std::nullopt;
}

/// Positions of those that are loaded, ascending. `ids` is sorted, as in a Selection.
inline std::vector<Index> findPaths(const PathSet& paths, std::span<const client::PathId> ids) {
    std::vector<Index> positions;
    positions.reserve(ids.size());
    if (ids.size() < paths.pathCount() / 16) {
        for (const client::PathId& id : ids)
            if (const std::optional<Index> path = findPath(paths, id)) positions.push_back(*path);
        return positions;
    }
    // Many: both are in the same order, so one pass over both is cheaper than a search for each.
    Index path = 0;
    for (const client::PathId& id : ids) {
        while (path < paths.pathCount() && pathId(paths, path) < id) ++path;
        if (path < paths.pathCount() && pathId(paths, path) == id) positions.push_back(path);
    }
    return positions;
}

/// Whether the paths belong to more than one pixel, so that a sample index alone does not name one.
inline bool severalPixels(const PathSet& paths) {
    return !paths.empty() && !(paths.pixel(0) == paths.pixel(paths.pathCount() - 1));
}

}  // namespace emca::explorer
