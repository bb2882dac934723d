// A path tracer of some 30 lines with EMCA's calls in it, side by side with Algorithm 1 of the EMCA paper, and the
// adapter that serves it. Start it, then open the explorer:
//
//     minimal_renderer 50013 &
//     emca-explorer 127.0.0.1:50013
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "emca/core/seed_map.h"
#include "emca/recorder/recorder.h"
#include "emca/server/server.h"

namespace {

using namespace emca;

// A scene: four spheres, one of which shines.

struct Sphere {
    Vec3f centre;
    float radius;
    Color albedo, emission;
};
const std::vector<Sphere> kSpheres{{{0, -1000, 0}, 1000, Color(0.6f), Color()},
                                   {{-1.1f, 1, 0}, 1, {0.8f, 0.3f, 0.2f}, Color()},
                                   {{1.1f, 1, 0}, 1, {0.2f, 0.5f, 0.8f}, Color()},
                                   {{0, 5, 1}, 1, Color(), {12, 11, 9}}};
const Color kSky(0.2f, 0.25f, 0.3f);
constexpr std::uint32_t kWidth = 160, kHeight = 120, kSamples = 64;
constexpr int kMaxBounces = 16;

struct Ray {
    Vec3f origin, direction;
};
struct Hit {
    float distance = std::numeric_limits<float>::infinity();
    int sphere = -1;
};

Hit intersect(const Ray& ray) {
    Hit hit;
    for (int i = 0; i < int(kSpheres.size()); ++i) {
        const Vec3f toRay = ray.origin - kSpheres[i].centre;
        const float b = dot(toRay, ray.direction), c = dot(toRay, toRay) - kSpheres[i].radius * kSpheres[i].radius;
        const float root = b * b - c;
        if (root < 0) continue;
        for (const float t : {-b - std::sqrt(root), -b + std::sqrt(root)})
            if (t > 1e-3f && t < hit.distance) {
                hit = {t, i};
                break;
            }
    }
    return hit;
}

using Random = std::mt19937_64;
float uniform(Random& random) { return float(random() >> 40) * 0x1p-24f; }

Vec3f cosineDirection(Vec3f normal, float u, float v) {
    const float z = 1 - 2 * u, phi = 6.2831853f * v, r = std::sqrt(std::max(0.f, 1 - z * z));
    return normalize(normal + Vec3f{r * std::cos(phi), r * std::sin(phi), z});
}

const Camera kCamera{.position = {0, 2.2f, 7}, .direction = normalize(Vec3f{0, -0.18f, -1}), .up = normalize(Vec3f{0, 1, -0.18f}), .verticalFieldOfView = 40};

Ray cameraRay(Pixel pixel, Random& random) {
    const float scale = std::tan(kCamera.verticalFieldOfView * 0.5f * 0.0174532925f);
    const float x = (2 * (float(pixel.x) + uniform(random)) / kWidth - 1) * scale * kWidth / kHeight;
    const float y = (1 - 2 * (float(pixel.y) + uniform(random)) / kHeight) * scale;
    return {kCamera.position, normalize(kCamera.direction + x * cross(kCamera.direction, kCamera.up) + y * kCamera.up)};
}

// The path tracer. Lines that begin with `emca.` are all that EMCA needs.

Color trace(Ray ray, Random& random) {                                      // function trace(ray):
    PathRecorder& emca = recorder();                                        //   import emca
    Color radiance, throughput(1.f);                                        //   L = Color(0), T = Color(1)
    for (int bounce = 1; bounce <= kMaxBounces; ++bounce) {                 //   for bounce=1 to max bounces do
        const Hit hit = intersect(ray);                                     //     its = scene.intersect(ray)
        emca.setDepthIndex(bounce);                                         //     emca->setDepthIndex(bounce)
        if (hit.sphere < 0) {                                               //     if no intersection then
            emca.setIntersectionPosEnvmap(ray.origin + 20.f * ray.direction);
            emca.setIntersectionEmission(kSky);
            radiance += throughput * kSky;
            emca.setIntersectionEstimate(radiance);
            emca.addPathData("left scene", true);                           //       emca->addPathData("left scene", true)
            break;                                                          //       break
        }
        const Sphere& sphere = kSpheres[hit.sphere];
        const Vec3f position = ray.origin + hit.distance * ray.direction;
        Vec3f normal = (position - sphere.centre) / sphere.radius;
        if (dot(normal, ray.direction) > 0) normal = -normal;
        emca.setIntersectionPos(position);                                  //     emca->setIntersectionPos(its.pos)
        emca.setIntersectionEmission(sphere.emission);
        radiance += throughput * sphere.emission;                           //     L += T · Le(...)
        emca.setIntersectionEstimate(radiance);
        const float u = uniform(random), v = uniform(random);
        const Vec3f direction = cosineDirection(normal, u, v);              //     ωo = sample outgoing ray direction
        const float pdf = dot(direction, normal) / 3.14159265f;             //     p = PDF of outgoing ray direction
        emca.setIntersectionEvent(Event::reflect, Lobe::diffuse);
        emca.addIntersectionData("PDF", pdf);                               //     emca->addIntersectionData("PDF", p)
        emca.addIntersectionData("random numbers", Vec2f{u, v});
        throughput *= sphere.albedo;                                        //     T *= fs(...) · cos θo / p
        emca.addIntersectionData("throughput", throughput);
        if (isBlack(throughput)) break;
        ray = {position, direction};
    }
    emca.setFinalEstimate(radiance);                                        //   emca->setFinalEstimate(L)
    return radiance;                                                        //   return L
}

Color renderOnePixel(Pixel pixel, std::uint32_t samples, std::uint64_t seed) {  // foreach pixel(x,y) in the image do
    PathRecorder& emca = recorder();
    const SeedMap seeds(seed);
    Color sum;                                                              //   L = Color(0)
    for (std::uint32_t sample = 0; sample < samples; ++sample) {            //   for sample=1 to samples per pixel do
        Random random(seeds.seed(pixel, sample));
        emca.setPathIndex(sample);                                          //     emca->setPathIndex(sample)
        const Ray ray = cameraRay(pixel, random);                           //     ray = sample camera ray for pixel (x, y)
        emca.setPathOrigin(ray.origin);                                     //     emca->setPathOrigin(ray.origin)
        sum += trace(ray, random);                                          //     L += trace(ray)
    }
    return sum / float(samples);                                            //   L /= sample count
}

// The adapter: one class.

Mesh triangulated(const Sphere& sphere) {
    constexpr int kRings = 24, kSegments = 48;
    Mesh mesh{.name = "sphere", .diffuse = sphere.albedo, .emission = sphere.emission};
    for (int r = 0; r <= kRings; ++r)
        for (int s = 0; s < kSegments; ++s) {
            const float theta = 3.14159265f * float(r) / kRings, phi = 6.2831853f * float(s) / kSegments;
            mesh.positions.push_back(sphere.centre + sphere.radius * Vec3f{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)});
        }
    for (std::uint32_t r = 0; r < kRings; ++r)
        for (std::uint32_t s = 0; s < kSegments; ++s) {
            const std::uint32_t next = (s + 1) % kSegments, a = r * kSegments + s, b = r * kSegments + next;
            if (r > 0) mesh.triangles.push_back({a, b, a + kSegments});
            if (r + 1 < kRings) mesh.triangles.push_back({b, b + kSegments, a + kSegments});
        }
    return mesh;
}

