#include "scene_test_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>

namespace emca::explorer::testing {
namespace {

void addQuad(Mesh& mesh, Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3f& p : {a, b, c, d}) mesh.positions.push_back(p);
    mesh.triangles.push_back({base, base + 1, base + 2});
    mesh.triangles.push_back({base, base + 2, base + 3});
}

Mesh quad(std::string name, Color diffuse, Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    Mesh mesh;
    mesh.name = mesh.material = std::move(name);
    mesh.diffuse = diffuse;
    addQuad(mesh, a, b, c, d);
    return mesh;
}

Mesh block(Vec3f centre, Vec3f half, float angle, Color diffuse) {
    Mesh mesh;
    mesh.name = "block";
    mesh.diffuse = diffuse;
    const Vec3f x{half.x * std::cos(angle), 0, half.x * std::sin(angle)}, z{-half.z * std::sin(angle), 0, half.z * std::cos(angle)},
        y{0, half.y, 0};
    const auto at = [&](float sx, float sy, float sz) { return centre + x * sx + y * sy + z * sz; };
    addQuad(mesh, at(-1, -1, 1), at(1, -1, 1), at(1, 1, 1), at(-1, 1, 1));
    addQuad(mesh, at(1, -1, -1), at(-1, -1, -1), at(-1, 1, -1), at(1, 1, -1));
    addQuad(mesh, at(1, -1, 1), at(1, -1, -1), at(1, 1, -1), at(1, 1, 1));
    addQuad(mesh, at(-1, -1, -1), at(-1, -1, 1), at(-1, 1, 1), at(-1, 1, -1));
    addQuad(mesh, at(-1, 1, 1), at(1, 1, 1), at(1, 1, -1), at(-1, 1, -1));
    addQuad(mesh, at(-1, -1, -1), at(1, -1, -1), at(1, -1, 1), at(-1, -1, 1));
    return mesh;
}

Mesh ball(Vec3f centre, float radius, Color diffuse) {
    Mesh mesh;
    mesh.name = "ball";
    mesh.diffuse = diffuse;
    constexpr std::uint32_t kAround = 32, kDown = 16;
    for (std::uint32_t i = 0; i <= kDown; ++i)
        for (std::uint32_t j = 0; j < kAround; ++j) {
            const float theta = std::numbers::pi_v<float> * float(i) / kDown, phi = 2 * std::numbers::pi_v<float> * float(j) / kAround;
            mesh.positions.push_back(centre + Vec3f{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)} * radius);
        }
    for (std::uint32_t i = 0; i < kDown; ++i)
        for (std::uint32_t j = 0; j < kAround; ++j) {
            const std::uint32_t a = i * kAround + j, b = i * kAround + (j + 1) % kAround, c = a + kAround, d = b + kAround;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({b, d, c});
        }
    return mesh;
}

struct Hit { float t = 0; std::int32_t mesh = 0, face = 0; Vec3f position, normal; };

/// Moeller and Trumbore 1997, over all triangles.
std::optional<Hit> closest(const std::vector<Mesh>& meshes, Vec3f o, Vec3f d, float maximum) {
    std::optional<Hit> best;
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (std::size_t f = 0; f < meshes[m].triangles.size(); ++f) {
            const Triangle& t = meshes[m].triangles[f];
            const Vec3f a = meshes[m].positions[t[0]], e1 = meshes[m].positions[t[1]] - a, e2 = meshes[m].positions[t[2]] - a;
            const Vec3f p = cross(d, e2);
            const float det = dot(e1, p);
            if (std::abs(det) < 1e-12f) continue;
            const Vec3f s = o - a;
            const float u = dot(s, p) / det;
            const Vec3f q = cross(s, e1);
            const float v = dot(d, q) / det, hit = dot(e2, q) / det;
            if (u < 0 || v < 0 || u + v > 1 || hit < 1e-4f || hit > maximum) continue;
            maximum = hit;
            best = Hit{hit, std::int32_t(m), std::int32_t(f), o + d * hit, normalize(cross(e1, e2))};
        }
    return best;
}

