#include "bridge_renderer.h"

#include <algorithm>
#include <utility>

#include "emca/recorder/surface_recorder.h"
#include "film.h"
#include "heat_map.h"

namespace emca::bridge {

namespace {

PublishedServer::Cancelled asked(RequestMonitor& monitor) {
    return [&monitor] { return monitor.cancelled(); };
}

std::string sizeText(std::uint32_t width, std::uint32_t height) { return std::to_string(width) + " x " + std::to_string(height); }

}  // namespace

Result<std::unique_ptr<BridgeRenderer>> BridgeRenderer::make(PublishedServer& server, BridgeOptions options) {
    std::unique_ptr<BridgeRenderer> renderer(new BridgeRenderer(server, std::move(options)));
    if (auto prepared = renderer->prepare(); !prepared) return prepared.error();
    return renderer;
}

Result<void> BridgeRenderer::prepare() {
    const PublishedInfo& names = server_.info();
    info_.renderer = names.renderer + " (published EMCA, through the bridge)";
    info_.scene = names.scene;
    info_.samplesPerPixel = std::max(names.samplesPerPixel, 1u);
    for (const std::int16_t plugin : server_.plugins()) info_.capabilities.push_back("published-plugin-" + std::to_string(plugin));

    const auto camera = server_.camera();
    if (!camera) return camera.error();
    // Before any render: later the server sends heat maps in place of its scene.
    auto scene = server_.scene();
    if (!scene) return scene.error();
    if (scene->heatMap) {
        log("The server has a heat map from before and sends its triangles instead of the scene's: start the server anew to see the scene as it is.");
    }
    bool colored = false;
    for (std::size_t i = 0; i < scene->shapes.size(); ++i) {
        auto mesh = toMesh(scene->shapes[i], i);
        if (!mesh) return mesh.error();
        meshes_.push_back(std::move(mesh).value());
        colored = colored || !scene->shapes[i].faceColors.empty();
    }
    if (colored) coloredShapes_ = std::move(scene->shapes);

    info_.width = options_.width;
    info_.height = options_.height;
    if (info_.width == 0 || info_.height == 0) {
        if (auto found = findSize(); !found) return found;
    }
    const bool automatic = options_.axis == FieldOfViewAxis::automatic;
    const bool horizontal = automatic ? names.renderer.find("itsuba") != std::string::npos : options_.axis == FieldOfViewAxis::horizontal;
    camera_ = toCamera(*camera, horizontal, double(info_.width) / double(info_.height));
    if (automatic) {
        log("The field of view is taken as that of the image's " + std::string(horizontal ? "width, as Mitsuba's is" : "height, as published clients do") +
            "; if the 3D view frames another part than the image, give --fov-axis " + (horizontal ? "vertical." : "horizontal."));
    }
    return {};
}

Result<void> BridgeRenderer::findSize() {
    log("The wire has no image size: rendering with one sample per pixel to see it (--size WIDTHxHEIGHT saves that).");
    const auto image = server_.image(1);
    if (!image) return image.error();
    const auto file = readPublishedImage(image->path, options_.folders);
    if (!file) return Error{file.error().code, file.error().message + " To start without it, give --size WIDTHxHEIGHT."};
    info_.width = file->width();
    info_.height = file->height();
    return {};
}

std::vector<LayerDescription> BridgeRenderer::surfaceLayers() const { return {heatMapColors(), heatMapNumbers()}; }

Result<std::uint32_t> BridgeRenderer::samples(const RenderSettings& settings) const {
    if ((settings.hasSeed && settings.seed != 0) || !settings.integrator.empty() || !settings.sampler.empty()) {
        return Error{ErrorCode::invalidArgument, "A published server takes no seed, integrator or sampler: it can be asked for samples per pixel alone."};
    }
    return settings.samplesPerPixel != 0 ? settings.samplesPerPixel : info_.samplesPerPixel;
}

Result<BridgeRenderer::Rendered> BridgeRenderer::render(const RenderSettings& settings, RequestMonitor& monitor) {
    const auto count = samples(settings);
    if (!count) return count.error();
    auto reply = server_.image(*count, asked(monitor));
    if (!reply) return reply.error();
    auto color = readPublishedImage(reply->path, options_.folders);
    if (!color) return color.error();
    if (color->width() != info_.width || color->height() != info_.height) {
        return Error{ErrorCode::rendererFailed, "The published server's image \"" + reply->path + "\" has " + sizeText(color->width(), color->height()) +
                                                    " pixels instead of " + sizeText(info_.width, info_.height) + ": start the bridge with that --size."};
    }
    halfImage_ = isHalf(*color);
    Rendered rendered;
    rendered.image.color = std::move(color).value();  // sample counts follow from the request; variances are not on the wire
    rendered.heatMap = std::move(reply->scene);
    return rendered;
}

Result<RenderedImage> BridgeRenderer::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    auto rendered = render(settings, monitor);
    if (!rendered) return rendered.error();
    return std::move(rendered->image);
}

Result<RenderedImage> BridgeRenderer::renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface, RequestMonitor& monitor) {
    auto rendered = render(settings, monitor);
    if (!rendered) return rendered.error();
    if (!rendered->heatMap && coloredShapes_.empty()) {
        log("A heat map was asked for, but the published server sent none: its renderer has to collect one while it renders.");
    }
    HeatMap map = heatMapOn(meshes_, rendered->heatMap ? rendered->heatMap->shapes : coloredShapes_, surface.layers());
    if (rendered->heatMap) {
        const std::string label = rendered->heatMap->heatMap ? rendered->heatMap->heatMap->label : std::string();
        log("Heat map " + (label.empty() ? "" : "\"" + label + "\" ") + "with " + std::to_string(map.faces) + " faces.");
    }
    if (map.without > 0) {
        log(std::to_string(map.without) + " triangles of the scene are not in the heat map, which is that of another subdivision: start server and bridge anew.");
    }
    map.field.counts.budgetBytes = surface.counts().budgetBytes;  // which the published server did not know of
    if (auto set = surface.setField(std::move(map.field)); !set) return set.error();
    return std::move(rendered->image);
}

Result<Color> BridgeRenderer::renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor& monitor) {
    const auto count = samples(settings);
    if (!count) return count.error();
    const auto reply = server_.pixel(pixel, *count, asked(monitor));
    if (!reply) return reply.error();
    if (!reply->remark.empty()) log(reply->remark);
    record(*reply);
    return pixelValue(*reply, *count, halfImage_);
}

}  // namespace emca::bridge
