#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <memory>

#include "base/theme.h"
#include "mesh_geometry.h"
#include "scene_options.h"
#include "stroke_layer.h"

class vtkRenderer;

namespace emca::explorer {

/// Buffers of a scene as VTK wants them, with a coarse stand-in of large ones. Made by any thread.
struct PreparedMeshes {
    MeshGeometry geometry;
    vtkSmartPointer<vtkPolyData> surfaces, standIn, emitters;   ///< null if there are none
};
/// \param base  colour of clay
std::shared_ptr<PreparedMeshes> prepareMeshes(std::span<const Mesh> meshes, const QColor& base, bool ownColors,
                                              const std::atomic<bool>* cancel);

/// The scene's surfaces in two actors (what reflects and what shines) and its creases as thin lines.
class MeshLayer {
  public:
    MeshLayer(vtkRenderer& surfaces, vtkRenderer& strokes);
    ~MeshLayer();

    void setMeshes(std::shared_ptr<PreparedMeshes> meshes);   ///< null: none
    void apply(const SceneOptions& options, const ThemeColors& colors);
    /// The stand-in takes the place of a scene that is slow to draw, as long as the camera moves.
    void setCoarse(bool coarse);
    /// Something else draws the surfaces; creases stay.
    void setCovered(bool covered);
    bool hasStandIn() const { return meshes_ && meshes_->standIn; }
    std::uint64_t skippedTriangles() const { return meshes_ ? meshes_->geometry.skippedTriangles : 0; }
    BoundingBox box() const { return meshes_ ? meshes_->geometry.box : BoundingBox(); }
    BoundingBox core() const { return meshes_ ? meshes_->geometry.core : BoundingBox(); }
    /// Widths and fading for the coming frame.
    void prepareFrame(float pixelScale, float fadeNear, float fadeFar);

  private:
    class ClayMapper;
    void rebuildEdges(const ThemeColors& colors);

    vtkRenderer& renderer_;
    std::shared_ptr<PreparedMeshes> meshes_;
    vtkSmartPointer<ClayMapper> clay_, glow_;
    vtkNew<vtkActor> clayActor_, glowActor_;
    StrokeLayer edges_, emitterEdges_;
    void updateVisibility();
    bool coarse_ = false, covered_ = false;
    double opacity_ = 1;
    QColor edgeColor_, emitterColor_;
};

}  // namespace emca::explorer
