#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/theme.h"
#include "emca/core/path_set.h"
#include "clip_plane.h"
#include "path_coloring.h"
#include "path_geometry.h"
#include "ray_switches.h"
#include "scene_options.h"
#include "stroke_layer.h"

class vtkRenderer;

namespace emca::explorer {

/// A Selection as positions in the PathSet that is shown. What is selected but not loaded is not in it.
struct ShownSelection {
    std::vector<Index> paths;            ///< ascending
    std::optional<Index> path;           ///< the current one, among `paths`
    std::optional<Index> vertex;         ///< on the current path
    friend bool operator==(const ShownSelection&, const ShownSelection&) = default;
};

/// Which roles of colour are in the picture, for the legend.
struct ShownRoles {
    bool path = false, current = false, emitter = false, visible = false, occluded = false, selected = false;
};

/// The recorded paths. All of them are one buffer that is made when they arrive; what is selected is a second, small
/// one on top, so that a click costs what the selected paths have, not what the pixel has.
class PathLayer {
  public:
    /// \param context  draws what a selection at most dims  \param strokes  draws what is selected  \param coloring  outlives
    /// the layer
    PathLayer(vtkRenderer& context, vtkRenderer& strokes, const PathColoring& coloring);

    /// \param paths, geometry  must stay as they are until the next call
    void setPaths(const PathSet* paths, const PathGeometry* geometry);
    void apply(const SceneOptions& options, const ThemeColors& colors);
    /// True if what is not selected looks other than before.
    bool setSelection(ShownSelection selection);
    void setRays(ShownRays rays);
    /// The coloring has others than before.
    void recolor();
    /// Only some of the paths that are not selected, as long as the camera moves and frames are slow.
    void setCoarse(bool coarse);
    void prepareFrame(float pixelScale, float fadeNear, float fadeFar, const ClipPlane& clip);

    /// Paths drawn whether selected or not.
    std::span<const Index> drawnPaths() const { return drawn_; }
    bool isDrawn(Index path) const;
    ShownRoles roles() const;

  private:
    void rebuildContext();
    void rebuildSelected();
    void updateDimming();
    void appendPath(Index path, bool current, std::vector<Stroke>& lines, std::vector<Stroke>& marks);
    void appendNextEvents(Index path, std::optional<Index> onlyVertex, float width, std::vector<Stroke>& lines);
    void appendChosenNextEvents(Index path, std::vector<Stroke>& lines);
    bool isLineShown(const analysis::Segment& segment, Index path) const;
    std::vector<Index> brightPaths() const;
    QColor colorOf(const analysis::Segment& segment) const;

    const PathColoring& coloring_;
    const PathSet* paths_ = nullptr;
    const PathGeometry* geometry_ = nullptr;
    SceneOptions options_;
    ThemeColors colors_;
    ShownSelection selection_;
    ShownRays rays_;
    std::vector<Index> drawn_;
    StrokeLayer context_, coarseContext_, contextNextEvents_, selectedNextEvents_, selected_, current_, marks_;
    ShownRoles contextRoles_, selectedRoles_;
    bool begun_ = false, coarse_ = false, dimmed_ = false;
};

}  // namespace emca::explorer
