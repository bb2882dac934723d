#include <QLocale>

#include "base/state_overlay.h"
#include "scene_view_impl.h"
#include "vertex_card.h"

// What is written over the picture of the 3D view.
namespace emca::explorer {
namespace {

constexpr Index kMaximumLabels = 64;

std::vector<OverlayContent::LegendEntry> legendOf(const ShownRoles& roles, const ThemeColors& c) {
    using Mark = OverlayContent::Mark;
    std::vector<OverlayContent::LegendEntry> legend;
    if (roles.path) legend.push_back({"path", c.path});
    if (roles.current) legend.push_back({"into the selected vertex", c.currentSegment});
    if (roles.emitter) legend.push_back({"to a light or the environment", c.emitter});
    if (roles.visible) legend.push_back({"next event, visible", c.nextEventVisible});
    if (roles.occluded) legend.push_back({"next event, occluded", c.nextEventOccluded, Mark::dashes});
    if (roles.selected) legend.push_back({"selected vertex", c.selected, Mark::dot});
    return legend;
}

QString count(std::size_t n, const QString& one, const QString& many) {
    return QLocale::c().toString(qulonglong(n)) + " " + (n == 1 ? one : many);
}

}  // namespace

OverlayContent SceneView::Impl::overlayContent(Viewport size) const {
    OverlayContent content;
    if (!pathLayer) return content;
    const Projection projected(driver.pose(), size);
    if (options.depthLabels && shown.path && options.paths != PathChoice::none) {
        const IndexRange range = paths.vertices(*shown.path);
        const auto add = [&](Index v, bool strong) {
            const auto s = projected.project(geometry.points[v]);
            if (!s || !projected.contains(*s)) return;
            content.labels.push_back({{s->x, s->y}, QString::number(paths.depthIndex(v)), strong});
        };
        if (shown.vertex) add(*shown.vertex, true);
        for (Index v = range.first; v < range.last && v - range.first < kMaximumLabels; ++v)
            if (v != shown.vertex) add(v, false);
    }
    if (options.legend) content.legend = legendOf(pathLayer->roles(), theme.colors());
    QStringList caption;
    if (surfaces.isColor())   // no bar says what it is
        caption << surfaces.title() + QString("   ·   exposure %1 EV").arg(double(surfaces.style().exposure), 0, 'f', 1);
    if (options.paths == PathChoice::all && pathLayer->drawnPaths().size() < paths.pathCount())
        caption << QLocale::c().toString(qulonglong(pathLayer->drawnPaths().size())) + " of " +
                       count(paths.pathCount(), "path", "paths") + " drawn";
    if (geometry.unplacedVertices > 0)
        caption << count(geometry.unplacedVertices, "vertex has", "vertices have") + " no finite position";
    if (meshes && meshes->skippedTriangles() > 0)
        caption << count(meshes->skippedTriangles(), "triangle", "triangles") + " with a faulty position left out";
    content.caption = caption.join("   ·   ");
    if (input && input->rectangleMode()) content.hint = "Drag a rectangle over vertices or paths   ·   Esc cancels";
    else if (paths.empty() && dataset.meshes() && !surfaces.shown()) content.hint = "Click a pixel in the image to see its paths here";
    if (hovered)
        if (const auto s = projected.project(geometry.points[*hovered])) content.ring = QPointF(s->x, s->y);
    if (hovered && cursor) content.card = vertexCard(paths, *hovered, *cursor);
    else if (probed && cursor) content.card = surfaceCard(*probed, *cursor);
    return content;
}

void SceneView::Impl::updateOverlay() {
    const auto rectangle = overlay->content.rectangle;
    overlay->content = overlayContent(viewport());
    overlay->content.rectangle = rectangle;
    overlay->update();
}

}  // namespace emca::explorer