/// Collects columns in order.
struct Builder {
    std::vector<Pixel> pixels;
    std::vector<std::int64_t> samples;
    std::vector<std::int32_t> parts, depths, meshes, faces;
    std::vector<std::uint8_t> pathFlags, vertexFlags, events, lobes;
    std::vector<Vec3f> origins, positions;
    std::vector<Color> estimates, emissions;
    std::vector<Index> firstVertex{0}, nextEventOwners;
    std::vector<NextEvent> nextEvents;

    void beginPath(Vec3f origin) {
        pixels.push_back({12, 34});
        samples.push_back(std::int64_t(samples.size()));
        parts.push_back(0);
        pathFlags.push_back(PathFlag::hasOrigin | PathFlag::hasEstimate);
        origins.push_back(origin);
        estimates.push_back({});
    }
    void vertex(std::int32_t depth, Vec3f p, std::uint8_t flags, std::int32_t mesh, std::int32_t face, Color emission, Event event) {
        depths.push_back(depth);
        positions.push_back(p);
        vertexFlags.push_back(static_cast<std::uint8_t>(flags | VertexFlag::hasPosition));
        meshes.push_back(mesh);
        faces.push_back(face);
        emissions.push_back(emission);
        events.push_back(static_cast<std::uint8_t>(event));
        lobes.push_back(static_cast<std::uint8_t>(event == Event::reflect ? Lobe::diffuse : Lobe::none));
        if (!isBlack(emission)) estimates.back() = emission;
    }
    void endPath() { firstVertex.push_back(static_cast<Index>(depths.size())); }
    PathSet finish() {
        PathColumns c;
        c.pixels = std::move(pixels);
        c.samples = std::move(samples);
        c.parts = std::move(parts);
        c.pathFlags = std::move(pathFlags);
        c.origins = std::move(origins);
        c.estimates = std::move(estimates);
        c.firstVertex = std::move(firstVertex);
        c.depths = std::move(depths);
        c.vertexFlags = std::move(vertexFlags);
        c.positions = std::move(positions);
        c.emissions = std::move(emissions);
        c.meshes = std::move(meshes);
        c.faces = std::move(faces);
        c.events = std::move(events);
        c.lobes = std::move(lobes);
        c.labels = std::vector<std::uint32_t>(c.depths.size(), kNoString);
        c.nextEventOwners = std::move(nextEventOwners);
        c.nextEvents = std::move(nextEvents);
        auto made = PathSet::make(std::move(c));
        if (!made) std::fprintf(stderr, "test data: %s\n", made.error().message.c_str());
        return made ? std::move(made).value() : PathSet();
    }
};

Vec3f cosineDirection(Vec3f n, float u, float v) {
    const Vec3f helper = std::abs(n.x) < 0.9f ? Vec3f{1, 0, 0} : Vec3f{0, 1, 0};
    const Vec3f t = normalize(cross(helper, n)), b = cross(n, t);
    const float r = std::sqrt(u), phi = 2 * std::numbers::pi_v<float> * v;
    return normalize(t * (r * std::cos(phi)) + b * (r * std::sin(phi)) + n * std::sqrt(std::max(0.f, 1 - u)));
}

}  // namespace

std::vector<Mesh> roomMeshes() {
    const Color white{0.72f, 0.71f, 0.68f};
    std::vector<Mesh> meshes{
        quad("floor", white, {-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}),
        quad("ceiling", white, {-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}),
        quad("back", white, {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}),
        quad("left", {0.63f, 0.06f, 0.05f}, {-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}),
        quad("right", {0.14f, 0.45f, 0.09f}, {1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}),
        block({-0.38f, -0.4f, -0.3f}, {0.29f, 0.6f, 0.29f}, 0.3f, white),
        ball({0.42f, -0.6f, 0.25f}, 0.4f, {0.35f, 0.5f, 0.7f}),
        quad("light", white, {-0.3f, 0.985f, -0.25f}, {0.3f, 0.985f, -0.25f}, {0.3f, 0.985f, 0.25f}, {-0.3f, 0.985f, 0.25f}),
    };
    meshes.back().emission = {17, 12, 4};
    return meshes;
}

Camera roomCamera() {
    Camera camera;
    camera.position = {0, 0, 4.4f};
    camera.direction = {0, 0, -1};
    camera.up = {0, 1, 0};
    camera.verticalFieldOfView = 38;
    return camera;
}

