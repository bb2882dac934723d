#include "pbrt_renderer.h"

#include <utility>

#include "emca/recorder/surface_recorder.h"

namespace emca::pbrt4 {

namespace {

constexpr float kProbeOffset = 1e-4f;     ///< of the scene's radius
constexpr int kUnlimitedDepth = 1 << 20;  ///< scattering events; roulette ends paths long before
constexpr std::initializer_list<PathLayer> kSeenFromOutside = {PathLayer::intersections, PathLayer::pathDepth};

bool isOwn(const pbrt::RayIntegrator& integrator) {
    return dynamic_cast<const EmcaPathIntegrator*>(&integrator) != nullptr;
}

/// Layers that only our integrator can fill.
bool wantsInside(const PathLayers& layers) {
    return layers.nextEvents || layers.misWeight || layers.throughput || layers.reflected || layers.contribution ||
           layers.invalidDirections || layers.roulette;
}

}  // namespace

Result<std::unique_ptr<PbrtRenderer>> PbrtRenderer::make(std::unique_ptr<LoadedScene> scene,
                                                         const RenderChoice& choice) {
    std::unique_ptr<PbrtRenderer> renderer(new PbrtRenderer(std::move(scene), choice));
    if (auto request = renderer->requestFor({}); !request) return request.error();
    return renderer;
}

RendererInfo PbrtRenderer::info() const {
    const pbrt::Bounds2i bounds = scene_->film().PixelBounds();
    RendererInfo info;
    info.renderer = "pbrt-v4 (emca-pbrt 0.1)";
    info.scene = choice_.sceneName;
    info.width = static_cast<std::uint32_t>(bounds.Diagonal().x);
    info.height = static_cast<std::uint32_t>(bounds.Diagonal().y);
    info.samplesPerPixel = static_cast<std::uint32_t>(choice_.samplesPerPixel.value_or(scene_->samplesPerPixel()));
    info.integrator = scene_->integratorName();
    info.sampler = scene_->samplerName();
    info.seed = static_cast<std::uint64_t>(scene_->seed());
    info.concurrent = true;
    info.deterministic = true;
    info.threads = choice_.threads;
    return info;
}

std::vector<LayerDescription> PbrtRenderer::surfaceLayers() const {
    const auto integrator = scene_->integrator("");
    return integrator && isOwn(**integrator) ? pathLayers() : pathLayers(kSeenFromOutside);
}

Result<PixelRequest> PbrtRenderer::requestFor(const RenderSettings& settings) const {
    const auto integrator = scene_->integrator(settings.integrator);
    if (!integrator) return integrator.error();
    std::optional<int> samples = choice_.samplesPerPixel;
    if (settings.samplesPerPixel > 0) {
        if (settings.samplesPerPixel > 1u << 30)
            return Error{ErrorCode::tooLarge, "pbrt takes at most 2^30 samples per pixel."};
        samples = static_cast<int>(settings.samplesPerPixel);
    }
    std::optional<int> seed;
    if (settings.hasSeed) seed = static_cast<int>(static_cast<std::uint32_t>(settings.seed));  // pbrt's have 32 bits
    auto sampler = scene_->sampler(settings.sampler, samples, seed);
    if (!sampler) return sampler.error();
    const int count = samples.value_or((*sampler)->sampler.SamplesPerPixel());
    return PixelRequest{*scene_, **integrator, std::move(*sampler), static_cast<std::uint32_t>(count)};
}

adapter::PixelLoop PbrtRenderer::loopFor(const PixelRequest& request, pbrt::Bounds2i bounds) const {
    const pbrt::Vector2i size = scene_->film().PixelBounds().Diagonal();
    const auto film = std::make_shared<OwnFilm>(scene_->film(), bounds);
    return {.width = static_cast<std::uint32_t>(size.x),
            .height = static_cast<std::uint32_t>(size.y),
            .samplesPerPixel = request.samplesPerPixel,
            .threads = choice_.threads,
            .makeWorker = [request, film](SurfaceRecorder* surface) -> Result<std::unique_ptr<adapter::PixelWorker>> {
                return std::unique_ptr<adapter::PixelWorker>(std::make_unique<PbrtPixelWorker>(request, film, surface));
            }};
}

Result<RenderedImage> PbrtRenderer::render(const RenderSettings& settings, RequestMonitor& monitor,
                                           SurfaceRecorder* surface) const {
    auto request = requestFor(settings);
    if (!request) return request.error();
    std::optional<PathLayers> layers;
    if (surface) {
        layers.emplace(*surface);
        request->layers = &*layers;
        if (!isOwn(request->integrator) && wantsInside(*layers)) {
            return Error{ErrorCode::notSupported,
                         "Of pbrt's own integrators only \"intersection density\" and \"path depth\" are seen from "
                         "outside; for the other layers render with \"emcapath\"."};
        }
    }
    return adapter::renderImage(loopFor(*request, scene_->film().PixelBounds()), monitor, surface);
}

Result<RenderedImage> PbrtRenderer::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    return render(settings, monitor, nullptr);
}

Result<RenderedImage> PbrtRenderer::renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                          RequestMonitor& monitor) {
    return render(settings, monitor, &surface);
}

Result<Color> PbrtRenderer::renderPixel(Pixel pixel, const RenderSettings& settings, Recording&,
                                        RequestMonitor& monitor) {
    const auto request = requestFor(settings);
    if (!request) return request.error();
    const pbrt::Point2i place =
        scene_->film().PixelBounds().pMin + pbrt::Vector2i(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    return adapter::renderPixel(loopFor(*request, pbrt::Bounds2i(place, place + pbrt::Vector2i(1, 1))), pixel, monitor);
}

std::shared_ptr<ServerTool> PbrtRenderer::lightProbe() const {
    const auto makeWorker =
        [this](const probe::LightProbeRequest& request) -> Result<std::unique_ptr<adapter::ProbeWorker>> {
        const auto integrator = scene_->integrator(request.integrator);
        if (!integrator) return integrator.error();
        // Segments from the probe on are one more than scattering events.
        const int depth = request.maximumDepth > 0   ? request.maximumDepth - 1
                          : request.maximumDepth < 0 ? kUnlimitedDepth
                                                     : -1;
        return std::unique_ptr<adapter::ProbeWorker>(
            std::make_unique<PbrtProbeWorker>(*scene_, **integrator, depth, request.seed));
    };
    return std::make_shared<adapter::LightProbeTool>(makeWorker, kProbeOffset * scene_->sceneRadius(), choice_.threads);
}

}  // namespace emca::pbrt4
