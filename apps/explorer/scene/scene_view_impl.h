#pragma once

#include <QTimer>

#include <memory>
#include <optional>

#include "base/color_bar.h"
#include "base/listeners.h"
#include "camera_driver.h"
#include "glyph_layer.h"
#include "heat_layer.h"
#include "mesh_layer.h"
#include "mesh_loader.h"
#include "object_layer.h"
#include "object_picker.h"
#include "path_layer.h"
#include "scene_canvas.h"
#include "scene_input.h"
#include "scene_overlay.h"
#include "scene_picker.h"
#include "scene_view.h"
#include "surface_model.h"

class QMenu;

namespace emca::explorer {

class StateOverlay;

/// What a SceneView is made of. scene_view_models.cpp: what it makes of Dataset, Selection and options;
/// scene_view_camera.cpp: from where it looks; scene_view_pointer.cpp: what the mouse means, scene_view_menu.cpp: its menu;
/// scene_view_overlay.cpp: what is written over the picture; scene_view_surface.cpp: 3D data on surfaces, and the bars;
/// scene_view_picture.cpp: pictures of any size.
class SceneView::Impl {
  public:
    Impl(SceneView& owner, client::Dataset& data, client::Selection& sel, Theme& look);

    void connectInput();
    void listenTo() {
        datasetListening.emplace(dataset, [this](std::uint32_t parts) { datasetChanged(parts); });
        selectionListening.emplace(selection, [this](std::uint32_t parts) { selectionChanged(parts, true); });
    }

    // Models.
    void datasetChanged(std::uint32_t parts);
    void selectionChanged(std::uint32_t parts, bool fly);
    void loadMeshes();
    void meshesReady(const std::shared_ptr<PreparedMeshes>& prepared);
    void rebuildPaths();
    ShownSelection resolve() const;
    BoundingBox box() const;          ///< where the scene happens, without far lights
    void updateGlyph();
    double imageAspect() const;

    // Camera.
    Viewport viewport() const;
    Projection projection() const;
    Vec3d pivot() const;
    ViewPose homePose() const;
    Vec3d upAxis() const;
    void goHome(bool immediate);
    bool moved() const { return !(driver.target() == home); }
    void poseMoved(const ViewPose& pose);
    void updateExtent();
    std::vector<Vec3f> contextOf(Index path, std::optional<Index> vertex) const;
    void showPath(Index path, std::optional<Index> vertex, bool always);
    void closeUp(Index vertex);
    void setCoarse(bool coarse);
    MeshDetail settledDetail() const;
    void surfacesDrawn(double seconds);
    void showDetail();
    ClipPlane clip() const;
    void prepareFrame();
    void applyOptions();
    void recolorPaths();
    void raysChanged();
    void objectsChanged();

    // Pointer.
    PickContext pickContext() const;
    void click(QPointF at, Qt::KeyboardModifiers modifiers);
    void focusAt(QPointF at);
    void hover(std::optional<QPointF> at);
    void selectInside(QRectF rectangle, Qt::KeyboardModifiers modifiers);
    std::optional<ObjectHit> objectAt(QPointF at);
    void menu(QPointF at, QPoint global);
    void addRayActions(QMenu& menu, const Picked& hit);
    PathRays raysOf(Index path) const;
    VertexRays raysAt(Index vertex) const;

    // 3D data on surfaces.
    void connectSurfaces();
    void showSurface();               ///< another field
    void showSurfaceStyle();
    void arrange();                   ///< picture and colour bar
    int barWidth() const;             ///< of all bars
    std::vector<std::pair<ColorBar*, ColorBarContent>> bars() const;   ///< those that are shown, from the left
    void updateAntiAliasing();
    std::optional<SurfaceHit> pickSurface(Ray ray) const;
    void probeSoon();
    void probe();
    OverlayContent::Card surfaceCard(const SurfaceValue& value, QPointF at) const;

    // Overlay.
    void updateState();
    void updateOverlay();
    OverlayContent overlayContent(Viewport size) const;

    SceneView& view;
    client::Dataset& dataset;
    client::Selection& selection;
    Theme& theme;
    SceneOptions options;
    SceneObjects objects;

    CameraDriver driver;
    MeshLoader loader;
    QTimer settle;
    StateOverlay* states;
    SceneOverlay* overlay;
    SceneCanvas* canvas = nullptr;        ///< null without OpenGL, as the layers are
    SceneInput* input = nullptr;
    std::unique_ptr<MeshLayer> meshes;
    std::unique_ptr<GlyphLayer> glyphs;
    std::unique_ptr<PathLayer> pathLayer;
    std::unique_ptr<HeatLayer> heat;
    std::unique_ptr<ObjectLayer> objectLayer;
    ObjectPicker objectPicker;
    SurfaceModel surfaces;
    PathColoring coloring;
    RaySwitches raySwitches;
    ColorBar *bar, *pathBar;              ///< beside the picture, hidden where there is nothing to explain

    PathSet paths;                        ///< shares its columns with the Dataset
    PathGeometry geometry;
    BoundingBox pathBox;
    ShownSelection shown;
    std::optional<Index> hovered;
    std::optional<ObjectHit> hoveredObject;
    std::optional<QPointF> cursor;
    QTimer probing;                       ///< one look-up of the surface under the cursor per turn
    std::optional<SurfaceValue> probed;   ///< under the cursor, unless a vertex is
    Vec3d extentCentre;
    double extentRadius = 1;
    ViewPose home;                        ///< the renderer's camera; the view is there until somebody moves it
    BoundingBox lastBox;                  ///< of the scene before: one that comes again keeps the view
    double focusDistance = 0;             ///< to what the renderer's camera looks at; 0 if nothing
    std::optional<double> loadingFraction;
    QString loadError;
    ClipAxis lastClipAxis = ClipAxis::view;   ///< what the key brings back
    bool isCoarse = false;
    double mediumSeconds = 0;             ///< of the quickest frame with the medium stand-in; 0: not known

    // Last, so that no call arrives while the rest is being destroyed.
    std::optional<DatasetListening> datasetListening;
    std::optional<SelectionListening> selectionListening;
};

}  // namespace emca::explorer
