#include "light_probe_tool.h"

#include "emca/probe/light_probe.h"
#include "emca/render/light_probe.h"
#include "renderer_adapter.h"

namespace emca {

std::string LightProbeTool::name() const { return probe::kLightProbeTool; }

Result<std::vector<std::byte>> LightProbeTool::answer(std::span<const std::byte> request, RequestMonitor& monitor) {
    const auto asked = probe::decodeRequest(request);
    if (!asked) return asked.error();
    render::RenderOptions options = options_;
    if (auto named = applyNames(asked->integrator, "", scene_->integrator(), options); !named) return named.error();
    render::RenderCallbacks callbacks;
    callbacks.cancelled = [&monitor] { return monitor.cancelled(); };
    callbacks.progress = [&monitor](double fraction) { monitor.progress(fraction); };
    const auto probe = render::renderLightProbe(*scene_, *asked, options.integrator, options.sampler, threads_, callbacks);
    if (!probe) return probe.error();
    return probe::encode(*probe);
}

}  // namespace emca
