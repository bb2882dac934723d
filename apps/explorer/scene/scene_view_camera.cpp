#include <QTimer>

#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

#include "base/path_ids.h"
#include "scene_view_impl.h"

// Where the 3D view looks from, and what it keeps in view.
namespace emca::explorer {
namespace {

constexpr double kSlowFrame = 0.06;      ///< seconds; slower scenes use their stand-in while the camera moves
constexpr double kPatience = 1.2;        ///< seconds; frames that would take longer show a stand-in when nothing moves, too
constexpr double kMargin = 0.1;          ///< of the view around what a flight brings into view
constexpr double kMinimumExtent = 0.3;   ///< paths smaller than this fraction of the view are worth a flight
constexpr float kContext = 0.16f;        ///< radius around the first vertex that stays in view, of its distance to the eye

}  // namespace

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
        if (canvas->lastSurfaceSeconds() > kSlowFrame) setCoarse(true);
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
    meshes->setDetail(coarse ? MeshDetail::coarse : settledDetail());
    pathLayer->setCoarse(coarse);
    heat->setCoarse(coarse);
    updateAntiAliasing();
    canvas->requestRender();
}

/// The finest one that a frame has the time for: the medium one is drawn first, and tells how long all would take.
MeshDetail SceneView::Impl::settledDetail() const {
    if (options.fullDetail || !meshes->hasMedium()) return MeshDetail::full;
    if (mediumSeconds <= 0) return MeshDetail::medium;
    const double ratio = double(meshes->triangleCount(MeshDetail::full)) / double(std::max<std::size_t>(meshes->triangleCount(MeshDetail::medium), 1));
    return mediumSeconds * ratio < kPatience ? MeshDetail::full : MeshDetail::medium;
}

/// Comes after each frame that drew the surfaces.
void SceneView::Impl::surfacesDrawn(double seconds) {
    if (isCoarse || !meshes->hasMedium() || meshes->detail() != MeshDetail::medium) return;
    mediumSeconds = mediumSeconds > 0 ? std::min(mediumSeconds, seconds) : seconds;
    if (settledDetail() == MeshDetail::full) QTimer::singleShot(0, &view, [this] { showDetail(); });
}

void SceneView::Impl::showDetail() {
    if (!canvas || isCoarse || meshes->detail() == settledDetail()) return;
    meshes->setDetail(settledDetail());
    canvas->requestRender();
    updateOverlay();
}

ClipPlane SceneView::Impl::clip() const { return clipPlane(options.clip, box(), driver.pose()); }

void SceneView::Impl::prepareFrame() {
    const double depth = dot(extentCentre - driver.pose().position, driver.pose().direction());
    const double reach = 1.4 * double(domeRadius(box()));
    const auto fadeNear = static_cast<float>(std::max(0.0, depth - 0.35 * reach));
    const auto fadeFar = static_cast<float>(std::max(depth, 0.0) + 1.3 * reach);
    const float scale = canvas->pixelScale();
    const ClipPlane plane = clip();
    meshes->prepareFrame(scale, fadeNear, fadeFar, plane);
    heat->setClip(plane);
    pathLayer->prepareFrame(scale, fadeNear, fadeFar, options.clip.paths ? plane : ClipPlane());
    objectLayer->prepareFrame(scale, options.clip.paths ? plane : ClipPlane());
    glyphs->prepareFrame(driver.pose(), scale);
}

void SceneView::Impl::updateGlyph() {
    if (!glyphs) return;
    // In proportion to the scene, yet never so large that it reaches what the camera looks at.
    float size = 0.06f * box().diagonal();
    if (focusDistance > 0) size = std::min(size, 0.15f * static_cast<float>(focusDistance));
    glyphs->setCamera(dataset.camera(), imageAspect(), size);
    const auto scene = dataset.meshes();
    glyphs->setLights(scene ? std::span<const Mesh>(*scene) : std::span<const Mesh>(), 0.05f * meshes->core().diagonal());
}

void SceneView::Impl::updateExtent() {
    const BoundingBox all = box();
    const Vec3f centre = all.empty ? Vec3f() : all.centre();
    float radius = 1.4f * domeRadius(all);
    if (dataset.camera() && isFinite(dataset.camera()->position))
        radius = std::max(radius, 1.05f * length(dataset.camera()->position - centre));
    for (const analysis::Segment& s : geometry.segments) radius = std::max(radius, length(s.end - centre));
    for (const analysis::Segment& s : geometry.segments) radius = std::max(radius, length(s.start - centre));
    for (const SceneObjects::Entry& entry : objects.entries()) {
        if (!entry.visible) continue;
        const BoundingBox around = boundsOf(*entry.object);
        if (!around.empty) radius = std::max(radius, length(around.centre() - centre) + around.diagonal() / 2);
    }
    extentCentre = {centre.x, centre.y, centre.z};
    extentRadius = std::min(double(radius), 12.0 * double(domeRadius(all)));
    if (meshes && !meshes->box().empty)
        extentRadius = std::max(extentRadius, double(length(meshes->box().centre() - centre)) + double(meshes->box().diagonal()) / 2);
    driver.setStep(0.02 * std::min(double(domeRadius(all)), focusDistance > 0 ? 1.5 * focusDistance : 1e30));
    if (canvas) canvas->setExtent(extentCentre, extentRadius);
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

}  // namespace emca::explorer
