#include "emca/render/light_probe.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace emca::render {

namespace {

constexpr std::uint32_t kPixelsPerTask = 64;
constexpr std::uint32_t kSamplesBetweenChecks = 256;  ///< how often a single pixel looks whether it was cancelled

/// Where rays of the probe start, and off which surface.
struct Origin {
    Vec3f position;
    Vec3f normal;      ///< 0: on no surface
    float error = 0;   ///< as SurfaceInteraction::positionError
};

float largestCoordinate(Vec3f v) { return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z))); }

/// A requested normal is that of the explorer's triangles: good enough to find the surface on which the point lies, which
/// knows its true normal and how far rounding may have put the point off it.
Origin originOf(const Scene& scene, const probe::LightProbeRequest& request) {
    constexpr float kReach = 1e-3f;  // of the scene's radius
    Origin origin{request.position, request.normal, 0};
    if (request.normal == Vec3f{}) return origin;
    origin.error = std::max(largestCoordinate(request.position), scene.radius()) * 1e-6f;

    const float reach = std::max(kReach * scene.radius(), 4.f * origin.error);
    Ray ray{request.position + request.normal * reach, -request.normal, 0.f, 2.f * reach};
    float nearest = reach;
    for (SurfaceInteraction at; scene.intersect(ray, at);) {
        const float apart = length(at.position - request.position);
        if (apart < nearest) {
            nearest = apart;
            origin.normal = at.geometricNormal;
            origin.error = at.positionError;
        }
        ray.origin = offsetOrigin(at.position, at.geometricNormal, at.positionError, ray.direction);
        ray.maximumDistance -= at.distance;
        if (!(ray.maximumDistance > 0.f)) break;
    }
    return origin;
}

class ProbeRenderer {
  public:
    ProbeRenderer(const Scene& scene, const probe::LightProbeRequest& request, const IntegratorSettings& integrator,
                  SamplerKind sampler, const RenderCallbacks& callbacks, probe::LightProbe& probe)
        : request_(request), integrator_(scene, integrator), sampler_(sampler), callbacks_(callbacks), probe_(probe),
          origin_(originOf(scene, request)) {}

    /// \return false if cancelled
    bool renderPixel(Pixel pixel) const {
        Sampler sampler(sampler_, request_.seed);
        emca::PathRecorder& emca = emca::recorder();
        double red = 0, green = 0, blue = 0, sum = 0, squares = 0;
        for (std::uint32_t index = 0; index < request_.samplesPerPixel; ++index) {
            if (index % kSamplesBetweenChecks == 0 && callbacks_.cancelled && callbacks_.cancelled()) return false;
            sampler.start(pixel, index);
            const Vec3f direction = normalize(probe_.map.sample(pixel, sampler.next2D()));
            const Ray ray{offsetOrigin(origin_.position, origin_.normal, origin_.error, direction), direction};
            const Color radiance = integrator_.radiance(ray, sampler, emca);
            red += double(radiance.r), green += double(radiance.g), blue += double(radiance.b);
            const auto brightness = double(luminance(radiance));
            sum += brightness, squares += brightness * brightness;
        }
        const double n = request_.samplesPerPixel;
        float* out = probe_.image.at(pixel);
        out[0] = static_cast<float>(red / n);
        out[1] = static_cast<float>(green / n);
        out[2] = static_cast<float>(blue / n);
        out[3] = n < 2 ? 0.f : static_cast<float>(std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1) / n));
        return true;
    }

  private:
    const probe::LightProbeRequest& request_;
    PathIntegrator integrator_;
    SamplerKind sampler_;
    const RenderCallbacks& callbacks_;
    probe::LightProbe& probe_;
    Origin origin_;
};

}  // namespace

Result<probe::LightProbe> renderLightProbe(const Scene& scene, const probe::LightProbeRequest& request,
                                           IntegratorSettings integrator, SamplerKind sampler, int threads,
                                           const RenderCallbacks& callbacks) {
    if (auto valid = probe::validate(request); !valid) return valid.error();
    const auto begin = std::chrono::steady_clock::now();
    integrator.hideEmitters = false;
    if (request.maximumDepth != 0) integrator.maximumDepth = request.maximumDepth;

    probe::LightProbe probe;
    probe.map = probe::SphereMap(request.frame, request.width, request.height);
    probe.samplesPerPixel = request.samplesPerPixel;
    probe.image = Image(request.width, request.height, probe::probeChannels());
    const ProbeRenderer renderer(scene, request, integrator, sampler, callbacks, probe);

    const std::uint32_t pixels = request.width * request.height;
    std::atomic<std::uint32_t> done = 0;
    std::atomic<bool> stop = false;
    const auto renderPixels = [&](const tbb::blocked_range<std::uint32_t>& range) {
        for (std::uint32_t i = range.begin(); i < range.end() && !stop; ++i) {
            if (!renderer.renderPixel({i % request.width, i / request.width})) stop = true;
        }
        const std::uint32_t finished = done += static_cast<std::uint32_t>(range.size());
        if (callbacks.progress && !stop) callbacks.progress(double(finished) / pixels);
    };
    tbb::task_arena arena(threads > 0 ? threads : tbb::info::default_concurrency());
    arena.execute([&] { tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, pixels, kPixelsPerTask), renderPixels, tbb::simple_partitioner()); });
    if (stop) return Error{ErrorCode::cancelled, "The light probe was cancelled before it was complete."};
    probe.seconds = std::chrono::duration<float>(std::chrono::steady_clock::now() - begin).count();
    return probe;
}

}  // namespace emca::render
