#include <QApplication>
#include <QClipboard>
#include <QMenu>

#include <algorithm>

#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "scene_view_impl.h"
#include "vertex_card.h"

// What the 3D view can do with the thing under the cursor.
namespace emca::explorer {

/// What is drawn now of a path and at a vertex, as switches.
PathRays SceneView::Impl::raysOf(Index path) const {
    if (const auto own = raySwitches.of(pathId(paths, path))) return *own;
    const bool selected = std::ranges::binary_search(shown.paths, path);
    return {selected, selected && (options.nextEvents >= NextEventChoice::selectedPaths ||
                                   (shown.path == path && options.nextEvents == NextEventChoice::currentPath))};
}

VertexRays SceneView::Impl::raysAt(Index vertex) const {
    if (const auto own = raySwitches.of(vertexId(paths, vertex))) return *own;
    const PathRays path = raysOf(paths.pathOf(vertex));
    const bool whole = options.wholePath || shown.vertex != vertex;
    return {path.line && (whole || options.incoming), path.line && (whole || options.outgoing),
            path.nextEvents || (shown.vertex == vertex && options.nextEvents >= NextEventChoice::currentVertex)};
}

void SceneView::Impl::addRayActions(QMenu& menu, const Picked& hit) {
    const auto addSwitch = [&](QMenu* into, const QString& text, bool on, auto change) {
        QAction* action = into->addAction(text);
        action->setCheckable(true);
        action->setChecked(on);
        QObject::connect(action, &QAction::triggered, &view, [=, this](bool now) {
            RaySwitches switches = raySwitches;
            change(switches, now);
            view.setRaySwitches(switches);
        });
    };
    QMenu* ofPath = menu.addMenu("Draw of this path");
    const client::PathId path = pathId(paths, hit.path);
    const PathRays rays = raysOf(hit.path);
    addSwitch(ofPath, "Line", rays.line, [=](RaySwitches& s, bool on) { s.set(path, {on, rays.nextEvents}); });
    addSwitch(ofPath, "Next event", rays.nextEvents, [=](RaySwitches& s, bool on) { s.set(path, {rays.line, on}); });
    if (!hit.vertex) return;
    QMenu* atVertex = menu.addMenu("Draw at this vertex");
    const client::VertexId vertex = vertexId(paths, *hit.vertex);
    const VertexRays at = raysAt(*hit.vertex);
    addSwitch(atVertex, "Ray into it", at.incoming, [=](RaySwitches& s, bool on) { s.set(vertex, {on, at.outgoing, at.nextEvents}); });
    addSwitch(atVertex, "Ray out of it", at.outgoing, [=](RaySwitches& s, bool on) { s.set(vertex, {at.incoming, on, at.nextEvents}); });
    addSwitch(atVertex, "Next event", at.nextEvents, [=](RaySwitches& s, bool on) { s.set(vertex, {at.incoming, at.outgoing, on}); });
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
        addRayActions(menu, *hit);
        menu.addSeparator();
    }
    if (!raySwitches.empty())
        QObject::connect(menu.addAction("Forget switches of single paths and vertices"), &QAction::triggered, &view,
                         [this] { view.setRaySwitches({}); });
    QObject::connect(menu.addAction("Focus\tF"), &QAction::triggered, &view, &SceneView::focusSelection);
    QAction* backAction = menu.addAction("Back\tBackspace");
    backAction->setEnabled(driver.canGoBack());
    QObject::connect(backAction, &QAction::triggered, &view, &SceneView::back);
    QObject::connect(menu.addAction("Renderer's camera\tHome"), &QAction::triggered, &view, &SceneView::resetCamera);
    QObject::connect(menu.addAction("Select by rectangle\tR"), &QAction::triggered, &view, [this] { view.setRectangleMode(true); });
    QObject::connect(menu.addAction("Save picture…\tP"), &QAction::triggered, &view, &SceneView::pictureRequested);
    QObject::connect(menu.addAction("Copy picture"), &QAction::triggered, &view,
                     [this] { QApplication::clipboard()->setImage(view.renderImage(view.size())); });
    menu.exec(global);
}

}  // namespace emca::explorer
