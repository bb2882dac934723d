#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/theme.h"
#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "mesh_geometry.h"
#include "stroke_layer.h"
#include "view_pose.h"

namespace emca::explorer {

/// Lines of a camera's symbol: the pyramid of its image with a small triangle that says where up is; a sphere of three
/// circles for spherical cameras; a box for orthographic ones, whose extent is unknown. `size`: depth of the pyramid.
std::vector<Edge> cameraGlyph(const Camera& camera, double imageAspect, float size);

/// Where a light sends its light: arrows along the side that shines, or to all sides from a closed or bent one. Empty for
/// meshes that do not shine or have no area. `size`: the longest an arrow gets; small lights have shorter ones.
std::vector<Edge> lightGlyph(const Mesh& light, float size);

inline constexpr std::size_t kMaximumLightGlyphs = 64;   ///< the largest lights have one

/// The renderer's camera and the lights as symbols; the camera's is hidden while the view looks through it.
class GlyphLayer {
  public:
    explicit GlyphLayer(vtkRenderer& strokes);
    void setCamera(const std::optional<Camera>& camera, double imageAspect, float size);
    void setLights(std::span<const Mesh> meshes, float size);
    void apply(bool camera, bool lights, const ThemeColors& colors);
    void prepareFrame(const ViewPose& pose, float pixelScale);

  private:
    void rebuild();
    StrokeLayer lines_, lights_;
    std::vector<Edge> lightEdges_;
    std::optional<Camera> camera_;
    double imageAspect_ = 1;
    float size_ = 1;
    bool visible_ = true, lightsVisible_ = true;
    QColor color_, halo_, lightColor_;
};

}  // namespace emca::explorer
