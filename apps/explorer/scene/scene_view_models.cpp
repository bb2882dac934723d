#include <vtkRenderer.h>

#include <algorithm>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "scene_view_impl.h"

// What the 3D view makes of Dataset, Selection and options.
namespace emca::explorer {

void SceneView::Impl::datasetChanged(std::uint32_t parts) {
    using Part = client::DatasetPart;
    if (parts & Part::meshes) {
        loadError.clear();
        loadingFraction.reset();
    }
    if (parts & (Part::meshes | Part::camera | Part::info)) {
        if (parts & Part::meshes) loadMeshes();
        if (parts & (Part::meshes | Part::camera)) {
            const auto scene = dataset.meshes();
            focusDistance = scene && dataset.camera()
                                ? double(firstHit(*scene, dataset.camera()->position, dataset.camera()->direction).value_or(0)) : 0;
        }
        updateGlyph();
        if (!moved()) goHome(true);
    }
    if (parts & (Part::currentTrace | Part::meshes | Part::camera)) rebuildPaths();
    updateState();
    updateOverlay();
}

void SceneView::Impl::loadMeshes() { loader.load(dataset.meshes(), theme.colors().mesh, options.ownColors); }

void SceneView::Impl::meshesReady(const std::shared_ptr<PreparedMeshes>& prepared) {
    if (!canvas) return;
    const bool wasHome = !moved();
    setCoarse(false);
    mediumSeconds = 0;
    meshes->setMeshes(prepared);
    const BoundingBox now = meshes->box();
    const bool sameScene = !now.empty && !lastBox.empty && now.min == lastBox.min && now.max == lastBox.max;
    if (!now.empty) lastBox = now;
    updateGlyph();
    rebuildPaths();
    applyOptions();
    if (wasHome || (!now.empty && !sameScene)) goHome(true);
    updateState();
}

void SceneView::Impl::rebuildPaths() {
    paths = dataset.paths();
    const auto scene = dataset.meshes();
    geometry = makePathGeometry(paths, dataset.camera(), scene ? std::span<const Mesh>(*scene) : std::span<const Mesh>(),
                                meshes ? meshes->core() : BoundingBox());
    pathBox = {};
    for (const Vec3f& p : geometry.points)
        if (isFinite(p)) pathBox.extend(p);
    updateExtent();
    coloring.update(paths, options.colors, theme.colors().sceneBottom);
    if (pathLayer) {
        pathLayer->setPaths(&paths, &geometry);
        pathLayer->setRays(ShownRays(raySwitches, paths));
    }
    shown = {};
    hovered.reset();
    selectionChanged(client::SelectionPart::paths, false);
    arrange();
    emit view.pathsChanged();
}

ShownSelection SceneView::Impl::resolve() const {
    ShownSelection s;
    const client::Selection::State& state = selection.state();
    s.paths = findPaths(paths, state.paths);
    if (state.currentPath) s.path = findPath(paths, *state.currentPath);
    if (state.vertex) s.vertex = findVertex(paths, *state.vertex);
    if (!s.path) s.vertex.reset();
    return s;
}

void SceneView::Impl::selectionChanged(std::uint32_t parts, bool fly) {
    using Part = client::SelectionPart;
    if (parts & ~static_cast<std::uint32_t>(Part::hover)) {
        const ShownSelection before = shown;
        shown = resolve();
        const bool dimming = pathLayer && pathLayer->setSelection(shown);
        if (fly && options.flyToSelection && shown.path && (shown.path != before.path || shown.vertex != before.vertex))
            showPath(*shown.path, shown.vertex, false);
        if (canvas && dimming) canvas->requestContext();
        else if (canvas && !(shown == before)) canvas->requestStrokes();
        if (shown.path != before.path || shown.vertex != before.vertex) emit view.selectionShown();
    }
    if (parts & Part::hover) {
        hovered = selection.hovered() ? findVertex(paths, *selection.hovered()) : std::nullopt;
    }
    updateOverlay();
}

void SceneView::Impl::applyOptions() {
    if (canvas) {
        const ThemeColors& colors = theme.colors();
        updateAntiAliasing();
        recolorPaths();
        canvas->surfaces().SetUseDepthPeeling(options.depthPeeling);
        canvas->surfaces().SetMaximumNumberOfPeels(16);
        meshes->apply(options, colors);
        heat->apply(options, surfaces.style().opacity, colors);
        pathLayer->apply(options, colors);
        glyphs->apply(options.cameraGlyph, options.lightGlyphs, colors);
        objectLayer->apply(colors);
        if (!isCoarse) meshes->setDetail(settledDetail());
        canvas->requestRender();
    }
    driver.setAnimated(options.animate);
    if (driver.pose().orthographic != options.orthographic) {
        ViewPose pose = driver.target();
        pose.orthographic = options.orthographic;
        home.orthographic = options.orthographic;
        driver.moveTo(pose);
    }
    updateOverlay();
}

/// Colours by value follow the options and the paths.
void SceneView::Impl::recolorPaths() {
    if (options.colors == coloring.style()) return;
    coloring.update(paths, options.colors, theme.colors().sceneBottom);
    if (pathLayer) pathLayer->recolor();
    arrange();
}

void SceneView::Impl::raysChanged() {
    if (!canvas) return;
    pathLayer->setRays(ShownRays(raySwitches, paths));
    canvas->requestStrokes();
    updateOverlay();
}

void SceneView::Impl::objectsChanged() {
    objectPicker.tidy(objects.entries());
    hoveredObject.reset();
    if (!canvas) return;
    objectLayer->show(objects.entries());
    updateExtent();
    canvas->requestRender();
    updateOverlay();
    emit view.optionsChanged();
}

void SceneView::Impl::updateState() {
    if (!canvas) {
        states->showError("The 3D view needs OpenGL 3.2, which this display does not offer. All other views work without it.");
    } else if (loader.isLoading()) {
        states->showBusy("Preparing the scene…");
    } else if (dataset.meshes() || !paths.empty()) {
        states->clear();
    } else if (!loadError.isEmpty()) {
        states->showError(loadError, "Try again", [this] { emit view.reloadRequested(); });
    } else if (loadingFraction) {
        states->showBusy("Loading the scene…", *loadingFraction);
    } else {
        // Something is here without a scene: a session that has none, or a renderer that was left before it came.
        states->showEmpty("No scene", dataset.info() ? "It is not here. Connect to the renderer to load it."
                                                     : "Connect to a renderer to see its scene and the paths of a pixel.",
                          "Connect…", [this] { emit view.connectRequested(); });
    }
}

}  // namespace emca::explorer
