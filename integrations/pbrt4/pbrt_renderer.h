#pragma once

#include <memory>

#include "emca/recorder/path_layers.h"
#include "emca/server/renderer.h"
#include "emca/server/server_tool.h"
#include "loaded_scene.h"
#include "pixel_worker.h"

namespace emca::pbrt4 {

/// What the command line says instead of the scene.
struct RenderChoice {
    std::string sceneName;  ///< for people
    std::optional<int> samplesPerPixel;
    unsigned threads = 0;  ///< that render an image; 0: one per processor
};

/// pbrt as EMCA sees it. Requests of all kinds may come at once: each renders to films and samplers of its own, and the
/// scene is not written to.
class PbrtRenderer final : public Renderer {
  public:
    /// Errors: invalidArgument (samples that the scene's sampler cannot have).
    static Result<std::unique_ptr<PbrtRenderer>> make(std::unique_ptr<LoadedScene> scene, const RenderChoice& choice);

    RendererInfo info() const override;
    Camera camera() const override { return scene_->viewerCamera(); }
    std::vector<Mesh> meshes() const override { return scene_->surfaces().meshes(); }
    std::vector<LayerDescription> surfaceLayers() const override;
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                              RequestMonitor& monitor) override;

    /// The server tool "light probe". The renderer must outlive it.
    std::shared_ptr<ServerTool> lightProbe() const;

  private:
    PbrtRenderer(std::unique_ptr<LoadedScene> scene, const RenderChoice& choice)
        : scene_(std::move(scene)), choice_(choice) {}
    Result<PixelRequest> requestFor(const RenderSettings& settings) const;
    /// \param bounds  of the pixels to render
    adapter::PixelLoop loopFor(const PixelRequest& request, pbrt::Bounds2i bounds) const;
    Result<RenderedImage> render(const RenderSettings& settings, RequestMonitor& monitor,
                                 SurfaceRecorder* surface) const;

    std::unique_ptr<LoadedScene> scene_;
    RenderChoice choice_;
};

}  // namespace emca::pbrt4
