#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "emca/core/seed_map.h"
#include "emca/probe/light_probe.h"
#include "emca/recorder/recorder.h"
#include "emca/recorder/surface_recorder.h"
#include "emca/server/renderer.h"
#include "emca/server/server_tool.h"

namespace emca::test {

/// What a renderer, its adapter or its machine can do wrong.
enum class Fault {
    none, nameless, notDeterministicAndSaysSo, randomImage, nanPixels, blackImage, ignoresSamples,
    differentReplay, closeReplay, throwsInPixel, throwsInImage, throwsForSomePixels, renderFails,
    wrongEstimates, noFinalEstimates, missingPaths, samePathIndex, depthGaps, valuesBeforePath, noRecording,
    nanData, infiniteData, nanPosition, nanNextEvent,
    meshBeyond, faceBeyond, offSurface, slightlyOff, meshesShifted,
    stateFromPixelToPixel, seedsFromSampleCount, sharedState,
    nanMesh, badIndices, emptyMesh, duplicateMesh, degenerateMeshes, noMeshes, unsteadyMeshes,
    cameraNotUnit, cameraNotOrthogonal, cameraNan, nearBeyondFar, fieldOfViewOutOfRange, cameraFarAway, cameraLooksAway, cameraMirrored, fieldOfViewOfTheWidth,
    cameraElsewhere, layersChangeImage, layersEmpty, layersInfinite, layersOffTheMeshes, probeRandom, probeGarbage,
    acceptsAnyIntegrator, grunts, ignoresCancel, slowReplay,
};

/// A small room with a ball and a lamp, path traced and recorded with all that there is to record; everything about it is
/// right but for one fault. Deterministic and concurrent.
class RoomRenderer : public Renderer {
  public:
    static constexpr std::uint32_t kWidth = 24, kHeight = 18, kSamples = 8;
    static constexpr int kRings = 16, kSegments = 32, kBounces = 5;

    explicit RoomRenderer(Fault fault = Fault::none) : fault_(fault) {
        addQuad("floor", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, {});
        addQuad("wall", {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, {});
        addQuad("lamp", {-0.7f, 2.9f, -0.7f}, {1.4f, 0, 0}, {0, 0, 1.4f}, Color(8, 7, 6));
        addBall();
    }

    RendererInfo info() const override {
        RendererInfo info;
        info.renderer = fault_ == Fault::nameless ? "" : "room 1.0";
        info.scene = "room";
        info.width = kWidth;
        info.height = kHeight;
        info.samplesPerPixel = kSamples;
        info.integrator = "path";
        info.sampler = "hash";
        info.concurrent = true;
        info.deterministic = fault_ != Fault::notDeterministicAndSaysSo;
        return info;
    }

    Camera camera() const override {
        Camera camera = trueCamera();
        switch (fault_) {
            case Fault::cameraNotUnit: camera.direction = camera.direction * 2.f; break;
            case Fault::cameraNotOrthogonal: camera.up = {0, 1, 0}; break;
            case Fault::cameraNan: camera.position.y = std::nanf(""); break;
            case Fault::nearBeyondFar: std::swap(camera.nearClip, camera.farClip); break;
            case Fault::fieldOfViewOutOfRange: camera.verticalFieldOfView = 200; break;
            case Fault::cameraFarAway: camera.position = camera.position * 1000.f; break;
            case Fault::cameraLooksAway: camera.direction = -camera.direction; break;
            case Fault::cameraMirrored: camera.rightHanded = false; break;
            case Fault::fieldOfViewOfTheWidth: camera.verticalFieldOfView = 64.01f; break;
            case Fault::cameraElsewhere: camera.position.x += 1; break;
            default: break;
        }
        return camera;
    }

    std::vector<Mesh> meshes() const override {
        std::vector<Mesh> meshes = meshes_;
        switch (fault_) {
            case Fault::nanMesh: meshes[0].positions[2].y = std::nanf(""); break;
            case Fault::badIndices: meshes[1].triangles[1][2] = 77; break;
            case Fault::emptyMesh: meshes.emplace_back(); break;
            case Fault::duplicateMesh: meshes.push_back(meshes[2]); break;
            case Fault::degenerateMeshes:
                for (Triangle& t : meshes[3].triangles) t[1] = t[0];
                break;
            case Fault::noMeshes: meshes.clear(); break;
            case Fault::unsteadyMeshes:
                if (calls_++ > 0) meshes.pop_back();
                break;
            case Fault::meshesShifted:
                for (Vec3f& p : meshes[0].positions) p.y += 0.5f;
                break;
            default: break;
        }
        return meshes;
    }

    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override {
        return render(settings, monitor, nullptr, fault_ == Fault::notDeterministicAndSaysSo || fault_ == Fault::randomImage ? ++salt_ : 0);
    }

    std::vector<LayerDescription> surfaceLayers() const override {
        return {{"intersections", LayerKind::density, "1/unit^2", "Adds 1 for each intersection."}, {"pdf", LayerKind::mean, "1/sr", "Adds the density of the next direction."}};
    }
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface, RequestMonitor& monitor) override {
        return render(settings, monitor, &surface, fault_ == Fault::layersChangeImage ? 1 : 0);
    }

    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor&) override {
        if (fault_ == Fault::throwsInPixel) throw std::runtime_error("out of caffeine");
        if (fault_ == Fault::throwsForSomePixels && (pixel.x + pixel.y) % 8 == 0) throw std::runtime_error("no such pixel");
        if (auto refused = refuse(settings)) return *refused;
        const int others = inside_++;
        std::uint64_t salt = fault_ == Fault::differentReplay || fault_ == Fault::notDeterministicAndSaysSo ? 5 : 0;
        if (fault_ == Fault::sharedState) {
            if (others > 0 || rendering_) salt = 9;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            if (inside_ > 1 || rendering_) salt = 9;
        }
        if (fault_ == Fault::slowReplay) renderAllOfIt(settings);
        Color value = pixelValue(pixel, settings, nullptr, salt);
        if (fault_ == Fault::closeReplay) value = value * 1.00001f;
        --inside_;
        return value;
    }

