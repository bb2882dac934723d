#include "convert.h"

#include <utility>

namespace emca::client {

ServerInfo infoOf(protocol::Info message) {
    ServerInfo info;
    info.renderer = std::move(message.renderer);
    info.scene = std::move(message.scene);
    info.integrator = std::move(message.integrator);
    info.sampler = std::move(message.sampler);
    info.width = message.width;
    info.height = message.height;
    info.samplesPerPixel = message.samplesPerPixel;
    info.seed = message.seed;
    info.triangles = message.triangles;
    info.meshes = message.meshes;
    info.maximumSamplesPerPixel = message.maximumSamplesPerPixel;
    info.maximumPixelsPerTrace = message.maximumPixelsPerTrace;
    info.capabilities = std::move(message.capabilities);
    info.tools = std::move(message.tools);
    info.latestRender = message.latestRender;
    for (protocol::Layer& layer : message.layers) info.layers.push_back(std::move(layer.description));
    info.surfaceRender = message.surfaceRender;
    for (protocol::Layer& layer : message.collected) info.collected.push_back({std::move(layer.description), layer.samples, layer.total});
    info.maximumSurfaceBudget = message.maximumSurfaceBudget;
    return info;
}

protocol::Info messageOf(const ServerInfo& info) {
    protocol::Info message;
    message.renderer = info.renderer;
    message.scene = info.scene;
    message.integrator = info.integrator;
    message.sampler = info.sampler;
    message.width = info.width;
    message.height = info.height;
    message.samplesPerPixel = info.samplesPerPixel;
    message.seed = info.seed;
    message.triangles = info.triangles;
    message.meshes = info.meshes;
    message.maximumSamplesPerPixel = info.maximumSamplesPerPixel;
    message.maximumPixelsPerTrace = info.maximumPixelsPerTrace;
    message.capabilities = info.capabilities;
    message.tools = info.tools;
    message.latestRender = info.latestRender;
    for (const LayerDescription& layer : info.layers) message.layers.push_back({layer, 0, 0});
    message.surfaceRender = info.surfaceRender;
    for (const CollectedLayer& layer : info.collected) message.collected.push_back({layer.description, layer.samples, layer.total});
    message.maximumSurfaceBudget = info.maximumSurfaceBudget;
    return message;
}

Trace traceOf(protocol::TraceResult message) {
    Trace trace;
    trace.pixels = std::move(message.pixels);
    trace.replays = std::move(message.replays);
    trace.samplesPerPixel = message.settings.samplesPerPixel;
    trace.paths = std::move(message.paths);
    trace.stats = message.stats;
    trace.renderSeconds = message.renderSeconds;
    trace.renderId = message.renderId;
    trace.seed = message.settings.seed;
    trace.integrator = std::move(message.settings.integrator);
    trace.sampler = std::move(message.settings.sampler);
    trace.matches = std::move(message.matches);
    return trace;
}

protocol::TraceResult messageOf(const Trace& trace) {
    protocol::TraceResult message;
    message.pixels = trace.pixels;
    message.replays = trace.replays;
    message.settings = {trace.samplesPerPixel, trace.integrator, trace.sampler, trace.seed, true};
    message.renderId = trace.renderId;
    message.stats = trace.stats;
    message.renderSeconds = trace.renderSeconds;
    message.paths = trace.paths;
    message.matches = trace.matches;
    return message;
}

}  // namespace emca::client
