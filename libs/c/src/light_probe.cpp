#include <cmath>
#include <memory>

#include "emca/adapter/light_probe_tool.h"
#include "recording_handle.h"
#include "served.h"
#include "sized.h"

namespace emca::c {
namespace {

/// One thread's part of a probe.
class FunctionWorker final : public adapter::ProbeWorker {
  public:
    /// \param probe  outlives it, as `request` does
    static Result<std::unique_ptr<adapter::ProbeWorker>> make(const emca_light_probe& probe,
                                                              const probe::LightProbeRequest& request) {
        emca_probe_request asked = filled<emca_probe_request>();
        asked.seed = request.seed;
        asked.samples_per_pixel = request.samplesPerPixel;
        asked.maximum_depth = request.maximumDepth;
        asked.integrator = request.integrator.c_str();
        void* worker = probe.user;
        emca_error error{};
        if (probe.begin)
            if (const emca_code code = probe.begin(probe.user, &asked, &worker, &error); code != EMCA_OK)
                return errorOf(code, error, "begin");
        return std::unique_ptr<adapter::ProbeWorker>(new FunctionWorker(probe, asked, worker));
    }
    ~FunctionWorker() override {
        if (c_.end) c_.end(c_.user, worker_);
    }
    FunctionWorker(const FunctionWorker&) = delete;
    FunctionWorker& operator=(const FunctionWorker&) = delete;

    Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) override {
        return color(c_.radiance(worker_, &request_, {origin.x, origin.y, origin.z},
                                 {direction.x, direction.y, direction.z}, {pixel.x, pixel.y}, sample));
    }

  private:
    FunctionWorker(const emca_light_probe& probe, const emca_probe_request& request, void* worker)
        : c_(probe), request_(request), worker_(worker) {}

    const emca_light_probe& c_;
    const emca_probe_request request_;
    void* const worker_;
};

Result<emca_light_probe> checkedProbe(const emca_light_probe* given) {
    auto probe = sized(given, EMCA_SIZE_UP_TO(emca_light_probe, radiance), "emca_light_probe");
    if (!probe) return probe;
    if (probe->radiance == nullptr)
        return Error{ErrorCode::invalidArgument, "emca_light_probe has no function radiance: it is needed."};
    if (!std::isfinite(probe->surface_offset) || probe->surface_offset < 0)
        return Error{ErrorCode::invalidArgument, "The surface_offset of emca_light_probe is " +
                                                     std::to_string(probe->surface_offset) +
                                                     ", but it is a distance, 0 or more."};
    return probe;
}

}  // namespace
}  // namespace emca::c

using namespace emca;

extern "C" emca_code emca_server_add_light_probe(emca_server* server, const emca_light_probe* given,
                                                 emca_error* error) {
    if (server == nullptr) return c::invalid(error, "emca_server_add_light_probe was given no server.");
    return c::guarded(error, [&]() -> emca_code {
        const auto checked = c::checkedProbe(given);
        if (!checked) return c::fail(error, checked.error());
        const auto probe = std::make_shared<emca_light_probe>(*checked);
        const auto makeWorker = [probe](const probe::LightProbeRequest& request) {
            return c::FunctionWorker::make(*probe, request);
        };
        const auto added = server->server->addTool(
            std::make_shared<adapter::LightProbeTool>(makeWorker, probe->surface_offset, probe->threads));
        return added ? EMCA_OK : c::fail(error, added.error());
    });
}
