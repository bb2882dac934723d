#include <cstring>

#include "decoder.h"
#include "emca/protocol/codec.h"

namespace emca::protocol {

namespace {

Error violation(const std::string& what) {
    return {ErrorCode::protocolViolation, "A message arrived that is no valid EMCA message: " + what + "."};
}

Vec3f vector(const wire::Vec3* v, Vec3f otherwise = {}) { return v ? fromWire(*v) : otherwise; }
Color color(const wire::Color* c, Color otherwise = {}) { return c ? fromWire(*c) : otherwise; }
PixelRect rectangle(const wire::Rect* r) { return r ? fromWire(*r) : PixelRect{}; }

Settings settings(Decoder& d, const wire::Settings* s) {
    if (!s) return {};
    return {s->samples_per_pixel(), d.text(s->integrator()), d.text(s->sampler()), s->seed(), s->has_seed()};
}

Hello decodeBody(Decoder& d, const wire::Hello& m) {
    return {d.text(m.software()), m.minimum_version(), m.maximum_version(), d.texts(m.capabilities()), d.text(m.token())};
}
Welcome decodeBody(Decoder& d, const wire::Welcome& m) {
    return {d.text(m.software()), m.version(), d.texts(m.capabilities()), m.maximum_request_bytes()};
}
// Numbers of later versions are kept: name() calls them "unknown", the sentence beside them tells.
Refusal decodeBody(Decoder& d, const wire::Refusal& m) {
    return {{static_cast<ErrorCode>(m.code()), d.text(m.message())}, m.minimum_version(), m.maximum_version()};
}
Cancel decodeBody(Decoder&, const wire::Cancel&) { return {}; }
Progress decodeBody(Decoder&, const wire::Progress& m) { return {m.fraction(), m.waiting()}; }
Failure decodeBody(Decoder& d, const wire::Failure& m) {
    return {{static_cast<ErrorCode>(m.code()), d.text(m.message())}};
}
Done decodeBody(Decoder&, const wire::Done&) { return {}; }
InfoRequest decodeBody(Decoder&, const wire::InfoRequest&) { return {}; }
Info decodeBody(Decoder& d, const wire::Info& m) {
    Info info;
    info.renderer = d.text(m.renderer());
    info.scene = d.text(m.scene());
    info.integrator = d.text(m.integrator());
    info.sampler = d.text(m.sampler());
    info.width = m.width();
    info.height = m.height();
    info.samplesPerPixel = m.samples_per_pixel();
    info.seed = m.seed();
    info.concurrent = m.concurrent();
    info.deterministic = m.deterministic();
    info.triangles = m.triangles();
    info.meshes = m.meshes();
    info.maximumSamplesPerPixel = m.maximum_samples_per_pixel();
    info.maximumPixelsPerTrace = m.maximum_pixels_per_trace();
    info.maximumBudget = m.maximum_budget();
    info.capabilities = d.texts(m.capabilities());
    info.tools = d.texts(m.tools());
    info.latestRender = m.latest_render();
    info.layers = decodeLayers(d, m.layers());
    info.surfaceRender = m.surface_render();
    info.collected = decodeLayers(d, m.collected());
    info.maximumSurfaceBudget = m.maximum_surface_budget();
    return info;
}
CameraRequest decodeBody(Decoder&, const wire::CameraRequest&) { return {}; }
Camera decodeBody(Decoder&, const wire::Camera& m) {
    Camera camera;
    // A kind of a later version is shown as one that we cannot draw.
    camera.kind = m.kind() <= static_cast<std::uint8_t>(CameraKind::other) ? static_cast<CameraKind>(m.kind()) : CameraKind::other;
    camera.position = vector(m.position());
    camera.direction = vector(m.direction(), camera.direction);
    camera.up = vector(m.up(), camera.up);
    camera.verticalFieldOfView = m.vertical_field_of_view();
    camera.nearClip = m.near_clip();
    camera.farClip = m.far_clip();
    camera.focusDistance = m.focus_distance();
    camera.apertureRadius = m.aperture_radius();
    camera.rightHanded = m.right_handed();
    return camera;
}
SceneRequest decodeBody(Decoder&, const wire::SceneRequest& m) { return {m.maximum_chunk_bytes()}; }
SceneChunk decodeBody(Decoder& d, const wire::SceneChunk& m) {
    SceneChunk chunk{m.mesh_count(), m.vertex_count(), m.triangle_count(), {}, m.last()};
    if (!m.parts()) return chunk;
    chunk.parts.reserve(m.parts()->size());
    for (const wire::MeshPart* source : *m.parts()) {
        MeshPart& part = chunk.parts.emplace_back();
        part.mesh = source->mesh();
        part.name = d.text(source->name());
        part.material = d.text(source->material());
        part.diffuse = color(source->diffuse(), Color(0.5f));
        part.emission = color(source->emission());
        part.vertexCount = source->vertex_count();
        part.triangleCount = source->triangle_count();
        part.firstVertex = source->first_vertex();
        part.firstTriangle = source->first_triangle();
        part.positions = d.view<Vec3f>(source->positions());
        part.triangles = d.view<Triangle>(source->triangles());
    }
    return chunk;
}
RenderRequest decodeBody(Decoder& d, const wire::RenderRequest& m) {
    return {settings(d, m.settings()), m.preview(), m.maximum_chunk_bytes(), d.texts(m.layers()), m.surface_budget()};
}
PreviewTile decodeBody(Decoder& d, const wire::PreviewTile& m) {
    PreviewTile tile{rectangle(m.rect()), d.view<Color>(m.colors())};
    if (tile.rect.count() != tile.colors.size()) d.fail("a preview tile has another size than its rectangle");
    return tile;
}
RenderResult decodeBody(Decoder& d, const wire::RenderResult& m) {
    return {m.id(), settings(d, m.settings()), m.seconds(), m.width(), m.height(), decodeLayers(d, m.layers()),
            decodeCounts(d, m.surface_counts()), m.surface_faces()};
}
ImageRows decodeBody(Decoder& d, const wire::ImageRows& m) {
    ImageRows rows{m.first_row(), m.row_count(), d.view<Color>(m.colors()), d.view<float>(m.samples()),
                   d.view<Color>(m.variance()), m.last()};
    if (rows.samples.size() != rows.colors.size()) d.fail("the sample counts of image rows do not match their colours");
    if (!rows.variance.empty() && rows.variance.size() != rows.colors.size()) {
        d.fail("the variances of image rows do not match their colours");
    }
    return rows;
}
TraceRequest decodeBody(Decoder& d, const wire::TraceRequest& m) {
    TraceRequest request;
    request.pixels = d.copy<Pixel>(m.pixels());
    request.rect = rectangle(m.rect());
    request.settings = settings(d, m.settings());
    request.against = d.enumeration(m.against(), Against::nothing, "kind of comparison");
    request.renderId = m.render_id();
    request.colors = d.view<Color>(m.colors());
    request.columns = d.texts(m.columns());
    request.query = d.text(m.query());
    request.budget = m.budget();
    request.locations = m.locations();
    request.keep = d.enumeration(m.keep(), KeepMatches::brightest, "way to keep matches");
    request.keepCount = m.keep_count();
    return request;
}
MatchCounts decodeMatches(Decoder& d, const wire::MatchCounts& m, std::size_t pixels) {
    MatchCounts matches{m.paths(), m.matched(), m.unknown(), m.omitted(), d.texts(m.missing()),
                        d.view<std::uint32_t>(m.matched_of_pixel()), d.view<Color>(m.sum_of_pixel())};
    if (matches.matchedOfPixel.size() != pixels || matches.sumOfPixel.size() != pixels) {
        d.fail("there is not one count and one sum of matches for each traced pixel");
    }
    return matches;
}
TraceResult decodeBody(Decoder& d, const wire::TraceResult& m) {
    TraceResult result;
    result.pixels = d.copy<Pixel>(m.pixels());
    if (m.replays() && d.aligned<wire::Replay>(m.replays()->Data())) {
        for (const wire::Replay* replay : *m.replays()) {
            result.replays.push_back({d.enumeration(replay->verdict(), Verdict::different, "verdict"),
                                      d.enumeration(replay->sums(), SumCheck::differs, "sum check"),
                                      fromWire(replay->rendered()), fromWire(replay->replayed())});
        }
    }
    if (result.replays.size() != result.pixels.size()) d.fail("there is not one comparison for each traced pixel");
    result.settings = settings(d, m.settings());
    result.renderId = m.render_id();
    if (const auto* s = d.aligned<wire::RecordingStats>(m.stats())) {
        result.stats = {s->dropped_without_path(), s->dropped_without_vertex(), s->dropped_by_budget(),
                        s->paths_not_kept(), s->bytes()};
    }
    result.renderSeconds = m.render_seconds();
    if (m.matches()) result.matches = decodeMatches(d, *m.matches(), result.pixels.size());
    if (!d.failed()) result.paths = decodePaths(d, m.paths());
    return result;
}
SurfaceRequest decodeBody(Decoder& d, const wire::SurfaceRequest& m) {
    return {d.texts(m.layers()), settings(d, m.settings()), m.budget(), m.render_id(), m.maximum_chunk_bytes()};
}
SurfaceResult decodeBody(Decoder& d, const wire::SurfaceResult& m) { return decodeSurface(d, m); }
SurfaceChunk decodeBody(Decoder& d, const wire::SurfaceChunk& m) { return decodeSurface(d, m); }
ToolRequest decodeBody(Decoder& d, const wire::ToolRequest& m) { return {d.text(m.tool()), d.view<std::byte>(m.data())}; }
ToolResult decodeBody(Decoder& d, const wire::ToolResult& m) { return {d.view<std::byte>(m.data())}; }
QuitRequest decodeBody(Decoder&, const wire::QuitRequest&) { return {}; }

/// Tries every alternative of the union until the one that the frame holds.
template <typename Table>
bool decodeAs(Decoder& d, const wire::Message& message, Body& body) {
    if (message.body_type() != wire::BodyTraits<Table>::enum_value) return false;
    body = decodeBody(d, *message.body_as<Table>());
    return true;
}
template <typename... Tables>
bool decodeAny(Decoder& d, const wire::Message& message, Body& body) {
    return (decodeAs<Tables>(d, message, body) || ...);
}

Result<Message> decodeAligned(const Frame& frame) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(frame.data());
    flatbuffers::Verifier verifier(data, frame.size(), 16, 1u << 20);
    if (!wire::MessageBufferHasIdentifier(data)) return violation("it does not say \"EMCA\"");
    if (!wire::VerifyMessageBuffer(verifier)) return violation("it is damaged or cut");
    const wire::Message& root = *wire::GetMessage(data);
    if (!root.body()) return violation("it has no content");
    Decoder decoder(frame);
    Message message;
    message.request = root.request();
    const bool known =
        decodeAny<wire::Hello, wire::Welcome, wire::Refusal, wire::Cancel, wire::Progress, wire::Failure, wire::Done,
                  wire::InfoRequest, wire::Info, wire::CameraRequest, wire::Camera, wire::SceneRequest,
                  wire::SceneChunk, wire::RenderRequest, wire::PreviewTile, wire::RenderResult, wire::ImageRows,
                  wire::TraceRequest, wire::TraceResult, wire::SurfaceRequest, wire::ToolRequest, wire::ToolResult,
                  wire::QuitRequest, wire::SurfaceResult, wire::SurfaceChunk>(decoder, root, message.body);
    if (!known) message.body = Unknown{static_cast<std::uint8_t>(root.body_type())};
    if (decoder.failed()) return violation(decoder.fault());
    return message;
}

}  // namespace

Result<Message> decode(const Frame& frame) {
    constexpr std::size_t kAlignment = 8;
    if (frame.size() < 8) return violation("it has " + std::to_string(frame.size()) + " bytes");
    if (frame.size() > kMaximumReplyBytes) return violation("it has " + std::to_string(frame.size()) + " bytes");
    if (reinterpret_cast<std::uintptr_t>(frame.data()) % kAlignment == 0) return decodeAligned(frame);
    auto copy = allocatePayload(frame.size());
    if (!copy) return copy.error();
    std::memcpy(copy->get(), frame.data(), frame.size());
    const std::byte* data = copy->get();
    return decodeAligned(Frame(std::move(copy).value(), data, frame.size()));
}

}  // namespace emca::protocol
