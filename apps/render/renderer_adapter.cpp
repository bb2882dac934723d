#include "renderer_adapter.h"

#include <utility>

#include "emca/recorder/path_layers.h"

namespace emca {

namespace {

render::RenderCallbacks callbacksTo(RequestMonitor& monitor) {
    render::RenderCallbacks callbacks;
    callbacks.cancelled = [&monitor] { return monitor.cancelled(); };
    callbacks.progress = [&monitor](double fraction) { monitor.progress(fraction); };
    callbacks.tileDone = [&monitor](PixelRect tile, const std::vector<Color>& colors) { monitor.preview(tile, colors); };
    return callbacks;
}

}  // namespace

Result<void> applyNames(const std::string& integrator, const std::string& sampler,
                        const render::IntegratorSettings& sceneSettings, render::RenderOptions& options) {
    if (integrator == "path") {
        options.integrator = sceneSettings;
    } else if (integrator == "direct") {
        options.integrator = sceneSettings;
        options.integrator.maximumDepth = 2;
    } else if (!integrator.empty()) {
        return Error{ErrorCode::invalidArgument,
                     "Asked for the integrator \"" + integrator + "\": there are path and direct."};
    }
    if (sampler == "independent") {
        options.sampler = render::SamplerKind::independent;
    } else if (sampler == "sobol") {
        options.sampler = render::SamplerKind::sobol;
    } else if (!sampler.empty()) {
        return Error{ErrorCode::invalidArgument,
                     "Asked for the sampler \"" + sampler + "\": there are independent and sobol."};
    }
    return {};
}

RendererAdapter::RendererAdapter(std::shared_ptr<const render::Scene> scene, const render::RenderOptions& options,
                                 std::string integrator, int threads)
    : renderer_(std::move(scene), threads), options_(options), integrator_(std::move(integrator)) {}

RendererInfo RendererAdapter::info() const {
    RendererInfo info;
    info.renderer = "emca-render 0.1";
    info.scene = renderer_.scene().name();
    info.width = renderer_.scene().width();
    info.height = renderer_.scene().height();
    info.samplesPerPixel = options_.samplesPerPixel;
    info.integrator = integrator_;
    info.sampler = render::name(options_.sampler);
    info.seed = options_.seed;
    info.concurrent = true;
    info.threads = static_cast<unsigned>(renderer_.threads());
    info.deterministic = true;
    return info;
}

Camera RendererAdapter::camera() const { return renderer_.scene().camera().view(); }

std::vector<Mesh> RendererAdapter::meshes() const { return renderer_.scene().meshes(); }

Result<render::RenderOptions> RendererAdapter::optionsFor(const RenderSettings& settings) const {
    render::RenderOptions options = options_;
    if (auto named = applyNames(settings.integrator, settings.sampler, renderer_.scene().integrator(), options); !named) {
        return named.error();
    }
    if (settings.samplesPerPixel > 0) options.samplesPerPixel = settings.samplesPerPixel;
    if (settings.hasSeed) options.seed = settings.seed;
    return options;
}

Result<RenderedImage> RendererAdapter::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    const auto options = optionsFor(settings);
    if (!options) return options.error();
    return renderer_.renderImage(*options, callbacksTo(monitor));
}

std::vector<LayerDescription> RendererAdapter::surfaceLayers() const { return pathLayers(); }

Result<RenderedImage> RendererAdapter::renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                             RequestMonitor& monitor) {
    const auto options = optionsFor(settings);
    if (!options) return options.error();
    return renderer_.renderImage(*options, callbacksTo(monitor), &surface);
}

Result<Color> RendererAdapter::renderPixel(Pixel pixel, const RenderSettings& settings, Recording&,
                                           RequestMonitor& monitor) {
    const auto options = optionsFor(settings);
    if (!options) return options.error();
    // The server opened the RecordScope of this thread, and the whole pixel is rendered in it.
    return renderer_.renderPixel(pixel, *options, callbacksTo(monitor));
}

}  // namespace emca
