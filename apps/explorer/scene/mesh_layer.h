#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <memory>

#include "base/theme.h"
#include "mesh_geometry.h"
#include "scene_options.h"
#include "stroke_layer.h"

class vtkRenderer;

namespace emca::explorer {

/// How much of the surfaces is drawn.
enum class MeshDetail : std::uint8_t {
    coarse,   ///< some 100,000 triangles: while the camera moves and frames are slow
    medium,   ///< about a million: where one frame of all would take seconds
    full,
};

/// Buffers of a scene as VTK wants them, with stand-ins of large ones. Made by any thread.
struct PreparedMeshes {
    MeshGeometry geometry;
    ShadedTriangles coarseTriangles, mediumTriangles;   ///< empty if the scene is small enough
    /// Look at the memory of the triangles above; null if there are none.
    vtkSmartPointer<vtkPolyData> surfaces, medium, coarse, emitters;
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
    /// Where there is no stand-in of that detail, the next finer one is drawn.
    void setDetail(MeshDetail detail);
    MeshDetail detail() const { return detail_; }
    std::size_t triangleCount(MeshDetail detail) const;
    /// Something else draws the surfaces; creases stay.
    void setCovered(bool covered);
    bool hasMedium() const { return meshes_ && meshes_->medium; }
    const MeshGeometry* geometry() const { return meshes_ ? &meshes_->geometry : nullptr; }
    std::uint64_t skippedTriangles() const { return meshes_ ? meshes_->geometry.skippedTriangles : 0; }
    BoundingBox box() const { return meshes_ ? meshes_->geometry.box : BoundingBox(); }
    BoundingBox core() const { return meshes_ ? meshes_->geometry.core : BoundingBox(); }
    /// Widths and fading for the coming frame.
    void prepareFrame(float pixelScale, float fadeNear, float fadeFar, const ClipPlane& clip);

  private:
    class ClayMapper;
    /// One draw call: what it draws stays in the graphics memory while another one is shown in its place.
    struct Part {
        vtkSmartPointer<ClayMapper> mapper;
        vtkNew<vtkActor> actor;
    };
    void rebuildEdges(const ThemeColors& colors);
    void updateVisibility();
    MeshDetail shownDetail() const;
    Part& surfacePart(MeshDetail detail) { return parts_[static_cast<std::size_t>(detail)]; }

    vtkRenderer& renderer_;
    std::shared_ptr<PreparedMeshes> meshes_;
    vtkNew<vtkPlane> plane_;
    std::array<Part, 4> parts_;        ///< by MeshDetail, then lights
    StrokeLayer edges_, emitterEdges_;
    MeshDetail detail_ = MeshDetail::full;
    bool covered_ = false, clipped_ = false;
    double opacity_ = 1;
    QColor edgeColor_, emitterColor_;
};

}  // namespace emca::explorer
