#pragma once

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "emca/protocol/messages.h"

/// Messages for tests: one of every kind, and path sets that use every column. Deterministic.
namespace emca::protocol::test {

class Source {
  public:
    explicit Source(std::uint64_t seed) : random_(seed) {}
    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>(random_() % limit); }
    std::uint64_t bits() { return random_(); }
    bool coin() { return (random_() & 1) != 0; }

    /// Random bits for numbers: every NaN payload, infinity and denormal comes through.
    template <typename T>
    std::vector<T> raw(std::size_t count) {
        std::vector<T> values(count);
        for (std::size_t i = 0; i < count * sizeof(T); ++i) {
            const auto byte = static_cast<unsigned char>(random_());
            std::memcpy(reinterpret_cast<unsigned char*>(values.data()) + i, &byte, 1);
        }
        return values;
    }
    std::string text() {
        std::string result(below(12), ' ');
        for (char& c : result) c = static_cast<char>(1 + below(255));
        return result;
    }
    std::vector<std::uint8_t> numbersBelow(std::uint8_t limit, std::size_t count) {
        std::vector<std::uint8_t> numbers(count);
        for (std::uint8_t& number : numbers) number = static_cast<std::uint8_t>(below(limit));
        return numbers;
    }
    /// Non-decreasing owners below `limit`, `count` of them.
    std::vector<Index> owners(std::size_t count, Index limit) {
        std::vector<Index> result(count);
        for (Index& owner : result) owner = below(limit);
        std::sort(result.begin(), result.end());
        return result;
    }

  private:
    std::mt19937_64 random_;
};

inline Column randomColumn(Source& source, std::string name, Scope scope, ValueType type, Index owners, std::uint32_t strings) {
    Column column;
    column.name = std::move(name);
    column.scope = scope;
    column.type = type;
    const bool dense = source.coin() || owners == 0;
    column.count = dense ? owners : 1 + source.below(2 * owners);
    if (!dense) column.owners = source.owners(column.count, owners);
    if (type == ValueType::spectrum) {
        std::vector<std::uint32_t> offsets{0};
        for (Index i = 0; i < column.count; ++i) offsets.push_back(offsets.back() + source.below(5));
        column.bytes = source.raw<std::byte>(std::size_t(offsets.back()) * 4);
        column.spectrumOffsets = std::move(offsets);
    } else if (type == ValueType::text) {
        std::vector<std::byte> bytes(std::size_t(column.count) * 4);
        for (Index i = 0; i < column.count; ++i) {
            const std::uint32_t string = source.below(strings);
            std::memcpy(&bytes[std::size_t(i) * 4], &string, 4);
        }
        column.bytes = std::move(bytes);
    } else {
        column.bytes = source.raw<std::byte>(std::size_t(column.count) * byteSize(type));
    }
    if (source.coin()) {
        std::vector<std::uint32_t> locations(column.count);
        for (auto& location : locations) location = source.coin() ? kNoString : source.below(strings);
        column.locations = std::move(locations);
    }
    return column;
}

/// Every optional column is there or not by chance; user columns have every type in both scopes.
inline PathColumns randomColumns(Source& source, Index paths) {
    PathColumns c;
    const std::uint32_t strings = 1 + source.below(9);
    for (std::uint32_t i = 0; i < strings; ++i) c.strings.push_back(source.text());
    std::vector<Pixel> pixels;
    std::vector<std::int64_t> samples;
    std::vector<std::int32_t> parts, depths;
    std::vector<Index> firstVertex;
    std::vector<std::uint8_t> vertexFlags;
    std::int64_t sample = -5;
    for (Index path = 0; path < paths; ++path) {
        pixels.push_back({path / 7, 3});
        samples.push_back(sample += 1 + source.below(3));
        parts.push_back(static_cast<std::int32_t>(source.below(4)));
        firstVertex.push_back(static_cast<Index>(depths.size()));
        const std::uint32_t vertices = source.below(6);
        for (std::uint32_t v = 0; v < vertices; ++v) {
            depths.push_back(static_cast<std::int32_t>(2 * v));
            vertexFlags.push_back(static_cast<std::uint8_t>(source.below(64)));
        }
    }
    const auto m = static_cast<Index>(depths.size());
    if (paths > 0) firstVertex.push_back(m);
    std::vector<std::uint8_t> pathFlags(paths, PathFlag::hasOrigin | PathFlag::hasEstimate);
    c.origins = source.raw<Vec3f>(paths);
    c.estimates = source.raw<Color>(paths);
    if (source.coin()) {
        c.origins = {};
        for (auto& flags : pathFlags) flags = PathFlag::hasEstimate;
    }
    c.positions = source.raw<Vec3f>(m);
    c.vertexEstimates = source.raw<Color>(m);
    c.emissions = source.raw<Color>(m);
    c.meshes = source.raw<std::int32_t>(m);
    c.faces = source.raw<std::int32_t>(m);
    c.events = source.numbersBelow(kEventCount, m);
    c.lobes = source.numbersBelow(kLobeCount, m);
    std::vector<std::uint32_t> labels(m);
    for (auto& label : labels) label = source.coin() ? kNoString : source.below(strings);
    c.labels = std::move(labels);
    if (m > 0) {
        const std::size_t next = source.below(3 * m), contributions = source.below(2 * m);
        c.nextEventOwners = source.owners(next, m);
        c.nextEvents = source.raw<NextEvent>(next);
        c.contributionOwners = source.owners(contributions, m);
        std::vector<Contribution> list = source.raw<Contribution>(contributions);
        for (Contribution& contribution : list) {
            contribution.technique = source.below(strings);
            contribution.end = static_cast<LightEnd>(source.below(kLightEndCount));
        }
        c.contributions = std::move(list);
    }
    if (paths > 0) {
        const std::size_t splats = source.below(2 * paths);
        c.splatOwners = source.owners(splats, paths);
        c.splats = source.raw<Splat>(splats);
    }
    for (const Scope scope : {Scope::path, Scope::vertex}) {
        for (std::size_t type = 0; type < kValueTypeCount; ++type) {
            const std::string name = std::string("key ") + static_cast<char>('a' + type);
            c.columns.push_back(randomColumn(source, name, scope, static_cast<ValueType>(type), scope == Scope::path ? paths : m, strings));
        }
    }
    c.pixels = std::move(pixels);
    c.samples = std::move(samples);
    c.parts = std::move(parts);
    c.pathFlags = std::move(pathFlags);
    c.firstVertex = std::move(firstVertex);
    c.depths = std::move(depths);
    c.vertexFlags = std::move(vertexFlags);
    return c;
}

