#pragma once

#include <memory>
#include <string>

#include "emca/render/image_renderer.h"
#include "emca/server/server_tool.h"

namespace emca {

/// Renders light probes of the reference renderer's scene for the explorer (docs/explorer/light-probe.md). May be called
/// from several threads at once.
class LightProbeTool final : public ServerTool {
  public:
    /// \param options  integrator and sampler of requests that do not say otherwise
    LightProbeTool(std::shared_ptr<const render::Scene> scene, const render::RenderOptions& options, int threads)
        : scene_(std::move(scene)), options_(options), threads_(threads) {}

    std::string name() const override;
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) override;
    bool observesReplay() const override { return false; }

  private:
    std::shared_ptr<const render::Scene> scene_;
    render::RenderOptions options_;
    int threads_;
};

}  // namespace emca
