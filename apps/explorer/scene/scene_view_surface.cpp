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
    bar->hide();
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

int SceneView::Impl::barWidth() const { return canvas && surfaces.shown() && !surfaces.isColor() ? ColorBar::kTitledWidth : 0; }

ColorBarContent SceneView::Impl::barContent() const { return {surfaces.style().map, surfaces.range(), {}, surfaces.title()}; }

void SceneView::Impl::arrange() {
    const int width = barWidth();
    const QRect picture(0, 0, std::max(view.width() - width, 1), view.height());
    const bool resized = canvas && canvas->geometry() != picture;
    if (canvas) canvas->setGeometry(picture);
    overlay->setGeometry(picture);
    bar->setVisible(width > 0);
    if (width > 0) {
        bar->setGeometry(picture.right() + 1, 0, width, view.height());
        ColorBarContent content = barContent();
        content.pointer = bar->content().pointer;
        bar->show(content);
    }
    if (resized && !moved()) goHome(true);
    updateOverlay();
}

void SceneView::Impl::probeSoon() {
    if (!canvas) return;
    if (surfaces.shown() && cursor && !hovered && !input->rectangleMode()) {
        if (!probing.isActive()) probing.start();
    } else if (probed) {
        probed.reset();
        bar->setPointer(std::numeric_limits<double>::quiet_NaN());
        updateOverlay();
    }
}

void SceneView::Impl::probe() {
    const bool had = probed.has_value();
    probed.reset();
    if (surfaces.shown() && cursor && !hovered) {
        QElapsedTimer clock;
        clock.start();
        const Ray ray = rayThrough(driver.pose(), viewport(), cursor->x(), cursor->y(), 2 * extentRadius);
        if (const auto hit = surfaces.surface()->picker.pick(ray, options.backFaces)) probed = surfaces.valueAt(*hit);
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
