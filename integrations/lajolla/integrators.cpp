#include "integrators.h"

#include <algorithm>

#include "emca/adapter/exchanged.h"

// In the person's render.cpp; an integrator that is not there is not offered.
#define EMCA_COURSE_INTEGRATOR(name) Spectrum name(const Scene& scene, int x, int y, pcg32_state& random) __attribute__((weak))
EMCA_COURSE_INTEGRATOR(path_tracing);
EMCA_COURSE_INTEGRATOR(vol_path_tracing_1);
EMCA_COURSE_INTEGRATOR(vol_path_tracing_2);
EMCA_COURSE_INTEGRATOR(vol_path_tracing_3);
EMCA_COURSE_INTEGRATOR(vol_path_tracing_4);
EMCA_COURSE_INTEGRATOR(vol_path_tracing_5);
EMCA_COURSE_INTEGRATOR(vol_path_tracing);

namespace emca::lajolla {

namespace {

/// All that can be, whether or not it is there.
std::vector<Integrator> courseIntegrators() {
    return {{"path", &path_tracing, false},           {"volpath1", &vol_path_tracing_1, true}, {"volpath2", &vol_path_tracing_2, true},
            {"volpath3", &vol_path_tracing_3, true}, {"volpath4", &vol_path_tracing_4, true}, {"volpath5", &vol_path_tracing_5, true},
            {"volpath6", &vol_path_tracing, true}};
}

/// The name that a scene means.
std::string nameFor(const ::Scene& scene) {
    if (scene.options.integrator == ::Integrator::Path) return "path";
    if (scene.options.integrator == ::Integrator::VolPath) return "volpath";
    return "emcapath";  // depth, normals and other images without paths
}

}  // namespace

std::vector<std::string> integratorNames() {
    std::vector<std::string> names{"emcapath"};
    for (const Integrator& integrator : courseIntegrators()) {
        if (integrator.course) names.push_back(integrator.name);
    }
    return names;
}

Result<Integrator> findIntegrator(const std::string& name, const ::Scene& scene) {
    std::string wanted = name.empty() ? nameFor(scene) : name;
    if (wanted == "emcapath") return Integrator{wanted};
    if (wanted == "volpath") {  // as render.cpp chooses: 6 for every other number
        const int version = scene.options.vol_path_version;
        wanted += std::to_string(version >= 1 && version <= 5 ? version : 6);
    }
    for (const Integrator& integrator : courseIntegrators()) {
        if (integrator.course && integrator.name == wanted) return integrator;
    }
    std::string names;
    for (const std::string& one : integratorNames()) names += (names.empty() ? "" : ", ") + one;
    return Error{ErrorCode::invalidArgument, "Asked for the integrator \"" + wanted + "\": there are " + names + "."};
}

PathTracer::PathTracer(const LoadedScene& scene, const Integrator& integrator, std::uint64_t seed, SurfaceRecorder* surface)
    : scene_(scene), integrator_(integrator), seeds_(seed), observer_(scene, integrator.volumetric && !scene.scene().media.empty()) {
    if (surface) tally_.emplace(scene, *surface);
}

Spectrum PathTracer::sample(Pixel pixel, std::uint32_t index) {
    PathRecorder emca = recorder();
    random_.seed(seeds_.seed(pixel, index));
    emca.setPathIndex(index);
    return integrator_.course ? courseSample(pixel, emca) : emcaSample(pixel, emca);
}

Spectrum PathTracer::emcaSample(Pixel pixel, PathRecorder emca) {
    const ::Scene& scene = scene_.scene();
    // Compilers choose which of two arguments comes first. Written as in lajolla, both integrators have the same paths.
    const Vector2 screen((Real(pixel.x) + random_.next()) / scene.camera.width, (Real(pixel.y) + random_.next()) / scene.camera.height);
    const Ray ray = sample_primary(scene.camera, screen);
    emca.setPathOrigin(ray.org);
    emca.addPathData("film position", [&] { return Vec2d{double(screen.x) * scene.camera.width, double(screen.y) * scene.camera.height}; });
    return EmcaPath(scene_, scene.options.max_depth)
        .radiance(ray, init_ray_differential(scene.camera.width, scene.camera.height), random_, emca, tally_ ? &*tally_ : nullptr);
}

Spectrum PathTracer::courseSample(Pixel pixel, PathRecorder emca) {
    if (!emca.isRecording() && !tally_) {
        return integrator_.course(scene_.scene(), static_cast<int>(pixel.x), static_cast<int>(pixel.y), random_.state());
    }
    observer_.beginPath(emca, tally_ ? &*tally_ : nullptr);
    const Spectrum radiance = [&] {
        const adapter::Exchanged observed(currentObserver(), &observer_);
        return integrator_.course(scene_.scene(), static_cast<int>(pixel.x), static_cast<int>(pixel.y), random_.state());
    }();
    observer_.endPath(radiance);
    return radiance;
}

Spectrum PathTracer::radiance(const Ray& ray, Pixel pixel, std::uint32_t index, int maximumDepth) {
    random_.seed(seeds_.seed(pixel, index));
    const ::Scene& scene = scene_.scene();
    if (!integrator_.course) {
        const int depth = maximumDepth == 0 ? scene.options.max_depth : maximumDepth;
        return EmcaPath(scene_, depth).radiance(ray, RayDifferential{}, random_, recorder(), nullptr);
    }
    const adapter::Exchanged instead(cameraRayOverride(), &ray);
    return integrator_.course(scene, 0, 0, random_.state());
}

}  // namespace emca::lajolla
