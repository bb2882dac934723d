#include "window/selection_steps.h"

#include <algorithm>

#include "base/path_ids.h"

namespace emca::explorer {

std::optional<Index> currentPath(const client::Dataset& dataset, const client::Selection& selection) {
    const auto& id = selection.state().currentPath;
    return id ? dataset.paths().findPath(id->pixel, id->sample, id->part) : std::nullopt;
}

std::optional<Index> currentVertex(const client::Dataset& dataset, const client::Selection& selection) {
    const auto& id = selection.state().vertex;
    const auto path = currentPath(dataset, selection);
    return id && path ? dataset.paths().findVertex(*path, id->depth, id->subpath) : std::nullopt;
}

void stepPath(const client::Dataset& dataset, client::Selection& selection, int by) {
    const PathSet& paths = dataset.paths();
    if (paths.empty()) return;
    const auto current = selection.state().currentPath;
    const auto& selected = selection.state().paths;
    if (selected.size() > 1) {
        const auto at = current ? std::find(selected.begin(), selected.end(), *current) : selected.end();
        const auto count = static_cast<std::ptrdiff_t>(selected.size());
        const std::ptrdiff_t from = at == selected.end() ? (by > 0 ? -1 : 0) : at - selected.begin();
        const client::PathId next = selected[static_cast<std::size_t>((from + by + count) % count)];
        selection.setCurrentPath(next);
        return;
    }
    const auto count = static_cast<std::int64_t>(paths.pathCount());
    const auto position = currentPath(dataset, selection);
    const std::int64_t from = position ? static_cast<std::int64_t>(*position) : (by > 0 ? -1 : 0);
    selection.setPaths({pathId(paths, static_cast<Index>((from + by + count) % count))});
}

void stepVertex(const client::Dataset& dataset, client::Selection& selection, int by) {
    const PathSet& paths = dataset.paths();
    if (paths.empty()) return;
    auto path = currentPath(dataset, selection);
    if (!path) {
        path = 0;
        if (!selection.state().paths.empty()) {
            const client::PathId& first = selection.state().paths.front();
            if (const auto found = paths.findPath(first.pixel, first.sample, first.part)) path = found;
        }
    }
    const IndexRange range = paths.vertices(*path);
    if (range.empty()) return;
    const auto current = currentVertex(dataset, selection);
    Index next = by > 0 ? range.first : range.last - 1;
    if (current) {
        if (by > 0) next = std::min(*current + 1, range.last - 1);
        else next = *current > range.first ? *current - 1 : range.first;
    }
    selection.setVertex(vertexId(paths, next));
}

}  // namespace emca::explorer
