#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <span>

#include "stroke.h"
#include "stroke_mapper.h"

class vtkRenderer;

namespace emca::explorer {

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
