#include "emca/render/path_integrator.h"

#include <algorithm>
#include <limits>

#include "emca/render/bsdf.h"

namespace emca::render {

namespace {

/// Dimensions of one vertex, relative to its first one: every decision always reads the same dimension.
enum Dimension : std::uint32_t { kMask, kLightChoice, kLightPoint, kLobe, kDirection, kRoulette, kDimensionsPerVertex };

constexpr float kLargestSurvival = 0.95f;  // as Mitsuba's: a path in a closed white box must end some time

/// No scene needs more; a white closed box without roulette would never end, and could not be cancelled.
constexpr int kLargestVertex = 100'000;

/// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2.4, power heuristic with
/// exponent 2. The quotient form neither overflows nor divides infinity by infinity.
float powerHeuristic(float pdf, float otherPdf) {
    if (!(pdf > 0.f)) return 0.f;
    const float ratio = otherPdf / pdf;
    return 1.f / (1.f + ratio * ratio);
}

}  // namespace

Color PathIntegrator::radiance(Ray ray, Sampler& sampler, emca::PathRecorder emca, SurfaceTally* surface) const {
    Color estimate(0.f), throughput(1.f);
    float eta = 1.f;  // product of relative indices of refraction: roulette must not see radiance squeezed inside glass
    Arrival arrival{ray.origin};
    SurfaceInteraction at;
    const char* end = "";

    // A vertex is where the path meets a surface. A mask that lets the path through is a vertex, but no segment more.
    int vertex = 1;
    for (int depth = 1;; ++vertex) {
        const std::uint32_t dimension = kFirstDimension + static_cast<std::uint32_t>(vertex - 1) * kDimensionsPerVertex;

        if (!scene_.intersect(ray, at)) {
            emca.setDepthIndex(vertex);
            if (surface) surface->background();
            estimate += environmentLight(ray, arrival, throughput, emca, surface);
            emca.setIntersectionEstimate(estimate);
            emca.addPathData("left scene", true);
            end = "left the scene";
            break;
        }
        emca.setDepthIndex(vertex);
        emca.setIntersectionPos(at.position);
        emca.setIntersectionSurface(at.mesh, at.face);
        emca.addIntersectionData("shape", [&] { return std::string_view(at.shape->name); });
        emca.addIntersectionData("material", [&] { return std::string_view(at.bsdf->name()); });
        emca.addIntersectionData("throughput", throughput);
        if (surface) surface->intersection(at, throughput);

        if (at.shape->masked) {
            sampler.setDimension(dimension + kMask);
            const float opacity = at.bsdf->opacity(at), u = sampler.next1D();
            emca.addIntersectionData("opacity", opacity);
            if (u >= opacity && vertex < kLargestVertex) {
                emca.setIntersectionEvent(Event::pass, Lobe::straight, at.bsdf->name());
                emca.setIntersectionEstimate(estimate);
                if (surface) surface->scattered(Color(1.f));
                ray.origin = offsetOrigin(at.position, at.geometricNormal, at.positionError, ray.direction);
                ray.minimumDistance = 0.f;
                ray.maximumDistance -= at.distance;
                continue;
            }
        }

        if (at.emitter) estimate += emittedLight(at, ray, arrival, throughput, emca, surface);
        if (depth == settings_.maximumDepth || vertex == kLargestVertex) {
            emca.setIntersectionEvent(at.emitter ? Event::emission : Event::absorb, Lobe::none, at.bsdf->name());
            emca.setIntersectionEstimate(estimate);
            end = vertex == kLargestVertex ? "too many vertices" : "maximum depth";
            break;
        }

        // Chosen before light is looked for: the processor does both at once, which it cannot across a shadow ray.
        sampler.setDimension(dimension + kLobe);
        const float uLobe = sampler.next1D();
        const Vec2f uDirection = sampler.next2D();
        const auto scattered = at.bsdf->sample(at, at.wo, uLobe, uDirection);
        emca.addIntersectionData("random number (lobe)", uLobe);
        emca.addIntersectionData("random numbers (direction)", uDirection);

        sampler.setDimension(dimension + kLightChoice);
        estimate += sampledLight(at, throughput, sampler, emca, surface);
        emca.setIntersectionEstimate(estimate);

        const Vec3f direction = scattered ? at.toWorld(scattered->wi) : Vec3f{};
        if (!scattered || isBlack(scattered->weight) || violatesStrictNormals(at, direction, scattered->wi)) {
            emca.setIntersectionEvent(at.emitter ? Event::emission : Event::absorb, Lobe::none, at.bsdf->name());
            if (surface) surface->invalidDirection();
            end = "absorbed";
            break;
        }
        emca.setIntersectionEvent(scattered->event, scattered->lobe, at.bsdf->name());
        emca.addIntersectionData("BSDF pdf", scattered->pdf);
        emca.addIntersectionData("BSDF weight", scattered->weight);
        throughput *= scattered->weight;
        eta *= scattered->eta;

        float survival = 1.f;
        if (depth >= settings_.rouletteDepth) {
            survival = std::min(maxComponent(throughput) * eta * eta, kLargestSurvival);
            sampler.setDimension(dimension + kRoulette);
            const float u = sampler.next1D();
            emca.addIntersectionData("roulette survival probability", survival);
            emca.addIntersectionData("random number (roulette)", u);
            if (u >= survival) {
                if (surface) surface->rouletteEnd();
                end = "Russian roulette";
                break;
            }
            throughput /= survival;
        }
        if (surface) surface->scattered(scattered->weight / survival);

        // Member by member: as whole structures they would be put together in memory, narrow stores before wide loads.
        arrival.from = at.position;
        arrival.pdf = scattered->pdf;
        arrival.direct = false;
        arrival.delta = scattered->isDelta();
        ray.origin = offsetOrigin(at.position, at.geometricNormal, at.positionError, direction);
        ray.direction = direction;
        ray.minimumDistance = 0.f;
        ray.maximumDistance = std::numeric_limits<float>::infinity();
        ++depth;
    }
    if (surface) surface->end(vertex);
    emca.addPathData("end", std::string_view(end));
    emca.setFinalEstimate(estimate);
    return estimate;
}

Color PathIntegrator::emittedLight(const SurfaceInteraction& at, const Ray& ray, const Arrival& arrival,
                                   Color throughput, emca::PathRecorder emca, SurfaceTally* surface) const {
    if (arrival.direct && settings_.hideEmitters) return Color(0.f);
    const Color emission = at.emitter->emitted(at, -ray.direction);
    emca.setIntersectionEmission(emission);
    if (isBlack(emission)) return emission;

    float lightPdf = 0.f;
    if (!arrival.delta) {
        const float distance = length(at.position - arrival.from);
        lightPdf = scene_.emitterProbability(*at.emitter) * at.emitter->pdf(arrival.from, ray.direction, distance, at);
        emca.addIntersectionData("light pdf (hit)", lightPdf);
    }
    const float weight = hitWeight(arrival, lightPdf);
    const Color contribution = throughput * emission * weight;
    if (surface) surface->hit(emission * weight);
    emca.addIntersectionData("MIS weight (hit)", weight);
    emca.addIntersectionData("light (hit)", [&] { return std::string_view(at.emitter->name); });
    emca.addContribution(contribution, arrival.direct ? "emitter hit" : "BSDF sampling", weight, LightEnd::hit);
    return contribution;
}

Color PathIntegrator::environmentLight(const Ray& ray, const Arrival& arrival, Color throughput,
                                       emca::PathRecorder emca, SurfaceTally* surface) const {
    // The viewer draws the hit outside of everything, where the ray is surely on its way out.
    emca.setIntersectionPosEnvmap([&] { return ray.at(length(ray.origin - scene_.center()) + 2.f * scene_.radius()); });
    emca.setIntersectionEvent(Event::background);
    emca.addIntersectionData("throughput", throughput);
    const Emitter* environment = scene_.environment();
    if (!environment || (arrival.direct && settings_.hideEmitters)) return Color(0.f);
    const Color emission = environment->environment(ray.direction);
    emca.setIntersectionEmission(emission);
    if (isBlack(emission)) return emission;

    float lightPdf = 0.f;
    if (!arrival.delta) {
        lightPdf = scene_.emitterProbability(*environment) * environment->environmentPdf(ray.direction);
        emca.addIntersectionData("light pdf (hit)", lightPdf);
    }
    const float weight = hitWeight(arrival, lightPdf);
    const Color contribution = throughput * emission * weight;
    if (surface) surface->hit(emission * weight);
    emca.addIntersectionData("MIS weight (hit)", weight);
    emca.addIntersectionData("light (hit)", [&] { return std::string_view(environment->name); });
    emca.addContribution(contribution, arrival.direct ? "emitter hit" : "BSDF sampling", weight, LightEnd::hit);
    return contribution;
}

Color PathIntegrator::sampledLight(const SurfaceInteraction& at, Color throughput, Sampler& sampler,
                                   emca::PathRecorder emca, SurfaceTally* surface) const {
    if (at.bsdf->isDelta()) return Color(0.f);
    const float uChoice = sampler.next1D();
    const Vec2f uPoint = sampler.next2D();
    const Scene::EmitterChoice choice = scene_.chooseEmitter(uChoice);
    if (!choice.emitter) return Color(0.f);
    const bool delta = choice.emitter->isDelta();
    if (settings_.strategy == LightStrategy::bsdfSampling && !delta) return Color(0.f);
    emca.addIntersectionData("random number (light choice)", uChoice);
    emca.addIntersectionData("random numbers (light)", uPoint);

    const auto light = choice.emitter->sample(at.position, uPoint);
    emca.addIntersectionData("light", [&] { return std::string_view(choice.emitter->name); });
    if (!light || isBlack(light->radiance)) return Color(0.f);
    if (surface) surface->nextEvent(*light);
    const float lightPdf = choice.probability * light->pdf;
    const Vec3f wi = at.toLocal(light->direction);
    const Bsdf::EvalPdf bsdf = at.bsdf->evalPdf(at, at.wo, wi);
    emca.addIntersectionData("light pdf", lightPdf);
    emca.addIntersectionData("BSDF pdf (light)", bsdf.pdf);
    if (isBlack(bsdf.value) || violatesStrictNormals(at, light->direction, wi)) return Color(0.f);

    const bool combined = settings_.strategy == LightStrategy::mis && !delta;
    const float weight = combined ? powerHeuristic(lightPdf, bsdf.pdf) : 1.f;
    if (surface) surface->misWeight(weight);
    const float visible = scene_.transmittance(at, *light);
    emca.setNextEventEstimationPos(light->position, visible > 0.f);
    if (visible == 0.f) return Color(0.f);
    if (surface) surface->direct(bsdf.value * light->radiance * (visible * weight / lightPdf));
    const Color contribution = throughput * bsdf.value * light->radiance * (visible * weight / lightPdf);
    emca.addIntersectionData("MIS weight (light)", weight);
    emca.addContribution(contribution, "light sampling", weight, LightEnd::connected);
    return contribution;
}

float PathIntegrator::hitWeight(const Arrival& arrival, float lightPdf) const {
    if (arrival.delta || settings_.strategy == LightStrategy::bsdfSampling) return 1.f;
    if (settings_.strategy == LightStrategy::lightSampling) return 0.f;
    return powerHeuristic(arrival.pdf, lightPdf);
}

bool PathIntegrator::violatesStrictNormals(const SurfaceInteraction& at, Vec3f world, Vec3f local) const {
    return settings_.strictNormals && dot(world, at.geometricNormal) * local.z <= 0.f;
}

}  // namespace emca::render
