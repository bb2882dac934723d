#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "emca/adapter/light_probe_tool.h"
#include "emca/adapter/pixel_renderer.h"
#include "integrators.h"
#include "loaded_scene.h"

namespace emca::lajolla {

/// What requests get that do not say otherwise.
struct LajollaOptions {
    std::uint32_t samplesPerPixel = 0;  ///< 0: the scene's
    std::string integrator;             ///< empty: the scene's
    std::uint64_t seed = 0;
    unsigned threads = 0;               ///< 0: one per processor
};

/// Offers a scene of lajolla to EMCA's server. May be called from several threads at once, as long as the person's
/// integrator keeps nothing between paths.
class LajollaRenderer final : public adapter::PixelRenderer {
  public:
    LajollaRenderer(std::shared_ptr<const LoadedScene> scene, LajollaOptions options);

    RendererInfo info() const override;
    Camera camera() const override { return scene_->camera(); }
    std::vector<Mesh> meshes() const override { return scene_->meshes(); }
    std::vector<LayerDescription> surfaceLayers() const override { return lajolla::surfaceLayers(); }

    /// Light probes of the same scene, with the same integrators.
    std::shared_ptr<ServerTool> lightProbes() const;

  private:
    Result<adapter::PixelLoop> loopFor(const RenderSettings& settings) const override;
    std::uint32_t samplesPerPixel() const;

    std::shared_ptr<const LoadedScene> scene_;
    LajollaOptions options_;
};

}  // namespace emca::lajolla
