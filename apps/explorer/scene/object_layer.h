#pragma once

#include <vtkSmartPointer.h>

#include <map>
#include <memory>
#include <span>

#include "base/theme.h"
#include "clip_plane.h"
#include "scene_objects.h"

class vtkRenderer;

namespace emca::explorer {

/// Draws the objects that plugins add: lines and points as strokes, sides as flat triangles among the surfaces.
class ObjectLayer {
  public:
    ObjectLayer(vtkRenderer& surfaces, vtkRenderer& strokes);
    ~ObjectLayer();

    /// Rebuilds those that are others than before.
    void show(std::span<const SceneObjects::Entry> entries);
    void apply(const ThemeColors& colors);
    void prepareFrame(float pixelScale, const ClipPlane& clip);
    /// How many points and lines are left out because there are too many.
    std::size_t leftOut() const;

  private:
    struct Drawn;
    vtkRenderer &surfaces_, &strokes_;
    std::map<ObjectId, std::unique_ptr<Drawn>> drawn_;
    QColor halo_;
};

}  // namespace emca::explorer
