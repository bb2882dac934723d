#include "scene_view.h"

#include <QResizeEvent>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "base/view_keys.h"
#include "scene_view_impl.h"

namespace emca::explorer {
namespace {

constexpr int kSettleMilliseconds = 220; ///< after the last move the full scene comes back

}  // namespace

SceneView::Impl::Impl(SceneView& owner, client::Dataset& data, client::Selection& sel, Theme& look)
    : view(owner), dataset(data), selection(sel), theme(look), states(new StateOverlay(look, &owner)),
      overlay(new SceneOverlay(look, &owner)), surfaces(data, look),
      bar(new ColorBar(look, &owner)), pathBar(new ColorBar(look, &owner)) {
    if (hasOpenGl()) {
        canvas = new SceneCanvas(theme, &view);
        meshes = std::make_unique<MeshLayer>(canvas->surfaces(), canvas->context());
        glyphs = std::make_unique<GlyphLayer>(canvas->context());
        pathLayer = std::make_unique<PathLayer>(canvas->context(), canvas->strokes(), coloring);
        heat = std::make_unique<HeatLayer>(canvas->surfaces());
        objectLayer = std::make_unique<ObjectLayer>(canvas->surfaces(), canvas->context());
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
    objects.listen([this](std::uint32_t) { objectsChanged(); });
}

void SceneView::Impl::connectInput() {
    input->setPivot([this] { return pivot(); });
    QObject::connect(canvas, &SceneCanvas::aboutToRender, &view, [this] { prepareFrame(); });
    QObject::connect(canvas, &SceneCanvas::surfacesDrawn, &view, [this](double seconds) { surfacesDrawn(seconds); });
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
    QObject::connect(input, &SceneInput::orthographicRequested, &view, [this] {
        SceneOptions changed = options;
        changed.orthographic = !changed.orthographic;
        view.setOptions(changed);
    });
    QObject::connect(input, &SceneInput::clipRequested, &view, [this] {
        SceneOptions changed = options;
        if (changed.clip.axis != ClipAxis::none) lastClipAxis = changed.clip.axis;
        changed.clip.axis = changed.clip.axis == ClipAxis::none ? lastClipAxis : ClipAxis::none;
        view.setOptions(changed);
    });
    QObject::connect(input, &SceneInput::pictureRequested, &view, &SceneView::pictureRequested);
    QObject::connect(input, &SceneInput::dragging, &view, [this](bool on) {
        if (on) hover(std::nullopt);
    });
}

SceneView::SceneView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), impl_(std::make_unique<Impl>(*this, dataset, selection, theme)) {
    setMinimumSize(200, 150);
    if (impl_->canvas) {
        setFocusProxy(impl_->canvas);
        setViewKeys(*impl_->canvas, "Scene",
                    {{"W", "Fly forwards (or ↑; with Shift faster)"}, {"S", "Fly backwards (or ↓)"}, {"A", "Fly left (or ←)"},
                     {"D", "Fly right (or →)"}, {"E", "Fly up (or page up)"}, {"Q", "Fly down (or page down)"},
                     {"Home", "Renderer's camera"}, {"Backspace", "Back to the view before"}, {"F", "Focus on the selection"},
                     {"R", "Select by rectangle"}, {"O", "Parallel projection"}, {"X", "Clipping plane"}, {"P", "Save a picture"}});
    }
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
const RaySwitches& SceneView::raySwitches() const { return impl_->raySwitches; }
void SceneView::setRaySwitches(const RaySwitches& switches) {
    if (switches == impl_->raySwitches) return;
    impl_->raySwitches = switches;
    impl_->raysChanged();
    emit optionsChanged();
}
std::optional<client::PathId> SceneView::currentPathId() const {
    return impl_->shown.path ? std::optional(pathId(impl_->paths, *impl_->shown.path)) : std::nullopt;
}
std::optional<client::VertexId> SceneView::currentVertexId() const {
    return impl_->shown.vertex ? std::optional(vertexId(impl_->paths, *impl_->shown.vertex)) : std::nullopt;
}
std::optional<PathRays> SceneView::currentPathRays() const {
    return impl_->shown.path ? std::optional(impl_->raysOf(*impl_->shown.path)) : std::nullopt;
}
std::optional<VertexRays> SceneView::currentVertexRays() const {
    return impl_->shown.vertex ? std::optional(impl_->raysAt(*impl_->shown.vertex)) : std::nullopt;
}
const PathColoring& SceneView::pathColors() const { return impl_->coloring; }
const PathSet& SceneView::paths() const { return impl_->paths; }
std::uint64_t SceneView::surfaceFrameCount() const { return impl_->canvas ? impl_->canvas->surfaceFrameCount() : 0; }
std::size_t SceneView::shownTriangles() const { return impl_->meshes ? impl_->meshes->triangleCount(impl_->meshes->detail()) : 0; }
SceneObjects& SceneView::objects() { return impl_->objects; }
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

void SceneView::resizeEvent(QResizeEvent*) {
    impl_->arrange();
}

}  // namespace emca::explorer
