#include "scene_view.h"

#include <QElapsedTimer>
#include <QLabel>
#include <QPainter>
#include <QResizeEvent>
#include <QTimer>

#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "base/listeners.h"
#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "scene_view_impl.h"

namespace emca::explorer {
namespace {

constexpr double kSlowFrame = 0.06;      ///< seconds; slower scenes use their stand-in while the camera moves
constexpr int kSettleMilliseconds = 220; ///< after the last move the full scene comes back
constexpr double kMargin = 0.1;          ///< of the view around what a flight brings into view
constexpr double kMinimumExtent = 0.3;   ///< paths smaller than this fraction of the view are worth a flight
constexpr float kContext = 0.16f;  ///< radius around the first vertex that stays in view, of its distance to the eye

std::string plain(const QString& text) { return text.toStdString(); }

}  // namespace

SceneView::Impl::Impl(SceneView& owner, client::Dataset& data, client::Selection& sel, Theme& look)
    : view(owner), dataset(data), selection(sel), theme(look), states(new StateOverlay(look, &owner)),
      overlay(new SceneOverlay(look, &owner)), surfaces(data, look), bar(new ColorBar(look, &owner)) {
    if (hasOpenGl()) {
        canvas = new SceneCanvas(theme, &view);
        meshes = std::make_unique<MeshLayer>(canvas->surfaces(), canvas->strokes());
        glyphs = std::make_unique<GlyphLayer>(canvas->strokes());
        pathLayer = std::make_unique<PathLayer>(canvas->strokes());
        heat = std::make_unique<HeatLayer>(canvas->surfaces());
        input = new SceneInput(*canvas, driver);
        connectInput();
        canvas->lower();
    }
    overlay->raise();
    states->raise();
    settle.setSingleShot(true);
    settle.setInterval(kSettleMilliseconds);
    QObject::connect(&settle, &QTimer::timeout, &view, [this] { setCoarse(false); });
    QObject::connect(&loader, &MeshLoader::ready, &view, [this](const auto& prepared) { meshesReady(prepared); });
    QObject::connect(&driver, &CameraDriver::poseChanged, &view, [this](const ViewPose& pose) { poseMoved(pose); });
    QObject::connect(&theme, &Theme::themeChanged, &view, [this] {
        loadMeshes();
        applyOptions();
    });
    connectSurfaces();
}

void SceneView::Impl::connectInput() {
    input->setPivot([this] { return pivot(); });
    QObject::connect(canvas, &SceneCanvas::aboutToRender, &view, [this] { prepareFrame(); });
    QObject::connect(input, &SceneInput::clicked, &view, [this](QPointF at, Qt::KeyboardModifiers m) { click(at, m); });
    QObject::connect(input, &SceneInput::doubleClicked, &view, [this](QPointF at) { focusAt(at); });
    QObject::connect(input, &SceneInput::hovered, &view, [this](QPointF at) { hover(at); });
    QObject::connect(input, &SceneInput::left, &view, [this] { hover(std::nullopt); });
    QObject::connect(input, &SceneInput::menuRequested, &view, [this](QPointF at, QPoint global) { menu(at, global); });
    QObject::connect(input, &SceneInput::rectangleDragged, &view, [this](QRectF r) {
        overlay->content.rectangle = r.isNull() ? std::nullopt : std::optional(r);
        overlay->update();
    });
    QObject::connect(input, &SceneInput::rectangleSelected, &view,
                     [this](QRectF r, Qt::KeyboardModifiers m) { selectInside(r, m); });
    QObject::connect(input, &SceneInput::rectangleModeChanged, &view, [this](bool on) {
        updateOverlay();
        emit view.rectangleModeChanged(on);
    });
    QObject::connect(input, &SceneInput::focusRequested, &view, [this] { view.focusSelection(); });
    QObject::connect(input, &SceneInput::resetRequested, &view, [this] { view.resetCamera(); });
    QObject::connect(input, &SceneInput::backRequested, &view, [this] { view.back(); });
    QObject::connect(input, &SceneInput::dragging, &view, [this](bool on) {
        if (on) hover(std::nullopt);
    });
}

double SceneView::Impl::imageAspect() const {
    if (const auto& info = dataset.info(); info && info->height > 0) return double(info->width) / info->height;
    const client::ImageEntry* image = dataset.currentImage();
    if (image && image->image && image->image->color.height() > 0)
        return double(image->image->color.width()) / image->image->color.height();
    return 0;
}

Viewport SceneView::Impl::viewport() const { return {std::max(view.width() - barWidth(), 1), std::max(view.height(), 1)}; }

Projection SceneView::Impl::projection() const { return Projection(driver.pose(), viewport()); }

Vec3d SceneView::Impl::pivot() const {
    if (shown.vertex && isFinite(geometry.points[*shown.vertex])) {
        const Vec3f p = geometry.points[*shown.vertex];
        return {p.x, p.y, p.z};
    }
    return driver.pose().focus;
}

ViewPose SceneView::Impl::homePose() const {
    const double aspect = viewport().aspect();
    ViewPose pose = dataset.camera() ? poseOfCamera(*dataset.camera(), imageAspect(), aspect, box(), focusDistance) : poseOfBox(box(), aspect);
    pose.orthographic = options.orthographic;
    return pose;
}

BoundingBox SceneView::Impl::box() const { return meshes && !meshes->core().empty ? meshes->core() : pathBox; }

/// The axis of the world that is nearest to up in the image: the camera's own is tilted where it looks down.
Vec3d SceneView::Impl::upAxis() const { return nearestAxis(home.up); }

void SceneView::Impl::goHome(bool immediate) {
    const ViewPose pose = homePose();
    home = pose;
    if (input) input->setUpAxis(upAxis());
    if (immediate) driver.moveTo(pose);
    else driver.flyTo(pose);
}

void SceneView::Impl::poseMoved(const ViewPose& pose) {
    if (canvas) {
        if (canvas->lastFrameSeconds() > kSlowFrame) setCoarse(true);
        settle.start();
        canvas->setPose(pose);
    }
    probeSoon();
    updateOverlay();
    emit view.poseChanged();
}

void SceneView::Impl::setCoarse(bool coarse) {
    if (!canvas || coarse == isCoarse) return;
    isCoarse = coarse;
    meshes->setCoarse(coarse);
    pathLayer->setCoarse(coarse);
    heat->setCoarse(coarse);
    updateAntiAliasing();
    canvas->requestRender();
}

void SceneView::Impl::prepareFrame() {
    const double depth = dot(extentCentre - driver.pose().position, driver.pose().direction());
    const double reach = 1.4 * double(domeRadius(box()));
    const auto fadeNear = static_cast<float>(std::max(0.0, depth - 0.35 * reach));
    const auto fadeFar = static_cast<float>(std::max(depth, 0.0) + 1.3 * reach);
    const float scale = canvas->pixelScale();
    meshes->prepareFrame(scale, fadeNear, fadeFar);
    pathLayer->prepareFrame(scale, fadeNear, fadeFar);
    glyphs->prepareFrame(driver.pose(), scale);
}

void SceneView::Impl::datasetChanged(std::uint32_t parts) {
    using Part = client::DatasetPart;
    if (parts & Part::meshes) {
        loadError.clear();
        loadingFraction.reset();
    }
    if (parts & (Part::meshes | Part::camera | Part::info)) {
        if (parts & Part::meshes) loadMeshes();
        if (parts & (Part::meshes | Part::camera)) {
            const auto scene = dataset.meshes();
            focusDistance = scene && dataset.camera()
                                ? double(firstHit(*scene, dataset.camera()->position, dataset.camera()->direction).value_or(0)) : 0;
        }
        updateGlyph();
        if (!moved()) goHome(true);
    }
    if (parts & (Part::currentTrace | Part::meshes | Part::camera)) rebuildPaths();
    updateState();
    updateOverlay();
}

void SceneView::Impl::updateGlyph() {
    if (!glyphs) return;
    // In proportion to the scene, yet never so large that it reaches what the camera looks at.
    float size = 0.06f * box().diagonal();
    if (focusDistance > 0) size = std::min(size, 0.15f * static_cast<float>(focusDistance));
    glyphs->setCamera(dataset.camera(), imageAspect(), size);
}

void SceneView::Impl::loadMeshes() { loader.load(dataset.meshes(), theme.colors().mesh, options.ownColors); }

void SceneView::Impl::meshesReady(const std::shared_ptr<PreparedMeshes>& prepared) {
    if (!canvas) return;
    const bool wasHome = !moved();
    setCoarse(false);
    meshes->setMeshes(prepared);
    const BoundingBox now = meshes->box();
    const bool sameScene = !now.empty && !lastBox.empty && now.min == lastBox.min && now.max == lastBox.max;
    if (!now.empty) lastBox = now;
    updateGlyph();
    rebuildPaths();
    applyOptions();
    if (wasHome || (!now.empty && !sameScene)) goHome(true);
    updateState();
}

void SceneView::Impl::rebuildPaths() {
    paths = dataset.paths();
    const auto scene = dataset.meshes();
    geometry = makePathGeometry(paths, dataset.camera(), scene ? std::span<const Mesh>(*scene) : std::span<const Mesh>(),
                                meshes ? meshes->core() : BoundingBox());
    pathBox = {};
    for (const Vec3f& p : geometry.points)
        if (isFinite(p)) pathBox.extend(p);
    updateExtent();
    if (pathLayer) pathLayer->setPaths(&paths, &geometry);
    shown = {};
    hovered.reset();
    selectionChanged(client::SelectionPart::paths, false);
}

void SceneView::Impl::updateExtent() {
    const BoundingBox all = box();
    const Vec3f centre = all.empty ? Vec3f() : all.centre();
    float radius = 1.4f * domeRadius(all);
    if (dataset.camera() && isFinite(dataset.camera()->position))
        radius = std::max(radius, 1.05f * length(dataset.camera()->position - centre));
    for (const analysis::Segment& s : geometry.segments) radius = std::max(radius, length(s.end - centre));
    for (const analysis::Segment& s : geometry.segments) radius = std::max(radius, length(s.start - centre));
    extentCentre = {centre.x, centre.y, centre.z};
    extentRadius = std::min(double(radius), 12.0 * double(domeRadius(all)));
    if (meshes && !meshes->box().empty)
        extentRadius = std::max(extentRadius, double(length(meshes->box().centre() - centre)) + double(meshes->box().diagonal()) / 2);
    driver.setStep(0.02 * std::min(double(domeRadius(all)), focusDistance > 0 ? 1.5 * focusDistance : 1e30));
    if (canvas) canvas->setExtent(extentCentre, extentRadius);
}

ShownSelection SceneView::Impl::resolve() const {
    ShownSelection s;
    const client::Selection::State& state = selection.state();
    s.paths = findPaths(paths, state.paths);
    if (state.currentPath) s.path = findPath(paths, *state.currentPath);
    if (state.vertex) s.vertex = findVertex(paths, *state.vertex);
    if (!s.path) s.vertex.reset();
    return s;
}

void SceneView::Impl::selectionChanged(std::uint32_t parts, bool fly) {
    using Part = client::SelectionPart;
    if (parts & ~static_cast<std::uint32_t>(Part::hover)) {
        const ShownSelection before = shown;
        shown = resolve();
        if (pathLayer) pathLayer->setSelection(shown);
        if (fly && options.flyToSelection && shown.path && (shown.path != before.path || shown.vertex != before.vertex))
            showPath(*shown.path, shown.vertex, false);
        if (canvas && !(shown == before)) canvas->requestRender();
    }
    if (parts & Part::hover) {
        hovered = selection.hovered() ? findVertex(paths, *selection.hovered()) : std::nullopt;
    }
    updateOverlay();
}

/// What a flight to a path keeps in view: its vertices. The environment and lights far outside the scene are directions
/// rather than places: with them in view, everything else would be a dot. The selected vertex counts wherever it is.
std::vector<Vec3f> SceneView::Impl::contextOf(Index path, std::optional<Index> vertex) const {
    const BoundingBox scene = box();
    const float reach = 1.2f * domeRadius(scene);
    std::vector<Vec3f> points;
    const IndexRange range = paths.vertices(path);
    for (Index v = range.first; v < range.last; ++v) {
        const Vec3f p = geometry.points[v];
        if (v == vertex || (!paths.isEnvironment(v) && length(p - scene.centre()) < reach)) points.push_back(p);
    }
    // A short path alone would fill the view and show nothing of where it is: keep a part of what its camera saw.
    const std::optional<Vec3f> eye = paths.origin(path);
    if (eye && !points.empty() && isFinite(*eye) && isFinite(points.front())) {
        const Vec3f first = points.front();
        const float around = kContext * length(first - *eye);
        for (const Vec3f axis : {Vec3f{around, 0, 0}, Vec3f{0, around, 0}, Vec3f{0, 0, around}}) {
            points.push_back(first + axis);
            points.push_back(first - axis);
        }
    }
    return points;
}

void SceneView::Impl::showPath(Index path, std::optional<Index> vertex, bool always) {
    const std::vector<Vec3f> points = contextOf(path, vertex);
    const std::optional<Vec3f> interest = vertex ? std::optional(geometry.points[*vertex]) : std::nullopt;
    const ViewPose from = driver.target();
    driver.flyTo(always ? framed(from, viewport(), points, kMargin, interest)
                        : framedIfNeeded(from, viewport(), points, 0.6 * kMargin, kMinimumExtent, interest));
}

void SceneView::Impl::applyOptions() {
    if (canvas) {
        const ThemeColors& colors = theme.colors();
        updateAntiAliasing();
        canvas->surfaces().SetUseDepthPeeling(options.depthPeeling);
        canvas->surfaces().SetMaximumNumberOfPeels(16);
        meshes->apply(options, colors);
        heat->apply(options, surfaces.style().opacity, colors);
        pathLayer->apply(options, colors);
        glyphs->apply(options.cameraGlyph, colors);
        canvas->requestRender();
    }
    driver.setAnimated(options.animate);
    if (driver.pose().orthographic != options.orthographic) {
        ViewPose pose = driver.target();
        pose.orthographic = options.orthographic;
        home.orthographic = options.orthographic;
        driver.moveTo(pose);
    }
    updateOverlay();
}

void SceneView::Impl::updateState() {
    if (!canvas) {
        states->showError("The 3D view needs OpenGL 3.2, which this display does not offer. All other views work without it.");
    } else if (loader.isLoading()) {
        states->showBusy("Preparing the scene…");
    } else if (dataset.meshes() || !paths.empty()) {
        states->clear();
    } else if (!loadError.isEmpty()) {
        states->showError(loadError, "Try again", [this] { emit view.reloadRequested(); });
    } else if (loadingFraction) {
        states->showBusy("Loading the scene…", *loadingFraction);
    } else {
        // Something is here without a scene: a session that has none, or a renderer that was left before it came.
        states->showEmpty("No scene", dataset.info() ? "It is not here. Connect to the renderer to load it."
                                                     : "Connect to a renderer to see its scene and the paths of a pixel.",
                          "Connect…", [this] { emit view.connectRequested(); });
    }
}

// --- The widget ---

SceneView::SceneView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), impl_(std::make_unique<Impl>(*this, dataset, selection, theme)) {
    setMinimumSize(200, 150);
    if (impl_->canvas) setFocusProxy(impl_->canvas);
    impl_->loadMeshes();
    impl_->applyOptions();
    impl_->datasetChanged(client::DatasetPart::camera | client::DatasetPart::currentTrace);
    impl_->listenTo();
}

