#include "path_integrator.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <mitsuba/render/renderproc.h>

#include "scattering.h"

namespace emca::mitsuba06 {

namespace {

constexpr mts::Float kLargestSurvival = mts::Float(0.95);  ///< so that no path lives for ever
constexpr int kLargestVertex = 100000;                     ///< nor between two perfect mirrors

/// Power heuristic with exponent 2. Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997,
/// section 9.2.4. Written so that large densities do not overflow.
mts::Float powerHeuristic(mts::Float used, mts::Float other) {
    if (used <= 0) return 0;
    const mts::Float ratio = other / used;
    return 1 / (1 + ratio * ratio);
}

}  // namespace

/// A path on its way.
struct EmcaPathIntegrator::Walk {
    Walk(const mts::RayDifferential& sensorRay, mts::RadianceQueryRecord& rRec, const PathContext& pathContext)
        : query(rRec), context(pathContext), scene(*rRec.scene), ray(sensorRay) {}

    mts::RadianceQueryRecord& query;
    const PathContext& context;
    const mts::Scene& scene;
    PathRecorder emca = recorder();
    mts::RayDifferential ray;
    mts::Spectrum estimate{mts::Float(0)}, throughput{mts::Float(1)};
    mts::Float survival = 1;  ///< probability of going on from this vertex
    /// Product of relative indices of refraction: roulette must not see radiance squeezed inside glass.
    mts::Float eta = 1;
    int depth = 1;                                  ///< segments up to here
    std::optional<mts::DirectSamplingRecord> from;  ///< the vertex before, for the densities of light sampling there
    mts::Float pdf = 0;                             ///< density with which the last direction was chosen
    bool direct = true;                             ///< the segment comes from the camera
    bool delta = false;                             ///< the last direction was one of a discrete set