inline PathSet randomPaths(std::uint64_t seed, Index paths) {
    Source source(seed);
    auto set = PathSet::make(randomColumns(source, paths));
    return set ? std::move(set).value() : PathSet();
}

inline TraceResult traceResult(std::uint64_t seed, Index paths) {
    TraceResult result;
    result.pixels = {{0, 3}, {1, 3}};
    result.replays = {{Verdict::close, SumCheck::matches, {1, 2, 3}, {4, 5, 6}}, {}};
    result.settings = {64, "path", "sobol", 77, true};
    result.renderId = 9;
    result.stats = {1, 2, 3, 4, 5};
    result.renderSeconds = 0.25;
    result.matches = MatchCounts{64, 5, 1, 3, {"pdf"}, std::vector<std::uint32_t>{2, 3}, std::vector<Color>{{1, 2, 3}, {4, 5, 6}}};
    result.paths = randomPaths(seed, paths);
    return result;
}

/// One of every kind, every field filled.
inline std::vector<Message> everyMessage() {
    const Settings settings{16, "path", "independent", 0x123456789abcdef0u, true};
    Camera camera;
    camera.kind = CameraKind::spherical;
    camera.position = {1, 2, 3};
    camera.apertureRadius = 0.125f;
    camera.rightHanded = false;
    const Layer density{{"hits", LayerKind::density, "1/m^2", "Adds 1 at each hit."}, 17, 17};
    const Layer radiance{{"radiance", LayerKind::meanColor, "W/(sr m^2)", ""}, 1ull << 40, -0.5};
    const SurfaceCounts counts{1ull << 33, 2, 3, 4, 5, 1ull << 32};
    Info info{"renderer", "scene", "path", "sobol", 640, 480, 64, 5, true, true, 1u << 20, 12, 4096, 100, 1u << 30, {"a", "b"}, {"tool"}, 3,
              {density, radiance}, 2, {radiance}, 1ull << 32};
    MeshPart part{2, "mesh", "glass", Color(0.25f), Color(7), 3, 1, 0, 0, std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                  std::vector<Triangle>{{0, 1, 2}}};
    TraceRequest trace{{{1, 2}, {3, 4}}, {5, 6, 7, 8}, settings, Against::givenColors, 11, std::vector<Color>{{1, 2, 3}, {4, 5, 6}},
                       {"position", "pdf"}, "depth > 2", 1u << 20, true};
    const std::vector<std::byte> bytes{std::byte{1}, std::byte{2}, std::byte{3}};
    const Error error{ErrorCode::pixelOutOfRange, "Pixel (9, 9) is outside."};
    std::vector<Body> bodies{Hello{"client 1", 1, 3, {"x"}, "token"}, Welcome{"server 1", 1, {"y"}, 1u << 24}, Refusal{error, 1, 2},
                             Cancel{}, Progress{0.5f, true}, Failure{error}, Done{}, InfoRequest{}, info, CameraRequest{}, camera,
                             SceneRequest{1u << 20}, SceneChunk{3, 9, 4, {part, part}, true}, RenderRequest{settings, true, 1u << 20, {"hits", "radiance"}, 1ull << 33},
                             PreviewTile{{0, 0, 2, 1}, std::vector<Color>{{1, 2, 3}, {4, 5, 6}}}, RenderResult{8, settings, 1.5, 2, 1, {density}, counts, 99},
                             ImageRows{0, 1, std::vector<Color>(2), std::vector<float>{4, 5}, std::vector<Color>(2), true}, trace,
                             traceResult(1, 5), SurfaceRequest{{"density"}, settings, 5, 8, 1u << 20}, ToolRequest{"tool", bytes}, ToolResult{bytes},
                             QuitRequest{}, SurfaceResult{8, {density, radiance}, counts, 2, 9, 2},
                             SurfaceChunk{{{0, 2, 5, 2, 0, std::vector<std::uint8_t>{0x21}}, {1, 4, 4, 0, 0, {}}},
                                          {{0, 0, std::vector<float>{1, 0, 2}}, {2, 24, std::vector<float>{0.5f, -1, 3}}}, true}};
    std::vector<Message> messages;
    for (Body& body : bodies) messages.push_back({messages.size() * 1000003, std::move(body)});
    return messages;
}

}  // namespace emca::protocol::test
