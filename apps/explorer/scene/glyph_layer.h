#pragma once

#include <optional>

#include "base/theme.h"
#include "emca/core/camera.h"
#include "mesh_geometry.h"
#include "stroke_layer.h"
#include "view_pose.h"

namespace emca::explorer {

/// Lines of a camera's symbol: the pyramid of its image with a small triangle that says where up is; a sphere of three
/// circles for spherical cameras; a box for orthographic ones, whose extent is unknown. `size`: depth of the pyramid.
std::vector<Edge> cameraGlyph(const Camera& camera, double imageAspect, float size);

/// The renderer's camera as a symbol, hidden while the view looks through it.
class GlyphLayer {
  public:
    explicit GlyphLayer(vtkRenderer& strokes);
    void setCamera(const std::optional<Camera>& camera, double imageAspect, float size);
    void apply(bool visible, const ThemeColors& colors);
    void prepareFrame(const ViewPose& pose, float pixelScale);

  private:
    void rebuild();
    StrokeLayer lines_;
    std::optional<Camera> camera_;
    double imageAspect_ = 1;
    float size_ = 1;
    bool visible_ = true;
    QColor color_, halo_;
};

}  // namespace emca::explorer
