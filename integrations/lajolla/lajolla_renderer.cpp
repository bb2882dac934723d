#include "lajolla_renderer.h"

#include <algorithm>
#include <utility>

namespace emca::lajolla {

namespace {

class Worker final : public adapter::PixelWorker {
  public:
    Worker(const LoadedScene& scene, const Integrator& integrator, std::uint64_t seed, SurfaceRecorder* surface)
        : tracer_(scene, integrator, seed, surface), dropsInvalid_(integrator.volumetric) {}

    Color sample(Pixel pixel, std::uint32_t index) override {
        const Spectrum radiance = tracer_.sample(pixel, index);
        // lajolla's loop leaves out what is not finite where the integrator is volumetric, and only there. The path's own
        // estimate is recorded as it is.
        if (dropsInvalid_ && !isfinite(radiance)) return Color(0.f);
        return toColor(radiance);
    }

  private:
    PathTracer tracer_;
    bool dropsInvalid_;
};

class Prober final : public adapter::ProbeWorker {
  public:
    Prober(const LoadedScene& scene, const Integrator& integrator, std::uint64_t seed, int maximumDepth)
        : tracer_(scene, integrator, seed, nullptr), maximumDepth_(maximumDepth) {}

    Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) override {
        const Ray ray{toVector3(origin), ::normalize(toVector3(direction)), Real(0), infinity<Real>()};
        const Spectrum radiance = tracer_.radiance(ray, pixel, sample, maximumDepth_);
        return isfinite(radiance) ? toColor(radiance) : Color(0.f);
    }

  private:
    PathTracer tracer_;
    int maximumDepth_;
};

}  // namespace

LajollaRenderer::LajollaRenderer(std::shared_ptr<const LoadedScene> scene, LajollaOptions options)
    : scene_(std::move(scene)), options_(std::move(options)) {}

std::uint32_t LajollaRenderer::samplesPerPixel() const {
    return options_.samplesPerPixel > 0 ? options_.samplesPerPixel
                                        : static_cast<std::uint32_t>(std::max(1, scene_->scene().options.samples_per_pixel));
}

RendererInfo LajollaRenderer::info() const {
    RendererInfo info;
    info.renderer = "lajolla";
    info.scene = scene_->name();
    info.width = scene_->width();
    info.height = scene_->height();
    info.samplesPerPixel = samplesPerPixel();
    const auto integrator = findIntegrator(options_.integrator, scene_->scene());
    info.integrator = integrator ? integrator->name : "emcapath";
    info.sampler = "pcg32 per pixel and sample";
    info.seed = options_.seed;
    info.concurrent = true;
    info.threads = options_.threads;
    return info;
}

Result<adapter::PixelLoop> LajollaRenderer::loopFor(const RenderSettings& settings) const {
    const auto integrator = findIntegrator(settings.integrator.empty() ? options_.integrator : settings.integrator, scene_->scene());
    if (!integrator) return integrator.error();
    if (!settings.sampler.empty() && settings.sampler != info().sampler) {
        return Error{ErrorCode::invalidArgument, "Asked for the sampler \"" + settings.sampler + "\": lajolla has one, \"" + info().sampler + "\"."};
    }
    const std::uint64_t seed = settings.hasSeed ? settings.seed : options_.seed;
    adapter::PixelLoop loop;
    loop.width = scene_->width();
    loop.height = scene_->height();
    loop.samplesPerPixel = settings.samplesPerPixel > 0 ? settings.samplesPerPixel : samplesPerPixel();
    loop.threads = options_.threads;
    loop.makeWorker = [scene = scene_, integrator = *integrator, seed](SurfaceRecorder* surface) -> Result<std::unique_ptr<adapter::PixelWorker>> {
        return std::make_unique<Worker>(*scene, integrator, seed, surface);
    };
    return loop;
}

std::shared_ptr<ServerTool> LajollaRenderer::lightProbes() const {
    const auto make = [scene = scene_, options = options_](const probe::LightProbeRequest& request) -> Result<std::unique_ptr<adapter::ProbeWorker>> {
        const auto integrator = findIntegrator(request.integrator.empty() ? options.integrator : request.integrator, scene->scene());
        if (!integrator) return integrator.error();
        if (request.maximumDepth != 0 && integrator->course) {
            return Error{ErrorCode::invalidArgument,
                         "Asked for a light probe of another depth: lajolla's " + integrator->name + " has the scene's alone; ask for emcapath."};
        }
        return std::make_unique<Prober>(*scene, *integrator, request.seed, request.maximumDepth);
    };
    return std::make_shared<adapter::LightProbeTool>(make, static_cast<float>(scene_->scene().bounds.radius) * 1e-4f, options_.threads);
}

}  // namespace emca::lajolla
