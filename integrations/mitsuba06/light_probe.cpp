#include "light_probe.h"

#include <algorithm>
#include <utility>

#include <mitsuba/render/sampler.h>

#include "emca/adapter/light_probe_tool.h"

namespace emca::mitsuba06 {

namespace {

class Worker final : public adapter::ProbeWorker {
  public:
    Worker(const mts::Scene& scene, mts::ref<mts::SamplingIntegrator> integrator, mts::ref<mts::Sampler> sampler)
        : integrator_(integrator),
          sampler_(sampler),
          query_(&scene, sampler_.get()),
          time_(scene.getSensor()->getShutterOpen()) {}

    Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) override {
        if (sample == 0) sampler_->generate(mts::Point2i(static_cast<int>(pixel.x), static_cast<int>(pixel.y)));
        sampler_->setSampleIndex(sample);
        query_.newQuery(mts::RadianceQueryRecord::ERadiance, nullptr);
        const mts::RayDifferential ray(mts::Point(origin.x, origin.y, origin.z),
                                       mts::Vector(direction.x, direction.y, direction.z), time_);
        return toColor(integrator_->Li(ray, query_));
    }

  private:
    mts::ref<mts::SamplingIntegrator> integrator_;
    mts::ref<mts::Sampler> sampler_;
    mts::RadianceQueryRecord query_;
    mts::Float time_;
};

}  // namespace

std::shared_ptr<ServerTool> makeLightProbeTool(const MitsubaRenderer& renderer) {
    const auto makeWorker =
        [&renderer](const probe::LightProbeRequest& request) -> Result<std::unique_ptr<adapter::ProbeWorker>> {
        renderer.threads().registerThisThread();
        if (!request.integrator.empty() && request.integrator != renderer.integrator().label()) {
            return Error{ErrorCode::invalidArgument, "Asked for a light probe by the integrator \"" +
                                                         request.integrator + "\": there is " +
                                                         renderer.integrator().label() + "."};
        }
        auto integrator = renderer.integratorFor(request.maximumDepth);
        if (!integrator) return integrator.error();
        RenderSettings settings;
        settings.sampler = "emcasampler";
        settings.samplesPerPixel = request.samplesPerPixel;
        settings.seed = request.seed;
        settings.hasSeed = true;
        auto sampler = renderer.samplerFor(settings);
        if (!sampler) return sampler.error();
        return std::unique_ptr<adapter::ProbeWorker>(std::make_unique<Worker>(renderer.scene(), *integrator, *sampler));
    };
    const float offset =
        std::max(static_cast<float>(Epsilon), 1e-4f * static_cast<float>(renderer.scene().getBSphere().radius));
    return std::make_shared<adapter::LightProbeTool>(makeWorker, offset);
}

}  // namespace emca::mitsuba06