SceneView::~SceneView() = default;

const SceneOptions& SceneView::options() const { return impl_->options; }

void SceneView::setOptions(const SceneOptions& options) {
    if (options == impl_->options) return;
    const bool recolor = options.ownColors != impl_->options.ownColors;
    impl_->options = options;
    if (recolor) impl_->loadMeshes();
    impl_->applyOptions();
    emit optionsChanged();
}

ViewPose SceneView::pose() const { return impl_->driver.target(); }
void SceneView::setPose(const ViewPose& pose) { impl_->driver.moveTo(pose); }
bool SceneView::isLoading() const { return impl_->loader.isLoading() || impl_->surfaces.isPreparing(); }
bool SceneView::isMoving() const { return impl_->driver.isMoving(); }
double SceneView::lastFrameSeconds() const { return impl_->canvas ? impl_->canvas->lastFrameSeconds() : 0; }
std::uint64_t SceneView::frameCount() const { return impl_->canvas ? impl_->canvas->frameCount() : 0; }
void SceneView::requestFrame() {
    if (impl_->canvas) impl_->canvas->requestRender();
}
SurfaceModel& SceneView::surfaces() { return impl_->surfaces; }
std::optional<SurfaceValue> SceneView::hoveredSurface() const { return impl_->probed; }
void SceneView::resetCamera() { impl_->goHome(false); }
void SceneView::back() { impl_->driver.back(); }

