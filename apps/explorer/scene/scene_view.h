#pragma once

#include <QImage>
#include <QWidget>

#include <cstdint>
#include <memory>
#include <optional>

#include "base/theme.h"
#include "emca/client/dataset.h"
#include "emca/client/selection.h"
#include "emca/core/result.h"
#include "ray_switches.h"
#include "scene_objects.h"
#include "scene_options.h"
#include "surface_model.h"
#include "view_pose.h"

namespace emca::explorer {

/// Sets the surface format that the 3D view needs. Call it before the QApplication is made.
void prepareOpenGl();
/// Whether an OpenGL 3.2 context can be made here; asked once, then remembered. Needs a QGuiApplication.
bool hasOpenGl();

/// The scene in 3D with the recorded paths of the current pixels: reads Dataset and Selection, writes the Selection.
/// Left drag orbits, middle or shift-left drag pans, right drag and wheel zoom, arrow keys and W A S D fly. Click selects
/// a vertex or a path, ctrl-click and shift-click add to the selection, `R` drags a rectangle, `F` focuses on the selection,
/// Home is the renderer's camera, Backspace the view before, `O` the other projection, `X` the clipping plane, `P` a
/// picture. Without OpenGL it is a placeholder that says so.
/// GUI thread.
class SceneView : public QWidget {
    Q_OBJECT
  public:
    SceneView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    ~SceneView() override;

    const SceneOptions& options() const;
    void setOptions(const SceneOptions& options);

    /// 3D data on surfaces: which layer colours the scene, and how.
    SurfaceModel& surfaces();
    /// What plugins add. A switch for each is in the options.
    SceneObjects& objects();
    /// Switches of single paths and vertices.
    const RaySwitches& raySwitches() const;
    void setRaySwitches(const RaySwitches& switches);
    /// The colours of paths by value: range, error.
    const PathColoring& pathColors() const;
    /// The current path and vertex as far as they are shown, and what is drawn of them.
    std::optional<client::PathId> currentPathId() const;
    std::optional<client::VertexId> currentVertexId() const;
    std::optional<PathRays> currentPathRays() const;
    std::optional<VertexRays> currentVertexRays() const;
    const PathSet& paths() const;       ///< that are shown; shares its columns with the Dataset
    /// What the shown layer says under the cursor.
    std::optional<SurfaceValue> hoveredSurface() const;

    /// Where the view looks from; at the end of a flight, if one is under way.
    ViewPose pose() const;
    void setPose(const ViewPose& pose);

    /// Pixel of the view at which a vertex is drawn; nothing if it is not loaded, has no place or is behind the eye.
    std::optional<QPointF> screenPosition(const client::VertexId& vertex) const;
    /// The picture with labels, legend and colour bar at any size. Empty without OpenGL.
    QImage renderImage(QSize size);
    /// Writes a PNG. Errors: notSupported (no OpenGL), invalidArgument (size), fileUnwritable.
    Result<void> saveImage(const QString& file, QSize size);

    bool isLoading() const;             ///< meshes or their layers are being prepared
    double lastFrameSeconds() const;    ///< time that the last frame took to draw; 0 without OpenGL
    std::uint64_t frameCount() const;   ///< frames drawn so far; 0 without OpenGL
    std::uint64_t surfaceFrameCount() const;   ///< of those, frames that drew the surfaces anew
    std::size_t shownTriangles() const; ///< of surfaces, in the next frame: all, or those of a stand-in
    void requestFrame();                ///< draws another one although nothing changed
    bool isMoving() const;              ///< a flight or a key that is held

  public slots:
    void resetCamera();                 ///< to the renderer's camera
    void focusSelection();              ///< the current vertex, else the selected paths, else the whole scene
    void back();
    void setRectangleMode(bool on);
    /// Progress of the scene's way from the renderer, in [0, 1]; negative: unknown. Ends when the Dataset gets meshes.
    void showLoading(double fraction);
    /// Nothing is on its way any more, whether it came or not.
    void endLoading();
    /// One sentence why the scene did not come, with a button that asks for it again (reloadRequested).
    void showLoadError(const QString& sentence);

  signals:
    void optionsChanged();              ///< or objects, or switches of rays
    void pathsChanged();                ///< other ones are shown
    void selectionShown();              ///< another path or vertex is current
    void rectangleModeChanged(bool on);
    void poseChanged();
    /// Somebody asked for a picture, by key or menu (the dialog is the options panel's).
    void pictureRequested();
    /// The button of the empty state: somebody wants to connect.
    void connectRequested();
    void reloadRequested();

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace emca::explorer