PathSet roomPaths(std::uint32_t paths, std::uint32_t maximumDepth, float spread, bool closed) {
    const std::vector<Mesh> meshes = roomMeshes();
    std::vector<Mesh> walls = meshes;
    if (closed) walls.push_back(quad("front", Color(0.7f), {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}));
    const auto light = static_cast<std::int32_t>(meshes.size() - 1);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    Builder builder;
    for (std::uint32_t i = 0; i < paths; ++i) {
        Vec3f o = roomCamera().position;
        Vec3f d = normalize(Vec3f{0.085f + spread * uniform(random), -0.075f + spread * uniform(random), -1});
        builder.beginPath(o);
        for (std::uint32_t depth = 1; depth <= maximumDepth; ++depth) {
            const auto hit = closest(depth == 1 ? meshes : walls, o, d, 1e30f);   // the eye looks in from outside
            if (!hit) {
                builder.vertex(std::int32_t(depth), o + d * 1000.f, VertexFlag::environment, 0, 0, {}, Event::background);
                break;
            }
            const bool shines = hit->mesh == light;
            builder.vertex(std::int32_t(depth), hit->position, VertexFlag::hasSurface | VertexFlag::hasEvent | VertexFlag::hasEmission,
                           hit->mesh, hit->face, shines ? meshes[std::size_t(light)].emission : Color{}, shines ? Event::emission : Event::reflect);
            if (shines && !closed) break;
            const Vec3f n = dot(hit->normal, d) < 0 ? hit->normal : -hit->normal;
            const Vec3f sample{-0.3f + 0.6f * uniform(random), 0.985f, -0.25f + 0.5f * uniform(random)};
            const Vec3f way = sample - hit->position;
            const auto blocker = closest(meshes, hit->position, normalize(way), length(way) - 1e-3f);
            builder.nextEventOwners.push_back(static_cast<Index>(builder.depths.size() - 1));
            builder.nextEvents.push_back({sample, blocker || dot(n, way) <= 0 ? 0u : 1u});
            o = hit->position;
            const float u = uniform(random), v = uniform(random);
            d = cosineDirection(n, u, v);
        }
        builder.endPath();
    }
    return builder.finish();
}

PathSet pathOf(Vec3f origin, const std::vector<Vec3f>& points, const std::vector<NextEvent>& nextEventsAtFirst) {
    Builder builder;
    builder.beginPath(origin);
    for (std::size_t i = 0; i < points.size(); ++i)
        builder.vertex(std::int32_t(i + 1), points[i], 0, 0, 0, {}, Event::none);
    builder.endPath();
    for (const NextEvent& e : nextEventsAtFirst) {
        builder.nextEventOwners.push_back(0);
        builder.nextEvents.push_back(e);
    }
    return builder.finish();
}

std::shared_ptr<const client::Trace> traceOf(PathSet paths) {
    auto trace = std::make_shared<client::Trace>();
    trace->pixels = {{12, 34}};
    trace->replays.resize(1);
    trace->samplesPerPixel = paths.pathCount();
    trace->paths = std::move(paths);
    return trace;
}

void fillRoom(client::Dataset& dataset, PathSet paths) {
    client::Dataset::Transaction transaction(dataset);
    client::ServerInfo info;
    info.width = 640;
    info.height = 480;
    dataset.setInfo(info);
    dataset.setCamera(roomCamera());
    dataset.setMeshes(std::make_shared<const std::vector<Mesh>>(roomMeshes()));
    if (!paths.empty()) dataset.addTrace(traceOf(std::move(paths)));
}

Mesh waves(std::uint32_t triangles) {
    Mesh mesh;
    mesh.name = "waves";
    const auto n = static_cast<std::uint32_t>(std::ceil(std::sqrt(triangles / 2.0)));
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) {
            const float u = float(x) / float(n), v = float(y) / float(n);
            mesh.positions.push_back({2 * u - 1, -0.8f + 0.1f * std::sin(30 * u) * std::cos(23 * v), 2 * v - 1});
        }
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, d});
        }
    return mesh;
}

}  // namespace emca::explorer::testing
