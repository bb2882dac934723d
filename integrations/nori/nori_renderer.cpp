#include "nori_renderer.h"

#include <algorithm>
#include <optional>
#include <string>

#include "emca/adapter/exchanged.h"
#include "emca/adapter/light_probe_tool.h"
#include "emca/core/seed_map.h"
#include "seeded_sampler.h"

namespace emca::nori_adapter {

namespace {

/// One thread's way of tracing paths. Everything about a sample follows from the pixel, its index and the seed.
class PathTracer {
  public:
    PathTracer(const LoadedScene& scene, std::uint64_t seed, std::uint32_t samples, SurfaceRecorder* surface)
        : loaded_(scene), seeds_(seed), sampler_(samples), surface_(surface), observer_(scene.meshIndices(), scene.centre(), scene.radius()) {}

    nori::Color3f sample(Pixel pixel, std::uint32_t index) {
        PathRecorder emca = recorder();
        sampler_.seed(seeds_.seed(pixel, index));
        emca.setPathIndex(index);
        const nori::Point2f uFilm = sampler_.next2D(), uAperture = sampler_.next2D();
        const FilterSampler::Offset x = loaded_.filter().sample(uFilm.x()), y = loaded_.filter().sample(uFilm.y());
        const nori::Point2f film(float(pixel.x) + 0.5f + x.offset, float(pixel.y) + 0.5f + y.offset);
        nori::Ray3f ray;
        const nori::Color3f weight = loaded_.scene().getCamera()->sampleRay(ray, film, uAperture) * (x.weight * y.weight);
        emca.setPathOrigin(toVec3f(ray.o));
        emca.addPathData("film position", [&] { return Vec2f{film.x(), film.y()}; });
        emca.addPathData("camera weight", [&] { return toColor(weight); });
        if (!emca.isRecording() && !surface_) return weight * radiance(ray);
        observer_.beginPath(emca, index, surface_);
        const nori::Color3f value = [&] {
            const adapter::Exchanged observed(currentObserver(), &observer_);
            return nori::Color3f(weight * radiance(ray));
        }();
        observer_.endPath(value);
        return value;
    }

    nori::Color3f radiance(const nori::Ray3f& ray, Pixel pixel, std::uint32_t index) {
        sampler_.seed(seeds_.seed(pixel, index));
        return radiance(ray);
    }

  private:
    nori::Color3f radiance(const nori::Ray3f& ray) { return loaded_.scene().getIntegrator()->Li(&loaded_.scene(), &sampler_, ray); }

    const LoadedScene& loaded_;
    SeedMap seeds_;
    SeededSampler sampler_;
    SurfaceRecorder* surface_;
    Observer observer_;
};

class Worker final : public adapter::PixelWorker {
  public:
    Worker(const LoadedScene& scene, std::uint64_t seed, std::uint32_t samples, SurfaceRecorder* surface) : tracer_(scene, seed, samples, surface) {}
    Color sample(Pixel pixel, std::uint32_t index) override { return toColor(tracer_.sample(pixel, index)); }

  private:
    PathTracer tracer_;
};

class Prober final : public adapter::ProbeWorker {
  public:
    Prober(const LoadedScene& scene, std::uint64_t seed, std::uint32_t samples) : tracer_(scene, seed, samples, nullptr) {}
    Color radiance(Vec3f origin, Vec3f direction, Pixel pixel, std::uint32_t sample) override {
        const nori::Ray3f ray(nori::Point3f(origin.x, origin.y, origin.z), nori::Vector3f(direction.x, direction.y, direction.z));
        return toColor(tracer_.radiance(ray, pixel, sample));
    }

  private:
    PathTracer tracer_;
};

}  // namespace

std::uint32_t NoriRenderer::samplesPerPixel() const {
    return options_.samplesPerPixel > 0 ? options_.samplesPerPixel
                                        : static_cast<std::uint32_t>(std::max<std::size_t>(1, scene_->scene().getSampler()->getSampleCount()));
}

RendererInfo NoriRenderer::info() const {
    RendererInfo info;
    info.renderer = "Nori";
    info.scene = scene_->name();
    info.width = static_cast<std::uint32_t>(scene_->scene().getCamera()->getOutputSize().x());
    info.height = static_cast<std::uint32_t>(scene_->scene().getCamera()->getOutputSize().y());
    info.samplesPerPixel = samplesPerPixel();
    info.integrator = scene_->integratorName();
    info.sampler = "pcg32 per pixel and sample";
    info.seed = options_.seed;
    info.concurrent = true;
    info.threads = options_.threads;
    return info;
}

Result<adapter::PixelLoop> NoriRenderer::loopFor(const RenderSettings& settings) const {
    const RendererInfo own = info();
    if (!settings.integrator.empty() && settings.integrator != own.integrator) {
        return Error{ErrorCode::invalidArgument, "Asked for the integrator \"" + settings.integrator + "\": the scene has one, \"" + own.integrator + "\"."};
    }
    if (!settings.sampler.empty() && settings.sampler != own.sampler) {
        return Error{ErrorCode::invalidArgument, "Asked for the sampler \"" + settings.sampler + "\": there is one, \"" + own.sampler + "\"."};
    }
    adapter::PixelLoop loop;
    loop.width = own.width;
    loop.height = own.height;
    loop.samplesPerPixel = settings.samplesPerPixel > 0 ? settings.samplesPerPixel : own.samplesPerPixel;
    loop.threads = options_.threads;
    loop.makeWorker = [scene = scene_, seed = settings.hasSeed ? settings.seed : options_.seed,
                       samples = loop.samplesPerPixel](SurfaceRecorder* surface) -> Result<std::unique_ptr<adapter::PixelWorker>> {
        return std::make_unique<Worker>(*scene, seed, samples, surface);
    };
    return loop;
}

std::shared_ptr<ServerTool> NoriRenderer::lightProbes() const {
    const auto make = [scene = scene_](const probe::LightProbeRequest& request) -> Result<std::unique_ptr<adapter::ProbeWorker>> {
        if (!request.integrator.empty() && request.integrator != scene->integratorName()) {
            return Error{ErrorCode::invalidArgument, "Asked for the integrator \"" + request.integrator + "\": the scene has one, \"" + scene->integratorName() + "\"."};
        }
        if (request.maximumDepth != 0) {
            return Error{ErrorCode::invalidArgument, "Asked for a light probe of another depth: Nori's integrators have their own alone."};
        }
        return std::make_unique<Prober>(*scene, request.seed, request.samplesPerPixel);
    };
    return std::make_shared<adapter::LightProbeTool>(make, scene_->radius() * 1e-4f, options_.threads);
}

}  // namespace emca::nori_adapter
