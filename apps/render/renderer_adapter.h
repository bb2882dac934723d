#pragma once

#include <memory>

#include "emca/render/image_renderer.h"
#include "emca/server/renderer.h"

namespace emca {

/// Offers the reference renderer to EMCA's server. May be called from several threads at once.
class RendererAdapter final : public Renderer {
  public:
    /// \param options     what requests get that do not say otherwise
    /// \param integrator  name of the integrator behind `options`, "path" or "direct"
    RendererAdapter(std::shared_ptr<const render::Scene> scene, const render::RenderOptions& options,
                    std::string integrator, int threads);

    RendererInfo info() const override;
    Camera camera() const override;
    std::vector<Mesh> meshes() const override;
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    std::vector<LayerDescription> surfaceLayers() const override;
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                              RequestMonitor& monitor) override;

  private:
    Result<render::RenderOptions> optionsFor(const RenderSettings& settings) const;

    render::ImageRenderer renderer_;
    render::RenderOptions options_;
    std::string integrator_;
};

/// Changes options to the named integrator and sampler; empty names change nothing.
/// \param sceneSettings  what "path" means: the scene's own settings
/// Errors: invalidArgument (an unknown name).
Result<void> applyNames(const std::string& integrator, const std::string& sampler,
                        const render::IntegratorSettings& sceneSettings, render::RenderOptions& options);

}  // namespace emca
