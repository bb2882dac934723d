#include "service.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "chunks.h"
#include "monitor.h"
#include "surface_collection.h"

namespace emca {

namespace {

Error rendererFailed(const std::string& what) {
    return {ErrorCode::rendererFailed, "The renderer failed: " + what};
}

Error wasCancelled() { return {ErrorCode::cancelled, "The request was cancelled."}; }

std::string sizeText(const Image& image) { return std::to_string(image.width()) + " x " + std::to_string(image.height()); }

/// What we promise to clients about an image; fills in sample counts where the renderer gave none.
Result<void> checkAndComplete(RenderedImage& image, const RendererInfo& info, std::uint32_t samplesPerPixel) {
    if (image.color.width() != info.width || image.color.height() != info.height || image.color.channelCount() != 3) {
        return rendererFailed("it returned an image of " + sizeText(image.color) + " pixels with " +
                              std::to_string(image.color.channelCount()) + " channels instead of " + std::to_string(info.width) +
                              " x " + std::to_string(info.height) + " with 3.");
    }
    if (image.samples.empty()) {
        image.samples = Image(info.width, info.height, {"samples"});
        std::fill_n(image.samples.data(), image.samples.size(), static_cast<float>(samplesPerPixel));
    }
    if (image.samples.size() * 3 != image.color.size()) return rendererFailed("its sample counts have another size than its image.");
    if (!image.variance.empty() && image.variance.size() != image.color.size()) {
        return rendererFailed("its variances have another size than its image.");
    }
    return {};
}

}  // namespace

RenderSettings toRenderer(const protocol::Settings& settings) {
    return {settings.samplesPerPixel, settings.integrator, settings.sampler, settings.seed, settings.hasSeed};
}

Result<std::unique_ptr<Service>> Service::make(Renderer& renderer, const ServerOptions& options) {
    try {
        RendererInfo info = renderer.info();
        if (info.width == 0 || info.height == 0) return rendererFailed("it announces an image without pixels.");
        std::vector<LayerDescription> layers = renderer.surfaceLayers();
        if (auto checked = checkLayers(layers); !checked) return checked.error();
        return std::unique_ptr<Service>(new Service(renderer, options, std::move(info), std::move(layers)));
    } catch (const std::exception& exception) {
        return rendererFailed(exception.what());
    } catch (...) {
        return rendererFailed("it threw what is no std::exception.");
    }
}

Service::Service(Renderer& renderer, const ServerOptions& options, RendererInfo info, std::vector<LayerDescription> layers)
    : renderer_(renderer), options_(options), info_(std::move(info)), layers_(std::move(layers)),
      images_(options.keptImages), surfaces_(options.keptSurfaces) {}

void Service::run(const std::shared_ptr<Request>& request) noexcept {
    const auto fail = [&](Error error) {
        if (request->cancelled) error = wasCancelled();
        request->client->finish(*request, protocol::Failure{std::move(error)});
    };
    try {
        if (request->cancelled) return fail(wasCancelled());
        Answer answer = dispatch(request);
        if (!answer) return fail(answer.error());
        if (answer->has_value()) request->client->finish(*request, std::move(**answer));
    } catch (const std::bad_alloc&) {
        fail({ErrorCode::outOfMemory, "There was not enough memory for this request: ask for less at once."});
    } catch (const std::exception& exception) {
        fail(rendererFailed(exception.what()));
    } catch (...) {
        fail(rendererFailed("it threw what is no std::exception."));
    }
}

Service::Answer Service::dispatch(const std::shared_ptr<Request>& request) {
    return std::visit(
        [&](const auto& body) -> Answer {
            if constexpr (requires { this->answer(request, body); }) {
                return this->answer(request, body);
            } else {
                return Error{ErrorCode::internal, "A request went astray in the server: please report it."};
            }
        },
        request->body);
}

Lane Service::laneOf(const protocol::Body& request) {
    if (std::holds_alternative<protocol::RenderRequest>(request)) return Lane::image;
    if (std::holds_alternative<protocol::ToolRequest>(request)) return Lane::tool;
    // A query over a large part of the image takes as long as rendering it.
    constexpr std::uint64_t kQuickPixels = 4096;
    const auto* trace = std::get_if<protocol::TraceRequest>(&request);
    const bool large = trace && !trace->query.empty() && std::max<std::uint64_t>(trace->pixels.size(), trace->rect.count()) > kQuickPixels;
    return large ? Lane::image : Lane::interactive;
}

std::optional<protocol::Body> Service::immediately(const protocol::Body& request) const {
    const auto isOneOf = [&]<typename... T>(std::variant<T...>*) { return (std::holds_alternative<T>(request) || ...); };
    using Served = std::variant<protocol::CameraRequest, protocol::SceneRequest, protocol::RenderRequest,
                                protocol::TraceRequest, protocol::ToolRequest>;
    if (isOneOf(static_cast<Served*>(nullptr))) return std::nullopt;
    if (std::holds_alternative<protocol::InfoRequest>(request)) {
        if (!sceneCounted_) return std::nullopt;
        return infoReply();
    }
    return protocol::Failure{{ErrorCode::notSupported, "This server does not know this kind of request: it is older than the client."}};
}

protocol::Settings Service::sceneSettings() const {
    return {info_.samplesPerPixel, info_.integrator, info_.sampler, info_.seed, true};
}

Result<void> Service::checkSamples(std::uint32_t samplesPerPixel) const {
    if (samplesPerPixel == 0) {
        return Error{ErrorCode::invalidArgument, "Samples per pixel are 0 in the request and in the scene: ask for at least 1."};
    }
    if (samplesPerPixel > options_.maximumSamplesPerPixel) {
        return Error{ErrorCode::tooLarge, std::to_string(samplesPerPixel) + " samples per pixel were asked for, but this server allows at most " +
                                              std::to_string(options_.maximumSamplesPerPixel) + "."};
    }
    return {};
}

Result<std::shared_ptr<const std::vector<Mesh>>> Service::meshes() {
    auto meshes = std::make_shared<const std::vector<Mesh>>(renderer_.meshes());
    std::uint64_t triangles = 0;
    for (const Mesh& mesh : *meshes) {
        if (auto valid = validate(mesh); !valid) return rendererFailed(valid.error().message);
        triangles += mesh.triangles.size();
    }
    triangles_ = triangles;
    meshes_ = meshes->size();
    sceneCounted_ = true;
    return meshes;
}

protocol::Info Service::infoReply() const {
    protocol::Info reply;
    reply.renderer = info_.renderer;
    reply.scene = info_.scene;
    reply.integrator = info_.integrator;
    reply.sampler = info_.sampler;
    reply.width = info_.width;
    reply.height = info_.height;
    reply.samplesPerPixel = info_.samplesPerPixel;
    reply.seed = info_.seed;
    reply.concurrent = info_.concurrent;
    reply.deterministic = info_.deterministic;
    reply.triangles = triangles_;
    reply.meshes = meshes_;
    reply.maximumSamplesPerPixel = options_.maximumSamplesPerPixel;
    reply.maximumPixelsPerTrace = options_.maximumPixelsPerTrace;
    reply.maximumBudget = options_.maximumBudget;
    reply.capabilities = info_.capabilities;
    for (const char* own : {"render", "preview", "trace", "trace-pixels", "trace-rectangle", "columns", "verdict"}) {
        reply.capabilities.emplace_back(own);
    }
    if (info_.concurrent) reply.capabilities.emplace_back("concurrent");
    if (info_.deterministic) reply.capabilities.emplace_back("deterministic");
    if (options_.allowQuit) reply.capabilities.emplace_back("quit");
    if (!layers_.empty() && std::find(reply.capabilities.begin(), reply.capabilities.end(), "surface-layers") == reply.capabilities.end()) {
        reply.capabilities.emplace_back("surface-layers");
    }
    for (const LayerDescription& layer : layers_) reply.layers.push_back({layer, 0, 0});
    if (const auto surface = surfaces_.newest()) {
        reply.surfaceRender = surface->renderId;
        reply.collected = collectedLayers(surface->field);
    }
    if (!layers_.empty()) reply.maximumSurfaceBudget = options_.maximumSurfaceBudget;
    for (const auto& tool : tools()) reply.tools.push_back(tool->name());
    reply.latestRender = images_.latest();
    return reply;
}

Service::Answer Service::answer(const std::shared_ptr<Request>&, const protocol::InfoRequest&) {
    if (!sceneCounted_) {
        if (auto counted = meshes(); !counted) return counted.error();
    }
    return last(infoReply());
}

Service::Answer Service::answer(const std::shared_ptr<Request>&, const protocol::CameraRequest&) { return last(renderer_.camera()); }

Service::Answer Service::answer(const std::shared_ptr<Request>& request, const protocol::SceneRequest& asked) {
    auto scene = meshes();
    if (!scene) return scene.error();
    request->client->stream(*request, sceneChunks(std::move(scene).value(), chunkBytes(asked.maximumChunkBytes)));
    return std::optional<protocol::Body>();
}

Service::Answer Service::answer(const std::shared_ptr<Request>& request, const protocol::RenderRequest& asked) {
    const protocol::Settings settings = filled(asked.settings, sceneSettings());
    if (auto samples = checkSamples(settings.samplesPerPixel); !samples) return samples.error();
    auto collection = collectionFor(asked);
    if (!collection) return collection.error();
    JobMonitor monitor(request, asked.preview);
    const auto begin = std::chrono::steady_clock::now();
    auto image = *collection ? renderer_.renderImageWithLayers(toRenderer(settings), (*collection)->recorder, monitor)
                             : renderer_.renderImage(toRenderer(settings), monitor);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (!image) return image.error();
    if (request->cancelled) return wasCancelled();
    if (auto checked = checkAndComplete(*image, info_, settings.samplesPerPixel); !checked) return checked.error();
    std::shared_ptr<KeptSurface> surface;
    if (*collection) {
        auto collected = finished(**collection);
        if (!collected) return collected.error();
        if (request->cancelled) return wasCancelled();
        surface = std::move(collected).value();
    }
    const auto kept = images_.add(settings, seconds.count(), std::move(image).value());
    protocol::RenderResult result{kept->id, kept->settings, kept->seconds, info_.width, info_.height, {}, {}, 0};
    if (surface) {
        surface->renderId = kept->id;
        surface->settings = kept->settings;
        result.layers = collectedLayers(surface->field);
        result.surfaceCounts = surface->field.counts;
        result.surfaceFaces = surface->field.faceCount();
        surfaces_.add(std::move(surface));
    }
    request->client->send(*request, std::move(result));
    request->client->stream(*request, imageRows(kept, chunkBytes(asked.maximumChunkBytes)));
    return std::optional<protocol::Body>();
}

Service::Answer Service::answer(const std::shared_ptr<Request>& request, const protocol::ToolRequest& asked) {
    JobMonitor monitor(request, false);
    auto reply = ask(asked.tool, asked.data.span(), monitor);
    if (!reply) return reply.error();
    return last(protocol::ToolResult{SharedArray<std::byte>(std::move(reply).value())});
}

Result<std::vector<std::byte>> Service::ask(const std::string& tool, std::span<const std::byte> request, RequestMonitor& monitor) {
    if (const auto found = findTool(tool)) return found->answer(request, monitor);
    return Error{ErrorCode::notSupported, "There is no tool \"" + tool.substr(0, 100) + "\" at this server."};
}

std::shared_ptr<ServerTool> Service::findTool(const std::string& name) const {
    for (const auto& tool : tools())
        if (tool->name() == name) return tool;
    return nullptr;
}

std::vector<std::shared_ptr<ServerTool>> Service::tools() const {
    const std::lock_guard lock(toolsMutex_);
    return tools_;
}

std::vector<std::shared_ptr<ServerTool>> Service::observers() const {
    const std::lock_guard lock(toolsMutex_);
    return observers_;
}

Result<void> Service::addTool(std::shared_ptr<ServerTool> tool) {
    if (!tool) return Error{ErrorCode::invalidArgument, "A server tool was expected, but there is none."};
    const std::string name = tool->name();
    const bool observes = tool->observesReplay();
    const std::lock_guard lock(toolsMutex_);
    for (const auto& other : tools_) {
        if (other->name() == name) return Error{ErrorCode::invalidArgument, "There is a server tool \"" + name + "\" already."};
    }
    tool->setHost(*this);
    if (observes) observers_.push_back(tool);
    tools_.push_back(std::move(tool));
    return {};
}

}  // namespace emca
