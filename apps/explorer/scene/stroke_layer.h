#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <span>

#include "clip_plane.h"
#include "stroke.h"
#include "stroke_mapper.h"

class vtkRenderer;

namespace emca::explorer {

/// What the plane cuts away is not drawn; its default cuts nothing.
inline void setClip(StrokeLook& look, const ClipPlane& clip) {
    const Vec3d& n = clip.normal;
    const double plane[4] = {n.x, n.y, n.z, -clip.offset};
    for (int i = 0; i < 4; ++i) look.clip[i] = static_cast<float>(plane[i]);
}

/// Strokes that change together: one actor, one draw call. Replacing them costs their own number, nothing else.
class StrokeLayer {
  public:
    explicit StrokeLayer(vtkRenderer& renderer);
    ~StrokeLayer();
    StrokeLayer(const StrokeLayer&) = delete;
    StrokeLayer& operator=(const StrokeLayer&) = delete;

    /// Strokes with a position that is not finite are left out.
    void setStrokes(std::span<const Stroke> strokes);
    void setVisible(bool visible);
    StrokeLook& look() { return mapper_->look; }
    std::size_t count() const { return count_; }

  private:
    vtkRenderer& renderer_;
    vtkNew<StrokeMapper> mapper_;
    vtkNew<vtkActor> actor_;
    std::size_t count_ = 0;
    bool visible_ = true;
};

}  // namespace emca::explorer