    Result<std::vector<Color>> renderPixels(const std::vector<Pixel>& pixels, const RenderSettings& settings, Recording& recording, RequestMonitor& monitor) override {
        if (fault_ != Fault::stateFromPixelToPixel) return Renderer::renderPixels(pixels, settings, recording, monitor);
        if (auto refused = refuse(settings)) return *refused;
        std::vector<Color> values;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const RecordScope scope(recording, pixels[i]);
            values.push_back(pixelValue(pixels[i], settings, nullptr, i));
        }
        return values;
    }

    /// For the light probe of the same scene.
    Color radiance(Vec3f origin, Vec3f direction, std::uint64_t seed) const {
        std::mt19937_64 random(mix64(seed));
        return trace({origin, direction}, random, nullptr);
    }

  private:
    struct Ray { Vec3f origin, direction; };
    struct Hit { float distance = std::numeric_limits<float>::infinity(); std::int32_t mesh = -1, face = -1; Vec3f normal; };
    /// Layers while an image is rendered with them.
    struct Layers { SurfaceCursor* cursor; SurfaceLayer intersections, pdf; };

    static Camera trueCamera() {
        Camera camera;
        camera.position = {0.3f, 1.6f, 6};
        camera.direction = normalize(Vec3f{-0.05f, -0.05f, -1});
        camera.up = normalize(cross(cross(camera.direction, Vec3f{0, 1, 0}), camera.direction));
        camera.verticalFieldOfView = 50.2f;
        return camera;
    }
    static float uniform(std::mt19937_64& random) { return static_cast<float>(random() >> 40) * 0x1p-24f; }

    void addQuad(const char* name, Vec3f corner, Vec3f u, Vec3f v, Color emission) {
        Mesh mesh;
        mesh.name = name;
        mesh.positions = {corner, corner + u, corner + u + v, corner + v};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        mesh.emission = emission;
        meshes_.push_back(mesh);
    }
    /// Traced as a sphere, shown as triangles.
    void addBall() {
        Mesh mesh;
        mesh.name = "ball";
        for (int r = 0; r <= kRings; ++r)
            for (int s = 0; s <= kSegments; ++s) {
                const double theta = M_PI * r / kRings, phi = 2 * M_PI * s / kSegments;
                const Vec3d on{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
                mesh.positions.push_back(kBall + kRadius * Vec3f{static_cast<float>(on.x), static_cast<float>(on.y), static_cast<float>(on.z)});
            }
        for (int r = 0; r < kRings; ++r)
            for (int s = 0; s < kSegments; ++s) {
                const auto a = static_cast<std::uint32_t>(r * (kSegments + 1) + s), b = a + 1, c = a + kSegments + 1, d = c + 1;
                mesh.triangles.push_back({a, b, c});
                mesh.triangles.push_back({b, d, c});
            }
        meshes_.push_back(mesh);
    }
    static std::int32_t ballFace(Vec3f normal) {
        const double theta = std::acos(std::clamp(static_cast<double>(normal.y), -1.0, 1.0)) / M_PI * kRings;
        double phi = std::atan2(static_cast<double>(normal.z), static_cast<double>(normal.x)) / (2 * M_PI) * kSegments;
        if (phi < 0) phi += kSegments;
        const int r = std::min(static_cast<int>(theta), kRings - 1), s = std::min(static_cast<int>(phi), kSegments - 1);
        const bool lower = (theta - r) + (phi - s) > 1;
        return 2 * (r * kSegments + s) + (lower || r == 0 ? 1 : 0);
    }

    void hitBall(const Ray& ray, Hit& hit) const {
        const Vec3f to = ray.origin - kBall;
        const float b = dot(to, ray.direction), root = b * b - dot(to, to) + kRadius * kRadius;
        if (root < 0) return;
        for (const float t : {-b - std::sqrt(root), -b + std::sqrt(root)})
            if (t > 1e-4f && t < hit.distance) {
                const Vec3f normal = normalize(ray.origin + t * ray.direction - kBall);
                hit = {t, 3, ballFace(normal), normal};
                return;
            }
    }
    void hitQuads(const Ray& ray, Hit& hit) const {
        for (std::int32_t m = 0; m < 3; ++m) {
            const std::vector<Vec3f>& p = meshes_[m].positions;
            const Vec3f u = p[1] - p[0], v = p[3] - p[0], normal = normalize(cross(u, v));
            const float facing = dot(normal, ray.direction);
            if (facing == 0) continue;
            const float t = dot(p[0] - ray.origin, normal) / facing;
            if (!(t > 1e-4f && t < hit.distance)) continue;
            const Vec3f at = ray.origin + t * ray.direction - p[0];
            const float a = dot(at, u) / dot(u, u), b = dot(at, v) / dot(v, v);
            if (a < 0 || a > 1 || b < 0 || b > 1) continue;
            hit = {t, m, a >= b ? 0 : 1, normal};
        }
    }
    Hit intersect(const Ray& ray) const {
        Hit hit;
        hitQuads(ray, hit);
        hitBall(ray, hit);
        return hit;
    }

    std::optional<Error> refuse(const RenderSettings& settings) const {
        if (settings.integrator.empty() || settings.integrator == "path" || fault_ == Fault::acceptsAnyIntegrator) return std::nullopt;
        if (fault_ == Fault::grunts) return Error{ErrorCode::invalidArgument, "no"};
        return Error{ErrorCode::invalidArgument, "There is no integrator \"" + settings.integrator + "\" here, only \"path\"."};
    }

    Result<RenderedImage> render(const RenderSettings& settings, RequestMonitor& monitor, SurfaceRecorder* surface, std::uint64_t salt) {
        if (auto refused = refuse(settings)) return *refused;
        if (fault_ == Fault::throwsInImage) throw std::runtime_error("out of paint");
        if (fault_ == Fault::renderFails) return Error{ErrorCode::rendererFailed, "The film has no frame."};
        ++rendering_;
        // Long enough that others surely come meanwhile.
        if (fault_ == Fault::sharedState) std::this_thread::sleep_for(std::chrono::milliseconds(60));
        RenderedImage image;
        image.color = Image(kWidth, kHeight);
        Layers layers{};
        if (fault_ == Fault::layersEmpty) surface = nullptr;
        if (surface) layers = {&surface->cursor(), surface->find("intersections"), surface->find("pdf")};
        for (std::uint32_t y = 0; y < kHeight; ++y)
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                if (monitor.cancelled() && fault_ != Fault::ignoresCancel) {
                    --rendering_;
                    return Error{ErrorCode::cancelled, "The render was cancelled."};
                }
                image.color.setColor({x, y}, pixelValue({x, y}, settings, surface ? &layers : nullptr, salt));
            }
        if (fault_ == Fault::nanPixels) image.color.setColor({3, 4}, Color(std::nanf("")));
        if (fault_ == Fault::blackImage) image.color = Image(kWidth, kHeight);
        --rendering_;
        return image;
    }

    /// The image, several times, for one pixel; in a thread of its own, so that nothing of it is recorded.
    void renderAllOfIt(const RenderSettings& settings) const {
        std::thread([&] {
            for (std::uint32_t i = 0; i < 6 * kWidth * kHeight; ++i) pixelValue({i % kWidth, i / kWidth % kHeight}, settings, nullptr, 0);
        }).join();
    }

    Color pixelValue(Pixel pixel, const RenderSettings& settings, const Layers* layers, std::uint64_t salt) const {
        const std::uint32_t samples = fault_ == Fault::ignoresSamples ? 3 : settings.samplesPerPixel;
        const std::uint64_t count = fault_ == Fault::seedsFromSampleCount ? samples : 0;
        const SeedMap seeds(settings.seed + 1000 * salt + 77 * count);
        const Camera camera = trueCamera();
        const float scale = std::tan(camera.verticalFieldOfView * 0.5f * 0.0174532925f);
        PathRecorder& emca = recorder();
        if (fault_ == Fault::valuesBeforePath) emca.addPathData("early", 1);
        Color sum;
        for (std::uint32_t i = 0; i < samples; ++i) {
            std::mt19937_64 random(seeds.seed(pixel, i));
            const bool recorded = fault_ != Fault::noRecording && !(fault_ == Fault::missingPaths && i % 2 == 1);
            if (recorded) emca.setPathIndex(fault_ == Fault::samePathIndex ? 0 : i);
            const float x = (2 * (static_cast<float>(pixel.x) + uniform(random)) / kWidth - 1) * scale * kWidth / kHeight;
            const float y = (1 - 2 * (static_cast<float>(pixel.y) + uniform(random)) / kHeight) * scale;
            const Ray ray{camera.position, normalize(camera.direction + x * cross(camera.direction, camera.up) + y * camera.up)};
            if (recorded) emca.setPathOrigin(ray.origin);
            const Color value = trace(ray, random, layers, recorded);
            if (recorded && fault_ != Fault::noFinalEstimates) emca.setFinalEstimate(fault_ == Fault::wrongEstimates ? value * 0.5f : value);
            sum += value;
        }
        return sum / static_cast<float>(samples);
    }

    Color trace(Ray ray, std::mt19937_64& random, const Layers* layers, bool recorded = true) const {
        PathRecorder& emca = recorder();
        Color radiance, throughput(1.f);
        for (int bounce = 1; bounce <= kBounces; ++bounce) {
            const Hit hit = intersect(ray);
            if (recorded) emca.setDepthIndex(fault_ == Fault::depthGaps ? 2 * bounce - 1 : bounce);
            if (hit.mesh < 0) {
                const Color sky(0.1f, 0.12f, 0.15f);
                radiance += throughput * sky;
                if (recorded) {
                    emca.setIntersectionPosEnvmap(ray.origin + 10.f * ray.direction);
                    emca.setIntersectionEmission(sky);
                    emca.setIntersectionEstimate(radiance);
                }
                break;
            }
            const Vec3f position = ray.origin + hit.distance * ray.direction;
            const Vec3f normal = dot(hit.normal, ray.direction) > 0 ? -hit.normal : hit.normal;
            radiance += throughput * meshes_[hit.mesh].emission;
            if (recorded) record(hit, position, normal, radiance, random);
            const float z = 1 - 2 * uniform(random), phi = 6.2831853f * uniform(random), r = std::sqrt(std::max(0.f, 1 - z * z));
            const Vec3f direction = normalize(normal + Vec3f{r * std::cos(phi), r * std::sin(phi), z} * 0.9999f);
            const float pdf = dot(direction, normal) / 3.14159265f;
            throughput *= Color(0.7f);
            if (recorded) {
                emca.addIntersectionData("pdf", fault_ == Fault::nanData && bounce == 2 ? std::nanf("") : fault_ == Fault::infiniteData ? INFINITY : pdf);
                emca.addIntersectionData("throughput", throughput);
            }
            if (layers) collect(*layers, hit, position, pdf);
            ray = {position, direction};
        }
        return radiance;
    }

    void record(const Hit& hit, Vec3f position, Vec3f normal, Color radiance, std::mt19937_64&) const {
        PathRecorder& emca = recorder();
        Vec3f shown = position;
        if (fault_ == Fault::offSurface) shown = position + 0.2f * normal;
        if (fault_ == Fault::slightlyOff) shown = position + 0.001f * normal;
        if (fault_ == Fault::nanPosition && hit.mesh == 1) shown.x = std::nanf("");
        emca.setIntersectionPos(shown);
        emca.setIntersectionSurface(fault_ == Fault::meshBeyond ? 4 : hit.mesh, fault_ == Fault::faceBeyond && hit.mesh == 0 ? 2 : hit.face);
        emca.setIntersectionEvent(Event::reflect, Lobe::diffuse);
        emca.setIntersectionEmission(meshes_[hit.mesh].emission);
        emca.setIntersectionEstimate(radiance);
        emca.setNextEventEstimationPos(fault_ == Fault::nanNextEvent ? Vec3f{std::nanf(""), 0, 0} : Vec3f{0, 2.9f, 0}, true);
    }

    void collect(const Layers& layers, const Hit& hit, Vec3f position, float pdf) const {
        const SurfacePoint at = layers.cursor->locate(fault_ == Fault::layersOffTheMeshes ? 9 : hit.mesh, static_cast<std::uint32_t>(hit.face), position);
        layers.intersections.add(at);
        layers.pdf.add(at, fault_ == Fault::layersInfinite ? INFINITY : pdf);
    }

    static constexpr Vec3f kBall{0.5f, 0.8f, 0};
    static constexpr float kRadius = 0.8f;
    const Fault fault_;
    std::vector<Mesh> meshes_;
    mutable std::atomic<int> calls_{0};
    std::atomic<int> inside_{0}, rendering_{0};
    std::atomic<std::uint64_t> salt_{0};
};