class MinimalRenderer final : public Renderer {
  public:
    RendererInfo info() const override {
        return {.renderer = "minimal renderer", .scene = "four spheres", .width = kWidth, .height = kHeight, .samplesPerPixel = kSamples, .concurrent = true};
    }
    Camera camera() const override { return kCamera; }
    std::vector<Mesh> meshes() const override {
        std::vector<Mesh> meshes;
        for (const Sphere& sphere : kSpheres) meshes.push_back(triangulated(sphere));
        return meshes;
    }
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override {
        RenderedImage image{.color = Image(kWidth, kHeight)};
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            if (monitor.cancelled()) return Error{ErrorCode::cancelled, "The render was cancelled."};
            for (std::uint32_t x = 0; x < kWidth; ++x)
                image.color.setColor({x, y}, renderOnePixel({x, y}, samples(settings), settings.seed));
            monitor.progress(double(y + 1) / kHeight);
        }
        return image;
    }
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor&) override {
        return renderOnePixel(pixel, samples(settings), settings.seed);
    }

  private:
    static std::uint32_t samples(const RenderSettings& settings) { return settings.samplesPerPixel ? settings.samplesPerPixel : kSamples; }
};

}  // namespace

int main(int argc, char** argv) {
    MinimalRenderer renderer;
    auto server = Server::start(renderer, {.port = std::uint16_t(argc > 1 ? std::atoi(argv[1]) : 50013), .allowQuit = true});
    if (!server) {
        std::fprintf(stderr, "%s\n", server.error().message.c_str());
        return 4;
    }
    std::printf("listening on %s\n", (*server)->address().c_str());
    std::fflush(stdout);
    (*server)->wait();
}
