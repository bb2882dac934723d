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
#include "path_layer.h"
#include "scene_canvas.h"
#include "scene_input.h"
#include "scene_overlay.h"
#include "scene_picker.h"
#include "scene_view.h"
#include "surface_model.h"

namespace emca::explorer {

class ColorBar;
class StateOverlay;

/// What a SceneView is made of. scene_view.cpp: models, camera, options; scene_view_pointer.cpp: what the mouse means;
/// scene_view_overlay.cpp: what is written over the picture; scene_view_surface.cpp: 3D data on surfaces.
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
    void prepareFrame();
    void applyOptions();

    // Pointer.
    PickContext pickContext() const;
    void click(QPointF at, Qt::KeyboardModifiers modifiers);
    void focusAt(QPointF at);
    void hover(std::optional<QPointF> at);
    void selectInside(QRectF rectangle, Qt::KeyboardModifiers modifiers);
    void menu(QPointF at, QPoint global);

    // 3D data on surfaces.
    void connectSurfaces();
    void showSurface();               ///< another field
    void showSurfaceStyle();
    void arrange();                   ///< picture and colour bar
    int barWidth() const;
    ColorBarContent barContent() const;
    void updateAntiAliasing();
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
    SurfaceModel surfaces;
    ColorBar* bar;                        ///< beside the picture, hidden without a layer

    PathSet paths;                        ///< shares its columns with the Dataset
    PathGeometry geometry;
    BoundingBox pathBox;
    ShownSelection shown;
    std::optional<Index> hovered;
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
    bool isCoarse = false;

    // Last, so that no call arrives while the rest is being destroyed.
    std::optional<DatasetListening> datasetListening;
    std::optional<SelectionListening> selectionListening;
};

}  // namespace emca::explorer