/// The room's light probe.
class RoomProbe : public ServerTool {
  public:
    RoomProbe(const RoomRenderer& room, Fault fault) : room_(room), fault_(fault) {}
    std::string name() const override { return probe::kLightProbeTool; }
    bool observesReplay() const override { return false; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> bytes, RequestMonitor&) override {
        if (fault_ == Fault::probeGarbage) return std::vector<std::byte>(40, std::byte(7));
        const auto request = probe::decodeRequest(bytes);
        if (!request) return request.error();
        probe::LightProbe answer;
        answer.map = probe::SphereMap(request->frame, request->width, request->height);
        answer.samplesPerPixel = request->samplesPerPixel;
        answer.image = Image(request->width, request->height, probe::probeChannels());
        const std::uint64_t salt = fault_ == Fault::probeRandom ? ++calls_ : 0;
        for (std::uint32_t y = 0; y < request->height; ++y)
            for (std::uint32_t x = 0; x < request->width; ++x) {
                const std::uint64_t seed = mix64(request->seed + salt) + y * 4096 + x;
                answer.image.setColor({x, y}, room_.radiance(request->position, answer.map.sample({x, y}, {0.5f, 0.5f}), seed));
            }
        return probe::encode(answer);
    }

  private:
    const RoomRenderer& room_;
    const Fault fault_;
    std::uint64_t calls_ = 0;
};

}  // namespace emca::test
