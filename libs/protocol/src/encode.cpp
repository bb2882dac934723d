#include <memory>
#include <utility>

#include "emca/protocol/codec.h"
#include "encoder.h"

namespace emca::protocol {

namespace {

using Encoded = std::pair<wire::Body, Offset<void>>;

template <typename T>
Encoded body(Offset<T> offset) {
    constexpr wire::Body kKind = wire::BodyTraits<T>::enum_value;  // itself it has no address
    return {kKind, offset.Union()};
}

Offset<wire::Settings> encodeSettings(Builder& b, const Settings& s) {
    const auto integrator = text(b, s.integrator), sampler = text(b, s.sampler);
    return wire::CreateSettings(b, s.samplesPerPixel, integrator, sampler, s.seed, s.hasSeed);
}

Encoded encodeBody(Builder& b, const Hello& m) {
    const auto software = text(b, m.software);
    const auto capabilities = texts(b, m.capabilities);
    const auto token = text(b, m.token);
    return body(wire::CreateHello(b, software, m.minimumVersion, m.maximumVersion, capabilities, token));
}
Encoded encodeBody(Builder& b, const Welcome& m) {
    const auto software = text(b, m.software);
    const auto capabilities = texts(b, m.capabilities);
    return body(wire::CreateWelcome(b, software, m.version, capabilities, m.maximumRequestBytes));
}
Encoded encodeBody(Builder& b, const Refusal& m) {
    const auto message = text(b, m.error.message);
    return body(wire::CreateRefusal(b, static_cast<std::uint16_t>(m.error.code), message, m.minimumVersion, m.maximumVersion));
}
Encoded encodeBody(Builder& b, const Cancel&) { return body(wire::CreateCancel(b)); }
Encoded encodeBody(Builder& b, const Progress& m) { return body(wire::CreateProgress(b, m.fraction, m.waiting)); }
Encoded encodeBody(Builder& b, const Failure& m) {
    const auto message = text(b, m.error.message);
    return body(wire::CreateFailure(b, static_cast<std::uint16_t>(m.error.code), message));
}
Encoded encodeBody(Builder& b, const Done&) { return body(wire::CreateDone(b)); }
Encoded encodeBody(Builder& b, const InfoRequest&) { return body(wire::CreateInfoRequest(b)); }
Encoded encodeBody(Builder& b, const Info& m) {
    const auto renderer = text(b, m.renderer), scene = text(b, m.scene), integrator = text(b, m.integrator),
               sampler = text(b, m.sampler);
    const auto capabilities = texts(b, m.capabilities), tools = texts(b, m.tools);
    const auto layers = encodeLayers(b, m.layers), collected = encodeLayers(b, m.collected);
    return body(wire::CreateInfo(b, renderer, scene, integrator, sampler, m.width, m.height, m.samplesPerPixel, m.seed,
                                 m.concurrent, m.deterministic, m.triangles, m.meshes, m.maximumSamplesPerPixel,
                                 m.maximumPixelsPerTrace, m.maximumBudget, capabilities, tools, m.latestRender, layers, m.surfaceRender,
                                 collected, m.maximumSurfaceBudget));
}
Encoded encodeBody(Builder& b, const CameraRequest&) { return body(wire::CreateCameraRequest(b)); }
Encoded encodeBody(Builder& b, const Camera& m) {
    const auto position = toWire(m.position), direction = toWire(m.direction), up = toWire(m.up);
    return body(wire::CreateCamera(b, static_cast<std::uint8_t>(m.kind), &position, &direction, &up,
                                   m.verticalFieldOfView, m.nearClip, m.farClip, m.focusDistance, m.apertureRadius,
                                   m.rightHanded));
}
Encoded encodeBody(Builder& b, const SceneRequest& m) { return body(wire::CreateSceneRequest(b, m.maximumChunkBytes)); }

Offset<wire::MeshPart> encodePart(Builder& b, const MeshPart& m) {
    const auto name = text(b, m.name), material = text(b, m.material);
    const auto diffuse = toWire(m.diffuse), emission = toWire(m.emission);
    const auto positions = column(b, m.positions);
    const auto triangles = column(b, m.triangles);
    return wire::CreateMeshPart(b, m.mesh, name, material, &diffuse, &emission, m.vertexCount, m.triangleCount,
                                m.firstVertex, m.firstTriangle, positions, triangles);
}
Encoded encodeBody(Builder& b, const SceneChunk& m) {
    std::vector<Offset<wire::MeshPart>> parts;
    for (const MeshPart& part : m.parts) parts.push_back(encodePart(b, part));
    const auto list = parts.empty() ? 0 : b.CreateVector(parts);
    return body(wire::CreateSceneChunk(b, m.meshCount, m.vertexCount, m.triangleCount, list, m.last));
}
Encoded encodeBody(Builder& b, const RenderRequest& m) {
    const auto settings = encodeSettings(b, m.settings);
    const auto layers = texts(b, m.layers);
    return body(wire::CreateRenderRequest(b, settings, m.preview, m.maximumChunkBytes, layers, m.surfaceBudget));
}
Encoded encodeBody(Builder& b, const PreviewTile& m) {
    const auto rect = toWire(m.rect);
    const auto colors = column(b, m.colors);
    return body(wire::CreatePreviewTile(b, &rect, colors));
}
Encoded encodeBody(Builder& b, const RenderResult& m) {
    const auto settings = encodeSettings(b, m.settings);
    const auto layers = encodeLayers(b, m.layers);
    const auto counts = toWire(m.surfaceCounts);
    return body(wire::CreateRenderResult(b, m.id, settings, m.seconds, m.width, m.height, layers,
                                         m.layers.empty() ? nullptr : &counts, m.surfaceFaces));
}
Encoded encodeBody(Builder& b, const ImageRows& m) {
    const auto colors = column(b, m.colors);
    const auto samples = column(b, m.samples);
    const auto variance = column(b, m.variance);
    return body(wire::CreateImageRows(b, m.firstRow, m.rowCount, colors, samples, variance, m.last));
}
Encoded encodeBody(Builder& b, const TraceRequest& m) {
    const auto pixels = column(b, std::span<const Pixel>(m.pixels));
    const auto rect = toWire(m.rect);
    const auto settings = encodeSettings(b, m.settings);
    const auto colors = column(b, m.colors);
    const auto columns = texts(b, m.columns);
    const auto query = text(b, m.query);
    return body(wire::CreateTraceRequest(b, pixels, &rect, settings, static_cast<std::uint8_t>(m.against), m.renderId,
                                         colors, columns, query, m.budget, m.locations,
                                         static_cast<std::uint8_t>(m.keep), m.keepCount));
}
flatbuffers::Offset<wire::MatchCounts> encodeMatches(Builder& b, const MatchCounts& m) {
    const auto missing = texts(b, m.missing);
    const auto counts = column(b, m.matchedOfPixel);
    const auto sums = column(b, m.sumOfPixel);
    return wire::CreateMatchCounts(b, m.paths, m.matched, m.unknown, m.omitted, missing, counts, sums);
}
Encoded encodeBody(Builder& b, const TraceResult& m) {
    const auto paths = encodePaths(b, m.paths.columns());
    const auto pixels = column(b, std::span<const Pixel>(m.pixels));
    std::vector<wire::Replay> replays;
    for (const Replay& r : m.replays) {
        replays.emplace_back(static_cast<std::uint8_t>(r.verdict), static_cast<std::uint8_t>(r.sums),
                             toWire(r.rendered), toWire(r.replayed));
    }
    const auto replayList = replays.empty() ? 0 : b.CreateVectorOfStructs(replays);
    const auto settings = encodeSettings(b, m.settings);
    const auto matches = m.matches ? encodeMatches(b, *m.matches) : flatbuffers::Offset<wire::MatchCounts>();
    const wire::RecordingStats stats(m.stats.droppedWithoutPath, m.stats.droppedWithoutVertex, m.stats.droppedByBudget,
                                     m.stats.pathsNotKept, m.stats.bytes);
    return body(wire::CreateTraceResult(b, pixels, replayList, settings, m.renderId, &stats, m.renderSeconds, paths, matches));
}
Encoded encodeBody(Builder& b, const SurfaceRequest& m) {
    const auto layers = texts(b, m.layers);
    const auto settings = encodeSettings(b, m.settings);
    return body(wire::CreateSurfaceRequest(b, layers, settings, m.budget, m.renderId, m.maximumChunkBytes));
}
Encoded encodeBody(Builder& b, const SurfaceResult& m) { return body(encodeSurface(b, m)); }
Encoded encodeBody(Builder& b, const SurfaceChunk& m) { return body(encodeSurface(b, m)); }
Encoded encodeBody(Builder& b, const ToolRequest& m) {
    const auto tool = text(b, m.tool);
    const auto data = column(b, m.data, 8);
    return body(wire::CreateToolRequest(b, tool, data));
}
Encoded encodeBody(Builder& b, const ToolResult& m) {
    const auto data = column(b, m.data, 8);
    return body(wire::CreateToolResult(b, data));
}
Encoded encodeBody(Builder& b, const QuitRequest&) { return body(wire::CreateQuitRequest(b)); }
Encoded encodeBody(Builder&, const Unknown&) { return {wire::Body::NONE, 0}; }

// Upper bounds for the messages that may be large, so that the builder allocates once and never too much.
template <typename T>
std::size_t sizeHint(const T&) { return 1024; }
std::size_t sizeHint(const SceneChunk& m) {
    std::size_t bytes = 1024;
    for (const MeshPart& part : m.parts) {
        bytes += 256 + part.name.size() + part.material.size() + part.positions.size() * sizeof(Vec3f) +
                 part.triangles.size() * sizeof(Triangle);
    }
    return bytes;
}
std::size_t sizeHint(const PreviewTile& m) { return 256 + m.colors.size() * sizeof(Color); }
std::size_t sizeHint(const ImageRows& m) {
    return 256 + (m.colors.size() + m.variance.size()) * sizeof(Color) + m.samples.size() * sizeof(float);
}
std::size_t sizeHint(const Info& m) { return 4096 + encodedBytes(m.layers) + encodedBytes(m.collected); }
std::size_t sizeHint(const RenderResult& m) { return 1024 + encodedBytes(m.layers); }
std::size_t sizeHint(const SurfaceResult& m) { return 1024 + encodedBytes(m.layers); }
std::size_t sizeHint(const SurfaceChunk& m) { return encodedBytes(m); }
std::size_t sizeHint(const TraceRequest& m) {
    std::size_t bytes = 1024 + m.pixels.size() * sizeof(Pixel) + m.colors.size() * sizeof(Color) + m.query.size();
    for (const std::string& column : m.columns) bytes += column.size() + 16;
    return bytes;
}
std::size_t sizeHint(const TraceResult& m) {
    std::size_t bytes = 1024 + m.pixels.size() * (sizeof(Pixel) + sizeof(Replay)) + encodedBytes(m.paths.columns());
    if (m.matches) bytes += 256 + m.matches->matchedOfPixel.size() * 4 + m.matches->sumOfPixel.size() * sizeof(Color);
    return bytes;
}
std::size_t sizeHint(const ToolRequest& m) { return 256 + m.tool.size() + m.data.size(); }
std::size_t sizeHint(const ToolResult& m) { return 256 + m.data.size(); }

}  // namespace

Result<Frame> encode(const Message& message) {
    const std::size_t hint = std::visit([](const auto& m) { return sizeHint(m); }, message.body);
    if (hint > kMaximumReplyBytes) {
        return Error{ErrorCode::tooLarge, "The answer would have " + std::to_string(hint) +
                                              " bytes, more than one message can carry: ask for fewer pixels, samples or columns."};
    }
    if (std::holds_alternative<Unknown>(message.body)) {
        return Error{ErrorCode::invalidArgument, "A message of a kind that this version does not know cannot be sent."};
    }
    Builder builder(hint);
    const auto [type, offset] = std::visit([&](const auto& m) { return encodeBody(builder, m); }, message.body);
    builder.Finish(wire::CreateMessage(builder, message.request, type, offset), wire::MessageIdentifier());
    auto buffer = std::make_shared<flatbuffers::DetachedBuffer>(builder.Release());
    const auto* data = reinterpret_cast<const std::byte*>(buffer->data());
    const std::size_t size = buffer->size();
    return Frame(std::move(buffer), data, size);
}

}  // namespace emca::protocol
