#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "emca/core/color.h"
#include "emca/core/pixel.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"
#include "emca/probe/light_probe.h"
#include "emca/server/server_tool.h"

namespace emca::adapter {

/// One thread's way of finding the radiance that arrives at a point. Made, used and destroyed in one thread.
class ProbeWorker {
  public:
    virtual ~ProbeWorker() = default;
    /// Radiance along a ray, linear Rec. 709, W/(sr m^2). Depends on the arguments and on the request's seed alone.
    /// Emitters are to be seen even where the integrator hides them from the camera.
    /// \param origin     world space, already off the surface on the ray's side
    /// \param direction  unit, world space
    virtual Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) = 0;
};

/// The server tool that the explorer's light probe asks (docs/explorer/light-probe.md): takes the directions, keeps the
/// sums and makes the image, which is the same whatever its threads do.
class LightProbeTool final : public ServerTool {
  public:
    /// Called in each thread that renders, with a valid request. Errors travel to the client: invalidArgument for an
    /// integrator that it does not have.
    using MakeWorker = std::function<Result<std::unique_ptr<ProbeWorker>>(const probe::LightProbeRequest& request)>;

    /// \param surfaceOffset  scene units: how far off its surface a ray starts; 1e-4 of the scene's radius is common
    /// \param threads        that render a probe; 0: one per processor
    LightProbeTool(MakeWorker makeWorker, float surfaceOffset, unsigned threads = 0);

    std::string name() const override { return probe::kLightProbeTool; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) override;
    bool observesReplay() const override { return false; }

  private:
    MakeWorker makeWorker_;
    float surfaceOffset_;
    unsigned threads_;
};

}  // namespace emca::adapter
