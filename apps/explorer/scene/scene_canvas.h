#pragma once

#include <QImage>
#include <QVTKOpenGLNativeWidget.h>
#include <vtkNew.h>

#include <cstdint>
#include <functional>

#include "base/theme.h"
#include "emca/core/mesh.h"
#include "kept_renderer.h"
#include "view_pose.h"

class vtkRenderer;

namespace emca::explorer {

/// The OpenGL surface of the 3D view: three layers with one camera. Surfaces lie below; over them, with the depth of what is
/// opaque, so that translucent walls never tint the data, strokes that a selection does not change, and over those the
/// ones that it does. Renders when Qt paints, at most once per
/// turn of the event loop. Takes no input itself.
class SceneCanvas : public QVTKOpenGLNativeWidget {
    Q_OBJECT
  public:
    SceneCanvas(Theme& theme, QWidget* parent);
    ~SceneCanvas() override;

    vtkRenderer& surfaces() { return *surfaces_; }
    vtkRenderer& context() { return *context_; }
    vtkRenderer& strokes() { return *strokes_; }

    const ViewPose& pose() const { return pose_; }
    void setPose(const ViewPose& pose);
    /// What has to fit between the near and the far plane.
    void setExtent(Vec3d centre, double radius);
    Viewport viewport() const { return {std::max(width(), 1), std::max(height(), 1)}; }
    /// Device pixels per pixel, larger while an enlarged picture is made.
    float pixelScale() const { return pixelScale_; }
    double nearPlane() const { return near_; }
    double farPlane() const { return far_; }

    void requestRender();
    /// Surfaces are as they were: their picture is kept.
    void requestContext();
    /// Only strokes of the uppermost layer have changed: the picture below them is kept.
    void requestStrokes();
    /// How often the surfaces were drawn so far.
    std::uint64_t surfaceFrameCount() const { return surfaces_->drawnFrames(); }
    /// The picture at any size, without overlays; line widths grow with its height. Empty without OpenGL.
    QImage renderImage(QSize size);
    /// Duration of the last frame with everything drawn, in seconds.
    double lastFrameSeconds() const { return frameSeconds_; }
    /// Duration of the last frame that drew the surfaces.
    double lastSurfaceSeconds() const { return surfaceSeconds_; }
    /// How many frames were drawn so far, pictures of renderImage() not counted.
    std::uint64_t frameCount() const { return frames_; }

  signals:
    void poseChanged();
    /// Comes before each frame: the last chance to set uniforms.
    void aboutToRender();
    /// Comes after each frame that drew the surfaces anew, with its duration.
    void surfacesDrawn(double seconds);

  protected:
    void initializeGL() override;
    void paintGL() override;

  private:
    void applyPose();
    void restyle();

    Theme& theme_;
    vtkNew<KeptRenderer> surfaces_, context_;
    vtkNew<vtkRenderer> strokes_;
    ViewPose pose_;
    Vec3d extentCentre_;
    double extentRadius_ = 1;
    double near_ = 0.01, far_ = 100;
    float pixelScale_ = 1;
    double frameSeconds_ = 0, surfaceSeconds_ = 0;
    std::uint64_t frames_ = 0;
    bool dirty_ = true;
};

}  // namespace emca::explorer
