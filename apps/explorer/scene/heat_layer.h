#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <span>

#include "base/theme.h"
#include "scene_options.h"
#include "surface_data.h"

class vtkRenderer;

namespace emca::explorer {

/// The scene's surfaces in the colours of a layer: one flat colour per face, without any light, so that a colour is the
/// colour of the bar. Meshes without data are matte grey. Colours lie in a buffer of their own beside the geometry;
/// replacing them rebuilds nothing else. Opaque surfaces write depth; their back faces, where they are to fade, are
/// drawn after them by a second actor.
class HeatLayer {
  public:
    explicit HeatLayer(vtkRenderer& surfaces);
    ~HeatLayer();

    /// Null: none. Colours have to follow.
    void setSurface(std::shared_ptr<const PreparedSurface> surface);
    /// One per data face; empty: nothing is drawn.
    void setColors(std::span<const analysis::Color8> colors);
    /// \param opacity  in [0, 1]
    void apply(const SceneOptions& options, float opacity, const ThemeColors& colors);
    void setCoarse(bool coarse);
    void setClip(const ClipPlane& clip);
    bool hasStandIn() const { return surface_ && !surface_->coarseTriangles.empty(); }
    bool isShown() const { return shown_; }

  private:
    class FaceMapper;
    struct FaceColors;
    void show();

    vtkRenderer& renderer_;
    std::shared_ptr<const PreparedSurface> surface_;
    vtkSmartPointer<vtkPolyData> full_, standIn_;
    std::shared_ptr<FaceColors> fullColors_, coarseColors_;
    vtkSmartPointer<FaceMapper> mapper_, backMapper_;
    vtkNew<vtkPlane> plane_;
    vtkNew<vtkActor> actor_, backActor_;   ///< the second one only for faded back faces of opaque surfaces
    bool shown_ = false, coarse_ = false, separateBack_ = false, clipped_ = false;
    float opacity_ = 1;
};

}  // namespace emca::explorer
