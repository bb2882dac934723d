#include <algorithm>

#include "base/path_ids.h"
#include "scene_view_impl.h"

// What the mouse means for the Selection.
namespace emca::explorer {

PickContext SceneView::Impl::pickContext() const {
    const bool visible = options.paths != PathChoice::none;
    return {paths, geometry, visible ? std::span<const Index>(shown.paths) : std::span<const Index>(),
            pathLayer ? pathLayer->drawnPaths() : std::span<const Index>()};
}

void SceneView::Impl::click(QPointF at, Qt::KeyboardModifiers modifiers) {
    const auto hit = pickAt(pickContext(), projection(), at.x(), at.y());
    if (!hit) {   // a click beside everything keeps the selection; Esc clears it
        if (const auto object = objectAt(at)) objects.pick(object->id, object->element);
        return;
    }
    const client::PathId path = pathId(paths, hit->path);
    client::Selection::State state = selection.state();
    const bool selected = selection.isSelected(path);
    if (modifiers & Qt::ControlModifier && selected && !hit->vertex) return selection.togglePath(path);
    if (!selected) {
        if (!(modifiers & (Qt::ControlModifier | Qt::ShiftModifier))) state.paths.clear();
        state.paths.insert(std::ranges::lower_bound(state.paths, path), path);
    }
    state.currentPath = path;
    state.vertex = hit->vertex ? std::optional(vertexId(paths, *hit->vertex)) : std::nullopt;
    selection.set(std::move(state));
}

std::optional<ObjectHit> SceneView::Impl::objectAt(QPointF at) {
    if (objects.entries().empty()) return std::nullopt;
    const Ray ray = rayThrough(driver.pose(), viewport(), at.x(), at.y(), 2 * extentRadius);
    return objectPicker.pick(objects.entries(), projection(), ray, at.x(), at.y());
}

void SceneView::Impl::focusAt(QPointF at) {
    if (const auto vertex = pickVertex(pickContext(), projection(), at.x(), at.y())) closeUp(*vertex);
}

void SceneView::Impl::closeUp(Index vertex) {
    // A quarter of the way to its neighbours on each side, so that one sees what happens here and where it leads.
    const Vec3f centre = geometry.points[vertex];
    if (!isFinite(centre)) return;
    std::vector<Vec3f> points{centre};
    for (const analysis::Segment& s : geometry.segmentsOf(paths.pathOf(vertex))) {
        if (s.from != vertex && s.to != vertex) continue;
        const Vec3f way = (s.from == vertex ? s.end : s.start) - centre;
        points.push_back(centre + way * 0.3f);
        points.push_back(centre - way * 0.3f);
    }
    driver.flyTo(framed(driver.target(), viewport(), points, 0.1, centre));
}

void SceneView::Impl::hover(std::optional<QPointF> at) {
    cursor = at;
    std::optional<Index> vertex;
    if (at && !input->rectangleMode()) vertex = pickVertex(pickContext(), projection(), at->x(), at->y());
    const std::optional<ObjectHit> before = hoveredObject;
    hoveredObject.reset();
    if (at && !vertex && !input->rectangleMode()) hoveredObject = objectAt(*at);
    if (canvas && !input->rectangleMode()) canvas->setCursor(vertex ? Qt::PointingHandCursor : Qt::ArrowCursor);
    probeSoon();
    if (vertex == hovered && !vertex && !before && !hoveredObject) return;
    selection.setHovered(vertex ? std::optional(vertexId(paths, *vertex)) : std::nullopt);
    updateOverlay();
}

void SceneView::Impl::selectInside(QRectF r, Qt::KeyboardModifiers modifiers) {
    const PickedInside inside = pickInside(pickContext(), projection(), {r.left(), r.top(), r.right(), r.bottom()});
    client::Selection::State state = selection.state();
    const bool add = modifiers & (Qt::ControlModifier | Qt::ShiftModifier);
    if (!add) state.paths.clear();
    for (const client::PathId& id : pathIds(paths, inside.paths)) state.paths.push_back(id);
    std::ranges::sort(state.paths);
    state.paths.erase(std::ranges::unique(state.paths).begin(), state.paths.end());
    if (inside.vertex) {
        state.vertex = vertexId(paths, *inside.vertex);
        state.currentPath = state.vertex->path;
    } else if (!add) {
        state.vertex.reset();
        state.currentPath = state.paths.size() == 1 ? std::optional(state.paths.front()) : std::nullopt;
    }
    selection.set(std::move(state));
}

}  // namespace emca::explorer
