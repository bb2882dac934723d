#pragma once

#include <cstdint>
#include <memory>

#include "emca/adapter/pixel_renderer.h"
#include "emca/server/server_tool.h"
#include "loaded_scene.h"

namespace emca::nori_adapter {

/// What requests get that do not say otherwise.
struct NoriOptions {
    std::uint32_t samplesPerPixel = 0;  ///< 0: the scene's
    std::uint64_t seed = 0;
    unsigned threads = 0;               ///< 0: one per processor
};

/// Offers a scene of Nori, with the integrator that it names, to EMCA's server. May be called from several threads at once,
/// as Nori itself calls integrators.
class NoriRenderer final : public adapter::PixelRenderer {
  public:
    NoriRenderer(std::shared_ptr<const LoadedScene> scene, NoriOptions options) : scene_(std::move(scene)), options_(options) {}

    RendererInfo info() const override;
    Camera camera() const override { return scene_->camera(); }
    std::vector<Mesh> meshes() const override { return scene_->meshes(); }
    std::vector<LayerDescription> surfaceLayers() const override { return nori_adapter::surfaceLayers(); }

    /// Light probes with the scene's integrator.
    std::shared_ptr<ServerTool> lightProbes() const;

  private:
    Result<adapter::PixelLoop> loopFor(const RenderSettings& settings) const override;
    std::uint32_t samplesPerPixel() const;

    std::shared_ptr<const LoadedScene> scene_;
    NoriOptions options_;
};

}  // namespace emca::nori_adapter