void SceneView::showLoading(double fraction) {
    if (impl_->loadError.isEmpty() && impl_->loadingFraction == fraction) return;
    impl_->loadError.clear();
    impl_->loadingFraction = fraction;
    impl_->updateState();
}

void SceneView::endLoading() {
    if (!impl_->loadingFraction) return;
    impl_->loadingFraction.reset();
    impl_->updateState();
}

void SceneView::showLoadError(const QString& sentence) {
    impl_->loadError = sentence;
    impl_->loadingFraction.reset();
    impl_->updateState();
}

void SceneView::setRectangleMode(bool on) {
    if (impl_->input) impl_->input->setRectangleMode(on);
}

void SceneView::focusSelection() {
    const ShownSelection& s = impl_->shown;
    if (s.vertex && isFinite(impl_->geometry.points[*s.vertex])) return impl_->closeUp(*s.vertex);
    std::vector<Vec3f> points;
    for (const Index path : s.paths)
        for (const Vec3f& p : impl_->contextOf(path, std::nullopt)) points.push_back(p);
    if (points.empty()) {
        const BoundingBox box = impl_->box();
        if (box.empty) return;
        for (int i = 0; i < 8; ++i)
            points.push_back({i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
    }
    impl_->driver.flyTo(framed(impl_->driver.target(), impl_->viewport(), points, kMargin));
}

std::optional<QPointF> SceneView::screenPosition(const client::VertexId& vertex) const {
    const auto v = findVertex(impl_->paths, vertex);
    if (!v) return std::nullopt;
    const auto s = impl_->projection().project(impl_->geometry.points[*v]);
    return s ? std::optional(QPointF(s->x, s->y)) : std::nullopt;
}

QImage SceneView::renderImage(QSize size) {
    if (!impl_->canvas) return {};
    impl_->setCoarse(false);
    // Overlays and the colour bar are laid out in the view's own pixels and enlarged with the lines.
    const double scale = impl_->canvas->height() > 0 ? std::max(1.0, double(size.height()) / impl_->canvas->height()) : 1;
    const QSize inner(std::max(size.width() - int(impl_->barWidth() * scale), 1), size.height());
    const QImage scene = impl_->canvas->renderImage(inner);
    if (scene.isNull()) return scene;
    QImage image(size, QImage::Format_RGB32);
    image.fill(impl_->theme.colors().ground);
    OverlayContent content = impl_->overlayContent({int(inner.width() / scale), int(inner.height() / scale)});
    content.hint.clear();
    content.card.reset();
    content.rectangle.reset();
    QPainter painter(&image);
    painter.drawImage(0, 0, scene);
    painter.scale(scale, scale);
    paintOverlay(painter, QSizeF(inner) / scale, content, impl_->theme);
    if (impl_->barWidth() > 0)
        paintColorBar(painter, QRectF(inner.width() / scale, 0, impl_->barWidth(), size.height() / scale), impl_->barContent(), impl_->theme);
    return image;
}

Result<void> SceneView::saveImage(const QString& file, QSize size) {
    if (!impl_->canvas)
        return Error{ErrorCode::notSupported, "A picture of the 3D view was asked for, but this display has no OpenGL 3.2."};
    if (size.width() < 1 || size.height() < 1 || size.width() > 16384 || size.height() > 16384)
        return Error{ErrorCode::invalidArgument, "A picture of " + std::to_string(size.width()) + " x " +
                                                     std::to_string(size.height()) + " pixels was asked for; 1 to 16384 work."};
    const QImage image = renderImage(size);
    if (image.isNull() || !image.save(file, "PNG"))
        return Error{ErrorCode::fileUnwritable, "The picture could not be written to '" + plain(file) +
                                                    "'; check that the folder exists and may be written."};
    return {};
}

void SceneView::resizeEvent(QResizeEvent*) {
    impl_->arrange();
}

}  // namespace emca::explorer