    /// As it reaches the pixel. Not part of the estimate itself: that is the same whatever the sensor does with it.
    mts::Spectrum seen(const mts::Spectrum& value) const { return context.cameraWeight * value; }
    void add(const mts::Spectrum& contribution, const char* technique, mts::Float misWeight, LightEnd end) {
        estimate += contribution;
        emca.addContribution(seen(contribution), technique, static_cast<float>(misWeight), end);
    }
};

EmcaPathIntegrator::EmcaPathIntegrator(const mts::Properties& properties)
    : mts::MonteCarloIntegrator(properties), serving_(properties) {}

mts::Spectrum EmcaPathIntegrator::trace(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query,
                                        const PathContext& context) const {
    Walk walk(ray, query, context);
    const char* end = nullptr;
    query.rayIntersect(walk.ray);  // the first segment, which also sets alpha
    for (;; ++walk.depth) {
        walk.emca.setDepthIndex(walk.depth);
        end = query.its.isValid() ? surface(walk) : environment(walk);
        if (end) break;
        walk.scene.rayIntersect(walk.ray, query.its);
    }
    walk.emca.setIntersectionEstimate([&] { return walk.seen(walk.estimate); });
    if (context.tally) context.tally->end(walk.depth);
    walk.emca.addPathData("end", std::string_view(end));
    return walk.estimate;
}

const char* EmcaPathIntegrator::surface(Walk& walk) const {
    mts::Intersection& its = walk.query.its;
    PathTally* const tally = walk.context.tally;
    arrive(walk);
    emission(walk);
    subsurface(walk);
    const mts::BSDF* const bsdf = its.getBSDF(walk.ray);
    walk.emca.addIntersectionData("material", [&] { return bsdf ? nameOf(*bsdf) : std::string_view("none"); });
    // Stays if nothing is scattered.
    walk.emca.setIntersectionEvent(its.isEmitter() ? Event::emission : Event::absorb, Lobe::none,
                                   [&] { return bsdf ? nameOf(*bsdf) : std::string_view(); });
    if (!bsdf) return "no material";
    if (walk.depth == m_maxDepth) return "maximum depth";
    if (walk.depth == kLargestVertex) return "too many vertices";
    if (violatesStrictNormals(its, -walk.ray.d, its.wi)) return "shading normal";
    if (!survives(walk)) {
        if (tally) tally->rouletteEnd();
        return "Russian roulette";
    }
    sampledLight(walk, *bsdf);
    walk.emca.setIntersectionEstimate([&] { return walk.seen(walk.estimate); });
    if (!scatter(walk, *bsdf)) {
        if (tally) tally->invalidDirection();
        return "absorbed";
    }
    return nullptr;
}

void EmcaPathIntegrator::arrive(Walk& walk) const {
    const mts::Intersection& its = walk.query.its;
    PathTally* const tally = walk.context.tally;
    if (!walk.emca.isRecording() && !tally) return;
    const SurfacePlace place = walk.context.shapes ? walk.context.shapes->place(its) : SurfacePlace{};
    walk.emca.setIntersectionPos(its.p);
    if (place) walk.emca.setIntersectionSurface(place.mesh, place.face);
    walk.emca.addIntersectionData("shape", [&] { return nameOf(*its.shape); });
    walk.emca.addIntersectionData("throughput", [&] { return walk.seen(walk.throughput); });
    walk.emca.addIntersectionData("normal", its.shFrame.n);
    if (!tally) return;
    tally->intersection({place.mesh, place.face, toVec3f(its.p)});
    tally->throughput(toColor(walk.seen(walk.throughput)));
}

bool EmcaPathIntegrator::violatesStrictNormals(const mts::Intersection& its, const mts::Vector& world,
                                               const mts::Vector& local) const {
    return m_strictNormals && dot(its.geoFrame.n, world) * mts::Frame::cosTheta(local) <= 0;
}

void EmcaPathIntegrator::emission(Walk& walk) const {
    const mts::Intersection& its = walk.query.its;
    if (!its.isEmitter() || (walk.direct && m_hideEmitters)) return;
    const mts::Spectrum emitted = its.Le(-walk.ray.d);
    walk.emca.setIntersectionEmission(emitted);
    if (emitted.isZero()) return;
    mts::Float lightPdf = 0;
    if (walk.from && !walk.delta) {
        walk.from->setQuery(walk.ray, its);
        lightPdf = walk.scene.pdfEmitterDirect(*walk.from);
    }
    addHit(walk, emitted, lightPdf, *its.shape->getEmitter());
}

const char* EmcaPathIntegrator::environment(Walk& walk) const {
    constexpr const char* kEnd = "left the scene";
    walk.emca.addPathData("left scene", true);
    // The viewer draws the hit outside of everything, where the ray is surely on its way out.
    walk.emca.setIntersectionPosEnvmap([&] {
        const mts::BSphere bounds = walk.scene.getBSphere();
        return walk.ray((walk.ray.o - bounds.center).length() + 2 * bounds.radius);
    });
    walk.emca.setIntersectionEvent(Event::background);
    walk.emca.addIntersectionData("throughput", [&] { return walk.seen(walk.throughput); });
    if (walk.context.tally) walk.context.tally->background();
    const mts::Emitter* const light = walk.scene.getEnvironmentEmitter();
    if (!light || (walk.direct && m_hideEmitters)) return kEnd;
    const mts::Spectrum emitted = walk.scene.evalEnvironment(walk.ray);
    walk.emca.setIntersectionEmission(emitted);
    if (emitted.isZero()) return kEnd;
    mts::Float lightPdf = 0;
    if (walk.from && !walk.delta && light->fillDirectSamplingRecord(*walk.from, walk.ray))
        lightPdf = walk.scene.pdfEmitterDirect(*walk.from);
    addHit(walk, emitted, lightPdf, *light);
    return kEnd;
}

void EmcaPathIntegrator::addHit(Walk& walk, const mts::Spectrum& emission, mts::Float lightPdf,
                                const mts::Emitter& emitter) const {
    const mts::Float weight = walk.direct || walk.delta ? mts::Float(1) : powerHeuristic(walk.pdf, lightPdf);
    walk.add(walk.throughput * emission * weight, walk.direct ? "emitter hit" : "BSDF sampling", weight, LightEnd::hit);
    if (walk.context.tally) walk.context.tally->hit(toColor(emission * weight));
    if (!walk.direct && !walk.delta) walk.emca.addIntersectionData("light pdf (hit)", lightPdf);
    walk.emca.addIntersectionData("MIS weight (hit)", weight);
    walk.emca.addIntersectionData("light (hit)", [&] { return nameOf(emitter); });
}

void EmcaPathIntegrator::subsurface(Walk& walk) const {
    const mts::Intersection& its = walk.query.its;
    if (!its.hasSubsurface()) return;
    const mts::Spectrum radiance = its.LoSub(&walk.scene, walk.query.sampler, -walk.ray.d, walk.depth);
    walk.add(walk.throughput * radiance, "subsurface", std::numeric_limits<mts::Float>::quiet_NaN(),
             LightEnd::automatic);
    if (walk.context.tally) walk.context.tally->direct(toColor(radiance));
}

void EmcaPathIntegrator::sampledLight(Walk& walk, const mts::BSDF& bsdf) const {
    const mts::Intersection& its = walk.query.its;
    walk.from.emplace(its);
    if (!(bsdf.getType() & mts::BSDF::ESmooth) || walk.scene.getEmitters().empty()) return;
    mts::DirectSamplingRecord light(its);
    const mts::Point2 u = walk.query.nextSample2D();
    walk.emca.addIntersectionData("random numbers (light)", u);
    // Its shadow ray is ours, so that what is in between can be told from what does not shine this way.
    const mts::Spectrum radiance = walk.scene.sampleEmitterDirect(light, u, false);  // over the density
    if (light.pdf == 0 || radiance.isZero()) return;
    const auto& emitter = static_cast<const mts::Emitter&>(*light.object);
    if (walk.context.tally && walk.context.tally->wantsNextEvents() && emitter.getShape()) {
        const SurfacePlace place = walk.context.shapes->place(emitter.getShape(), light.p);
        walk.context.tally->nextEvent({place.mesh, place.face, toVec3f(light.p)});
    }

    const mts::BSDFSamplingRecord scattering(its, its.toLocal(light.d));
    const mts::Spectrum value = bsdf.eval(scattering);
    // A light of a discrete set of points or directions is not met by chance.
    const mts::Float bsdfPdf = emitter.getDirectMeasure() == mts::ESolidAngle ? bsdf.pdf(scattering) : mts::Float(0);
    walk.emca.addIntersectionData("light", [&] { return nameOf(emitter); });
    walk.emca.addIntersectionData("light pdf", light.pdf);
    walk.emca.addIntersectionData("BSDF pdf (light)", bsdfPdf);
    walk.emca.addIntersectionData("BSDF value (light)", value);
    if (value.isZero() || violatesStrictNormals(its, light.d, scattering.wo)) return;

    const mts::Float weight = powerHeuristic(light.pdf, bsdfPdf);
    walk.emca.addIntersectionData("MIS weight (light)", weight);
    if (walk.context.tally) walk.context.tally->misWeight(static_cast<float>(weight));
    const bool visible =
        !walk.scene.rayIntersect(mts::Ray(light.ref, light.d, Epsilon, light.dist * (1 - ShadowEpsilon), light.time));
    walk.emca.setNextEventEstimationPos(light.p, visible);
    if (!visible) return;
    const mts::Spectrum reflected = value * radiance * weight;
    walk.add(walk.throughput * reflected, "light sampling", weight, LightEnd::connected);
    if (walk.context.tally) walk.context.tally->direct(toColor(reflected / walk.survival));
}

bool EmcaPathIntegrator::scatter(Walk& walk, const mts::BSDF& bsdf) const {
    const mts::Intersection& its = walk.query.its;
    mts::BSDFSamplingRecord sampled(its, walk.query.sampler);
    const mts::Point2 u = walk.query.nextSample2D();
    walk.emca.addIntersectionData("random numbers (direction)", u);
    const mts::Spectrum weight = bsdf.sample(sampled, walk.pdf, u);
    if (weight.isZero()) return false;
    const mts::Vector direction = its.toWorld(sampled.wo);
    if (violatesStrictNormals(its, direction, sampled.wo)) return false;

    const Scattering scattering = scatteringOf(sampled.sampledType);
    walk.emca.setIntersectionEvent(scattering.event, scattering.lobe, [&] { return nameOf(bsdf); });
    walk.emca.addIntersectionData("BSDF pdf", walk.pdf);
    walk.emca.addIntersectionData("BSDF weight", weight);
    walk.emca.addIntersectionData("direction", direction);
    if (walk.context.tally) walk.context.tally->scattered(toColor(weight / walk.survival));
    walk.throughput *= weight;
    walk.eta *= sampled.eta;
    walk.delta = (sampled.sampledType & mts::BSDF::EDelta) != 0;
    walk.direct = walk.direct && (sampled.sampledType & mts::BSDF::ENull);  // straight on: still what the camera sees
    walk.ray = mts::RayDifferential(its.p, direction, walk.ray.time);
    return true;
}

bool EmcaPathIntegrator::survives(Walk& walk) const {
    walk.survival = 1;
    if (walk.depth <= m_rrDepth) return true;
    walk.survival = std::min(walk.throughput.max() * walk.eta * walk.eta, kLargestSurvival);
    const mts::Float u = walk.query.nextSample1D();
    walk.emca.addIntersectionData("roulette survival probability", walk.survival);
    walk.emca.addIntersectionData("random number (roulette)", u);
    if (u >= walk.survival) return false;
    walk.throughput /= walk.survival;
    return true;
}

bool EmcaPathIntegrator::preprocess(const mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job,
                                    int sceneId, int sensorId, int samplerId) {
    if (scene->hasMedia())
        SLog(mts::EWarn, "emcapath does not see participating media; use emca around volpath for them.");
    return mts::MonteCarloIntegrator::preprocess(scene, queue, job, sceneId, sensorId, samplerId);
}

bool EmcaPathIntegrator::render(mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                                int sensorId, int samplerId) {
    const bool complete = mts::MonteCarloIntegrator::render(scene, queue, job, sceneId, sensorId, samplerId);
    if (complete) serving_.run(*scene, *this);
    return complete;
}

void EmcaPathIntegrator::cancel() {
    mts::MonteCarloIntegrator::cancel();
    serving_.stop();
}

using mts::Class;
MTS_IMPLEMENT_CLASS(EmcaPathIntegrator, false, MonteCarloIntegrator)

}  // namespace emca::mitsuba06
