#include <QElapsedTimer>

#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "emca/analysis/surface_name.h"
#include "scene_view_impl.h"

// 3D data on surfaces: the coloured surfaces, their bar, and the value under the cursor.
namespace emca::explorer {
namespace {

constexpr int kProbeMilliseconds = 16;   ///< between two look-ups while the cursor moves

}  // namespace

void SceneView::Impl::connectSurfaces() {
    bar->setObjectName("surfaceBar");
    pathBar->setObjectName("pathBar");
    bar->hide();
    pathBar->hide();
    QObject::connect(pathBar, &ColorBar::rangeEdited, &view, [this](const analysis::ValueRange& range) {
        SceneOptions changed = options;
        changed.colors.limits = SurfaceLimits{range.min, range.max};
        view.setOptions(changed);
    });
    probing.setSingleShot(true);
    probing.setInterval(kProbeMilliseconds);
    QObject::connect(&probing, &QTimer::timeout, &view, [this] { probe(); });
    QObject::connect(&surfaces, &SurfaceModel::surfaceChanged, &view, [this] { showSurface(); });
    QObject::connect(&surfaces, &SurfaceModel::styleChanged, &view, [this] { showSurfaceStyle(); });
    QObject::connect(bar, &ColorBar::rangeEdited, &view,
                     [this](const analysis::ValueRange& range) { surfaces.setLimits(SurfaceLimits{range.min, range.max}); });
}

void SceneView::Impl::showSurface() {
    if (!heat) return;
    setCoarse(false);
    heat->setSurface(surfaces.surface());
    probed.reset();
}

void SceneView::Impl::showSurfaceStyle() {
    if (!heat) return;
    heat->setColors(surfaces.colors());
    heat->apply(options, surfaces.style().opacity, theme.colors());
    meshes->setCovered(heat->isShown());
    updateAntiAliasing();
    arrange();
    probeSoon();
    canvas->requestRender();
}

/// FXAA would smear the borders between faces.
void SceneView::Impl::updateAntiAliasing() {
    canvas->surfaces().SetUseFXAA(options.smoothEdges && !isCoarse && !(heat && heat->isShown()));
}

std::vector<std::pair<ColorBar*, ColorBarContent>> SceneView::Impl::bars() const {
    std::vector<std::pair<ColorBar*, ColorBarContent>> shownBars;
    if (!canvas) return shownBars;
    if (surfaces.shown() && !surfaces.isColor()) shownBars.push_back({bar, {surfaces.style().map, surfaces.range(), {}, surfaces.title()}});
    if (coloring.isOn() && coloring.categories().empty() && options.paths != PathChoice::none)
        shownBars.push_back({pathBar, {.map = options.colors.map, .range = coloring.range(), .title = coloring.title(),
                                       .integral = coloring.isIntegral(), .ground = theme.colors().sceneBottom}});
    return shownBars;
}

int SceneView::Impl::barWidth() const { return ColorBar::kTitledWidth * static_cast<int>(bars().size()); }

void SceneView::Impl::arrange() {
    const int width = barWidth();
    const QRect picture(0, 0, std::max(view.width() - width, 1), view.height());
    const bool resized = canvas && canvas->geometry() != picture;
    if (canvas) canvas->setGeometry(picture);
    overlay->setGeometry(picture);
    const auto wanted = bars();
    for (ColorBar* each : {bar, pathBar})
        if (std::ranges::find(wanted, each, &std::pair<ColorBar*, ColorBarContent>::first) == wanted.end()) each->hide();
    int x = picture.right() + 1;
    for (auto [each, content] : wanted) {
        each->setGeometry(x, 0, ColorBar::kTitledWidth, view.height());
        content.pointer = each->content().pointer;
        each->show(content);
        each->setVisible(true);
        x += ColorBar::kTitledWidth;
    }
    if (resized && !moved()) goHome(true);
    updateOverlay();
}

void SceneView::Impl::probeSoon() {
    if (!canvas) return;
    if (surfaces.shown() && cursor && !hovered && !hoveredObject && !input->rectangleMode()) {
        if (!probing.isActive()) probing.start();
    } else if (probed) {
        probed.reset();
        bar->setPointer(std::numeric_limits<double>::quiet_NaN());
        updateOverlay();
    }
}

/// The surface that is seen: nothing that the clipping plane cuts away.
std::optional<SurfaceHit> SceneView::Impl::pickSurface(Ray ray) const {
    const ClipPlane plane = clip();
    double skipped = 0;
    if (!plane.keeps(ray.origin)) {
        const double approach = dot(plane.normal, ray.direction);
        if (!(approach > 0)) return std::nullopt;
        skipped = (plane.offset - dot(plane.normal, ray.origin)) / approach * (1 + 1e-9);
        ray.origin = ray.origin + ray.direction * skipped;
    }
    auto hit = surfaces.surface()->picker.pick(ray, options.backFaces);
    if (!hit || !plane.keeps(ray.origin + ray.direction * hit->distance)) return std::nullopt;
    hit->distance += skipped;
    return hit;
}

void SceneView::Impl::probe() {
    const bool had = probed.has_value();
    probed.reset();
    if (surfaces.shown() && cursor && !hovered && !hoveredObject) {
        QElapsedTimer clock;
        clock.start();
        const Ray ray = rayThrough(driver.pose(), viewport(), cursor->x(), cursor->y(), 2 * extentRadius);
        if (const auto hit = pickSurface(ray)) probed = surfaces.valueAt(*hit);
        // Scenes so large that a look-up takes long get fewer of them, and the view stays quick.
        probing.setInterval(std::max(kProbeMilliseconds, 3 * static_cast<int>(clock.elapsed())));
    }
    if (!had && !probed) return;
    bar->setPointer(probed && !surfaces.isColor() ? probed->scalar : std::numeric_limits<double>::quiet_NaN());
    updateOverlay();
}

OverlayContent::Card SceneView::Impl::surfaceCard(const SurfaceValue& value, QPointF at) const {
    OverlayContent::Card card{at, {}, {}};
    const SurfaceLayerData* layer = surfaces.shown();
    if (!layer) return card;
    const auto number = [&](double v) {
        const QString unit = toQString(layer->description.unit);
        return toQString(analysis::formatNumber(v)) + (unit.isEmpty() || std::isnan(v) ? QString() : ' ' + unit);
    };
    const bool isNone = std::isnan(value.scalar);
    card.title = isNone ? QString("no data") : surfaces.isColor() ? toQString(analysis::formatColor(Color{value.channels[0], value.channels[1], value.channels[2]}))
                                                                  : number(value.scalar);
    card.rows.emplace_back("layer", toQString(layer->description.name));
    if (surfaces.isColor() && !isNone) card.rows.emplace_back("luminance", number(value.scalar));
    card.rows.emplace_back("mesh", toQString(analysis::meshName(static_cast<std::int32_t>(value.hit.mesh), *surfaces.surface()->meshes)));
    card.rows.emplace_back("face", QString("%1, cell %2").arg(value.hit.face).arg(value.refinedFace));
    card.rows.emplace_back("points", value.points > 0 ? toQString(analysis::formatNumber(double(value.points)))
                                                      : QString("none; filled in from neighbours"));
    return card;
}

}  // namespace emca::explorer
