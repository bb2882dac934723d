#include <QApplication>
#include <QClipboard>
#include <QMenu>

#include <algorithm>

#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "scene_view_impl.h"
#include "vertex_card.h"

// What mouse and menu of the 3D view mean for the Selection.
namespace emca::explorer {

PickContext SceneView::Impl::pickContext() const {
    const bool visible = options.paths != PathChoice::none;
    return {paths, geometry, visible ? std::span<const Index>(shown.paths) : std::span<const Index>(),
            pathLayer ? pathLayer->drawnPaths() : std::span<const Index>()};
}

void SceneView::Impl::click(QPointF at, Qt::KeyboardModifiers modifiers) {
    const auto hit = pickAt(pickContext(), projection(), at.x(), at.y());
    if (!hit) return;   // a click beside everything keeps the selection; Esc clears it
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
    if (canvas && !input->rectangleMode()) canvas->setCursor(vertex ? Qt::PointingHandCursor : Qt::ArrowCursor);
    probeSoon();
    if (vertex == hovered && !vertex) return;
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

void SceneView::Impl::menu(QPointF at, QPoint global) {
    const auto hit = pickAt(pickContext(), projection(), at.x(), at.y());
    QMenu menu(&view);
    if (hit) {
        const client::PathId path = pathId(paths, hit->path);
        const QString title = pathTitle(paths, hit->path);
        QObject::connect(menu.addAction("Select only " + title), &QAction::triggered, &view, [=, this] {
            client::Selection::State state = selection.state();
            state.paths = {path};
            state.currentPath = path;
            state.vertex = hit->vertex ? std::optional(vertexId(paths, *hit->vertex)) : std::nullopt;
            selection.set(std::move(state));
        });
        QObject::connect(menu.addAction((selection.isSelected(path) ? "Remove " : "Add ") + title +
                                        (selection.isSelected(path) ? " from the selection" : " to the selection")),
                         &QAction::triggered, &view, [=, this] { selection.togglePath(path); });
        QObject::connect(menu.addAction("Show the whole path"), &QAction::triggered, &view,
                         [=, this] { showPath(hit->path, hit->vertex, true); });
        if (hit->vertex) {
            const Index vertex = *hit->vertex;
            QObject::connect(menu.addAction("Focus this vertex"), &QAction::triggered, &view, [=, this] { closeUp(vertex); });
            QObject::connect(menu.addAction("Copy position"), &QAction::triggered, &view, [=, this] {
                if (const auto p = paths.position(vertex))
                    QApplication::clipboard()->setText(toQString(analysis::formatValueFull(*p)));
            });
            QObject::connect(menu.addAction("Copy values"), &QAction::triggered, &view, [=, this] {
                const OverlayContent::Card card = vertexCard(paths, vertex, {});
                QString text = card.title;
                for (const auto& [key, value] : card.rows) text += "\n" + key + "\t" + value;
                QApplication::clipboard()->setText(text);
            });
        }
        menu.addSeparator();
    }
    QObject::connect(menu.addAction("Focus\tF"), &QAction::triggered, &view, &SceneView::focusSelection);
    QAction* backAction = menu.addAction("Back\tBackspace");
    backAction->setEnabled(driver.canGoBack());
    QObject::connect(backAction, &QAction::triggered, &view, &SceneView::back);
    QObject::connect(menu.addAction("Renderer's camera\tHome"), &QAction::triggered, &view, &SceneView::resetCamera);
    QObject::connect(menu.addAction("Select by rectangle\tR"), &QAction::triggered, &view, [this] { view.setRectangleMode(true); });
    QObject::connect(menu.addAction("Copy picture"), &QAction::triggered, &view,
                     [this] { QApplication::clipboard()->setImage(view.renderImage(view.size())); });
    menu.exec(global);
}

}  // namespace emca::explorer
