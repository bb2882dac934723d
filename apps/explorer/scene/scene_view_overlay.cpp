#include <QLocale>

#include <algorithm>
#include <tuple>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "scene_view_impl.h"
#include "vertex_card.h"

// What is written over the picture of the 3D view.
namespace emca::explorer {
namespace {

constexpr Index kMaximumLabels = 64;
constexpr std::size_t kMaximumCategories = 10, kMaximumLegend = 16;

using Mark = OverlayContent::Mark;
using LegendEntry = OverlayContent::LegendEntry;

std::vector<QColor> rampOf(analysis::ColorMapId map) {
    std::vector<QColor> ramp;
    for (int i = 0; i <= 8; ++i) {
        const analysis::Color8 c = analysis::ColorMap::get(map).map(i / 8.0);
        ramp.emplace_back(c.r, c.g, c.b);
    }
    return ramp;
}

/// What the colours of paths mean.
void addRoles(const ShownRoles& roles, const PathColoring& coloring, const ThemeColors& c, std::vector<LegendEntry>& legend) {
    const bool byValue = coloring.isOn();
    if (roles.path && !byValue) legend.push_back({"path", c.path});
    if (byValue && (roles.path || roles.emitter) && !coloring.categories().empty()) {
        for (std::size_t i = 0; i < std::min(coloring.categories().size(), kMaximumCategories); ++i)
            legend.push_back({toQString(coloring.categories()[i]), coloring.categoryColor(i)});
        if (coloring.categories().size() > kMaximumCategories)
            legend.push_back({QString("and %1 more").arg(coloring.categories().size() - kMaximumCategories), c.mutedText});
    }
    if (roles.current) legend.push_back({"into the selected vertex", c.currentSegment});
    if (roles.emitter && !byValue) legend.push_back({"to a light or the environment", c.emitter});
    if (roles.visible) legend.push_back({"next event, visible", c.nextEventVisible});
    if (roles.occluded) legend.push_back({"next event, occluded", c.nextEventOccluded, Mark::dashes});
    if (roles.selected) legend.push_back({"selected vertex", c.selected, Mark::dot});
}

void addObjects(const SceneObjects& objects, std::vector<LegendEntry>& legend) {
    for (const SceneObjects::Entry& entry : objects.entries()) {
        if (!entry.visible || legend.size() >= kMaximumLegend) continue;
        const ObjectColors& colors = entry.object->colors;
        const QString name = toQString(entry.object->name);
        if (!colors.colors.empty()) {
            legend.push_back({name, QColor(), Mark::ramp, {QColor(colors.colors.front().r, colors.colors.front().g, colors.colors.front().b)}});
        } else if (!colors.values.empty()) {
            const analysis::ValueRange range = rangeOf(colors);
            const QString numbers = toQString(analysis::formatNumber(range.min) + " to " + analysis::formatNumber(range.max)) +
                                    (colors.unit.empty() ? QString() : " " + toQString(colors.unit));
            legend.push_back({name + "   " + numbers, QColor(), Mark::ramp, rampOf(colors.map)});
        } else {
            legend.push_back({name, QColor(colors.color.r, colors.color.g, colors.color.b), Mark::square});
        }
    }
}

std::vector<OverlayContent::Axis> axesOf(const ViewPose& pose, const ThemeColors& c) {
    const Vec3d d = pose.direction(), r = pose.right(), u = cross(r, d);
    std::vector<OverlayContent::Axis> axes;
    const std::tuple<Vec3d, QColor, QString> all[] = {{{1, 0, 0}, c.axisX, "x"}, {{0, 1, 0}, c.axisY, "y"}, {{0, 0, 1}, c.axisZ, "z"}};
    for (const auto& [axis, color, name] : all) axes.push_back({QPointF(dot(axis, r), -dot(axis, u)), -dot(axis, d), color, name});
    return axes;
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
    if (options.legend) {
        addRoles(pathLayer->roles(), coloring, theme.colors(), content.legend);
        addObjects(objects, content.legend);
    }
    if (options.axes && dataset.meshes()) content.axes = axesOf(driver.pose(), theme.colors());
    QStringList caption;
    if (meshes->hasMedium() && meshes->detail() == MeshDetail::medium && !surfaces.shown())
        caption << QString("stand-in of %1 for %2").arg(toQString(analysis::formatInteger(std::int64_t(meshes->triangleCount(MeshDetail::medium)))),
                                                        count(meshes->triangleCount(MeshDetail::full), "triangle", "triangles"));
    if (!coloring.error().isEmpty()) caption << coloring.error();
    if (objectLayer->leftOut() > 0) caption << count(objectLayer->leftOut(), "element", "elements") + " of objects left out";
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
    if (hovered && cursor) {
        content.card = vertexCard(paths, *hovered, *cursor);
        if (coloring.value(*hovered)) content.card->rows.emplace_back(coloring.title(), toQString(coloring.text(*hovered)));
    } else if (hoveredObject && cursor) {
        if (const SceneObjects::Entry* entry = objects.find(hoveredObject->id))
            content.card = OverlayContent::Card{*cursor, toQString(labelOf(*entry->object, hoveredObject->element)), {}};
    } else if (probed && cursor) {
        content.card = surfaceCard(*probed, *cursor);
    }
    return content;
}

void SceneView::Impl::updateOverlay() {
    const auto rectangle = overlay->content.rectangle;
    overlay->content = overlayContent(viewport());
    overlay->content.rectangle = rectangle;
    overlay->update();
}

}  // namespace emca::explorer
