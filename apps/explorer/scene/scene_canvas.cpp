#include "scene_canvas.h"

#include <vtkCamera.h>
#include <vtkCullerCollection.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <QVTKInteractor.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace emca::explorer {
namespace {

void setBackground(vtkRenderer& renderer, const QColor& top, const QColor& bottom) {
    renderer.GradientBackgroundOn();
    renderer.SetBackground(bottom.redF(), bottom.greenF(), bottom.blueF());
    renderer.SetBackground2(top.redF(), top.greenF(), top.blueF());
}

}  // namespace

SceneCanvas::SceneCanvas(Theme& theme, QWidget* parent) : QVTKOpenGLNativeWidget(parent), theme_(theme) {
    setFormat(QVTKOpenGLNativeWidget::defaultFormat());
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    vtkNew<vtkGenericOpenGLRenderWindow> window;
    window->SetMultiSamples(0);
    window->SetNumberOfLayers(3);
    window->AddRenderer(surfaces_);
    window->AddRenderer(context_);
    window->AddRenderer(strokes_);
    setRenderWindow(window.Get());
    // The view moves its camera itself: VTK's interactor styles swallow button releases.
    interactor()->SetInteractorStyle(nullptr);
    context_->SetLayer(1);
    strokes_->SetLayer(2);
    for (vtkRenderer* renderer : {static_cast<vtkRenderer*>(context_.Get()), strokes_.Get()}) {
        renderer->SetPreserveDepthBuffer(true);
        renderer->SetActiveCamera(surfaces_->GetActiveCamera());
    }
    for (vtkRenderer* renderer : {static_cast<vtkRenderer*>(surfaces_.Get()), static_cast<vtkRenderer*>(context_.Get()), strokes_.Get()}) {
        renderer->GetCullers()->RemoveAllItems();
        renderer->SetAutomaticLightCreation(false);
    }
    vtkNew<vtkLight> headLight;
    headLight->SetLightTypeToHeadlight();
    surfaces_->AddLight(headLight);
    surfaces_->SetUseFXAA(true);
    restyle();
    connect(&theme_, &Theme::themeChanged, this, [this] { restyle(); });
}

SceneCanvas::~SceneCanvas() = default;

void SceneCanvas::restyle() {
    setBackground(*surfaces_, theme_.colors().sceneTop, theme_.colors().sceneBottom);
    requestRender();
}

void SceneCanvas::setPose(const ViewPose& pose) {
    if (pose == pose_) return;
    pose_ = pose;
    requestRender();
    emit poseChanged();
}

void SceneCanvas::setExtent(Vec3d centre, double radius) {
    extentCentre_ = centre;
    extentRadius_ = std::isfinite(radius) && radius > 0 ? radius : 1;
    requestRender();
}

void SceneCanvas::applyPose() {
    const double depth = dot(extentCentre_ - pose_.position, pose_.direction());
    far_ = std::max(depth + extentRadius_, 1e-3 * extentRadius_);
    // 24 bits of depth resolve a ratio of some thousands without flicker between surfaces.
    near_ = std::max(depth - extentRadius_, far_ * 4e-4);
    vtkCamera* camera = surfaces_->GetActiveCamera();
    camera->SetPosition(pose_.position.x, pose_.position.y, pose_.position.z);
    camera->SetFocalPoint(pose_.focus.x, pose_.focus.y, pose_.focus.z);
    camera->SetViewUp(pose_.up.x, pose_.up.y, pose_.up.z);
    camera->SetViewAngle(pose_.verticalFieldOfView);
    camera->SetParallelProjection(pose_.orthographic);
    camera->SetParallelScale(pose_.heightAtFocus() / 2);
    if (pose_.orthographic) near_ = depth - extentRadius_;
    camera->SetClippingRange(near_, far_);
}

void SceneCanvas::requestRender() {
    surfaces_->forget();
    requestContext();
}

void SceneCanvas::requestContext() {
    context_->forget();
    requestStrokes();
}

void SceneCanvas::requestStrokes() {
    dirty_ = true;
    update();
}

void SceneCanvas::initializeGL() {
    QVTKOpenGLNativeWidget::initializeGL();
    pixelScale_ = static_cast<float>(effectiveDevicePixelRatio());
}

void SceneCanvas::paintGL() {
    if (dirty_) {
        const auto start = std::chrono::steady_clock::now();
        dirty_ = false;
        const std::uint64_t surfaceFrames = surfaces_->drawnFrames();
        pixelScale_ = static_cast<float>(effectiveDevicePixelRatio());
        applyPose();
        emit aboutToRender();
        // VTK's adapter answers each frame drawn outside its own paint() with update(): the whole window would be
        // composed a second time for nothing.
        setAttribute(Qt::WA_UpdatesDisabled, true);
        renderWindow()->Render();
        setAttribute(Qt::WA_UpdatesDisabled, false);
        // Drivers draw later than they are told; only a finished frame says how long it takes.
        renderWindow()->WaitForCompletion();
        ++frames_;
        frameSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (surfaces_->drawnFrames() != surfaceFrames) {
            surfaceSeconds_ = frameSeconds_;
            emit surfacesDrawn(surfaceSeconds_);
        }
    }
    QVTKOpenGLNativeWidget::paintGL();
}

QImage SceneCanvas::renderImage(QSize size) {
    if (!isValid() || size.isEmpty()) return {};
    makeCurrent();
    vtkRenderWindow* window = renderWindow();
    const int width = window->GetSize()[0], height = window->GetSize()[1];
    window->SetSize(size.width(), size.height());
    pixelScale_ = std::max(1.f, static_cast<float>(size.height()) / static_cast<float>(std::max(this->height(), 1)));
    surfaces_->forget();
    context_->forget();
    applyPose();
    emit aboutToRender();
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, size.width() - 1, size.height() - 1, 0, pixels);
    QImage image(size, QImage::Format_RGB32);
    const unsigned char* row = pixels->GetPointer(0);
    for (int y = size.height() - 1; y >= 0; --y) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
        for (int x = 0; x < size.width(); ++x, row += 3) line[x] = qRgb(row[0], row[1], row[2]);
    }
    window->SetSize(width, height);
    doneCurrent();
    requestRender();
    return image;
}

}  // namespace emca::explorer
