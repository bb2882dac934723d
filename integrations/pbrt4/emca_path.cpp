#include "emca_path.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace emca::pbrt4 {

using pbrt::Float;
using pbrt::SampledSpectrum;

namespace {

/// Recorded as float also where pbrt computes in double precision.
float number(Float value) { return static_cast<float>(value); }

Vec2f numbers(pbrt::Point2f u) { return {number(u.x), number(u.y)}; }

std::span<const float> values(const SampledSpectrum& spectrum, std::array<float, pbrt::NSpectrumSamples>& store) {
    for (int i = 0; i < pbrt::NSpectrumSamples; ++i) store[std::size_t(i)] = number(spectrum[i]);
    return store;
}

/// Stays a function: in the middle of another one a compiler may fuse other products and sums of it than pbrt's build does,
/// and every bit of a path is to be that of pbrt's own integrator.
[[gnu::noinline]] Float density(const pbrt::BSDF& bsdf, pbrt::Vector3f wo, pbrt::Vector3f wi) { return bsdf.PDF(wo, wi); }

}  // namespace

/// A path on its way.
struct EmcaPathIntegrator::Walk {
    pbrt::RayDifferential ray;
    pbrt::SampledWavelengths& lambda;
    pbrt::Sampler sampler;
    SampledSpectrum estimate{0}, throughput{1};
    pbrt::LightSampleContext from;  ///< the last scattering, as light sampling would have seen it
    Float scatteringDensity = 0;    ///< with which the ray's direction was chosen, per steradian
    /// Only this path finds the light that it meets: it comes from the camera, a mirror, or through a boundary without
    /// material.
    bool alone = true;
    bool rough = false;  ///< some scattering was not specular
    Float etaScale = 1;  ///< radiance is squeezed inside glass: roulette must not see that
    const char* end = "";
};

EmcaPathIntegrator::EmcaPathIntegrator(const Settings& settings, pbrt::Camera camera_, pbrt::Sampler sampler,
                                       pbrt::Primitive scene, std::vector<pbrt::Light> lights_, const SceneView& view)
    : RayIntegrator(camera_, sampler, scene, lights_),
      settings_(settings),
      lightSampler_(pbrt::LightSampler::Create(settings.lightSampler, lights, pbrt::Allocator())),
      view_(view) {}

SampledSpectrum EmcaPathIntegrator::Li(pbrt::RayDifferential ray, pbrt::SampledWavelengths& lambda,
                                       pbrt::Sampler sampler, pbrt::ScratchBuffer& scratch,
                                       pbrt::VisibleSurface*) const {
    PathContext silent{.view = view_};
    return radiance(ray, lambda, sampler, scratch, silent, settings_.maximumDepth);
}

SampledSpectrum EmcaPathIntegrator::radiance(const pbrt::RayDifferential& ray, pbrt::SampledWavelengths& lambda,
                                             pbrt::Sampler sampler, pbrt::ScratchBuffer& scratch, PathContext& context,
                                             int maximumDepth) const {
    emca::PathRecorder& recorder = context.recorder;
    Walk walk{.ray = ray, .lambda = lambda, .sampler = sampler};
    const auto radianceColor = [&](const SampledSpectrum& s) {
        return view_.colors.radiance(context.cameraWeight * s, lambda);
    };

    int vertex = 1;
    for (int depth = 0;; ++vertex) {
        auto hit = Intersect(walk.ray);
        if (!hit) {
            recorder.setDepthIndex(vertex);
            if (context.tally) context.tally->background();
            environmentLight(walk, context);
            recorder.setIntersectionEstimate([&] { return radianceColor(walk.estimate); });
            recorder.addPathData("left scene", true);
            walk.end = "left the scene";
            break;
        }
        pbrt::SurfaceInteraction& at = hit->intr;
        arrive(walk, at, vertex, context);
        emittedLight(walk, at, context);

        pbrt::BSDF bsdf = at.GetBSDF(walk.ray, lambda, camera, scratch, sampler);
        const auto material = [&] { return view_.materials.of(at.material); };
        recorder.addIntersectionData("material", material);
        if (!bsdf) {  // a boundary of a medium
            recorder.setIntersectionEvent(Event::pass, Lobe::straight, material);
            recorder.setIntersectionEstimate([&] { return radianceColor(walk.estimate); });
            if (context.tally) context.tally->scattered(SampledSpectrum(1));
            walk.alone = true;
            at.SkipIntersection(&walk.ray, hit->tHit);
            continue;
        }
        if (settings_.regularize && walk.rough) bsdf.Regularize();

        const Event ending = at.areaLight ? Event::emission : Event::absorb;
        if (depth++ == maximumDepth) {
            recorder.setIntersectionEvent(ending, Lobe::none, material);
            recorder.setIntersectionEstimate([&] { return radianceColor(walk.estimate); });
            walk.end = "maximum depth";
            break;
        }
        if (IsNonSpecular(bsdf.Flags())) sampledLight(walk, at, bsdf, context);
        recorder.setIntersectionEstimate([&] { return radianceColor(walk.estimate); });
        if (!scatter(walk, at, bsdf, depth, context)) break;
    }
    if (context.tally)
        context.tally->end(vertex, [&](const SampledSpectrum& s) { return view_.colors.radiance(s, lambda); });
    recorder.addPathData("end", std::string_view(walk.end));
    return walk.estimate;
}

void EmcaPathIntegrator::arrive(const Walk& walk, const pbrt::SurfaceInteraction& at, int vertex,
                                PathContext& context) const {
    emca::PathRecorder& recorder = context.recorder;
    recorder.setDepthIndex(vertex);
    if (!context.watch) return;
    const SurfacePlace place = view_.surfaces.at(context.watch->lastHit(), at);
    const Vec3f position = view_.world.point(at.p());
    const SampledSpectrum throughput = context.cameraWeight * walk.throughput;
    const auto toColor = [&](const SampledSpectrum& factor) { return view_.colors.factor(factor, walk.lambda); };
    recorder.setIntersectionPos(position);
    if (place.known()) recorder.setIntersectionSurface(place.mesh, place.face);
    recorder.addIntersectionData("throughput", [&] { return toColor(throughput); });
    std::array<float, pbrt::NSpectrumSamples> store;
    recorder.addIntersectionData("throughput (spectrum)", [&] { return values(throughput, store); });
    if (place.known()) {
        recorder.addIntersectionData(
            "shape", [&] { return std::string_view(view_.surfaces.meshes()[std::size_t(place.mesh)].name); });
    }
    if (context.tally) {
        context.tally->intersection({place.mesh, place.face, position});
        context.tally->throughput(throughput, toColor);
    }
}

void EmcaPathIntegrator::environmentLight(Walk& walk, PathContext& context) const {
    emca::PathRecorder& recorder = context.recorder;
    recorder.setIntersectionPosEnvmap([&] { return view_.environmentPoint(walk.ray); });
    recorder.setIntersectionEvent(Event::background);
    recorder.addIntersectionData(
        "throughput", [&] { return view_.colors.factor(context.cameraWeight * walk.throughput, walk.lambda); });
    SampledSpectrum emission(0);
    for (const pbrt::Light& light : infiniteLights) {
        const SampledSpectrum Le = light.Le(walk.ray, walk.lambda);
        Float weight = 1;
        if (walk.alone) {
            walk.estimate += walk.throughput * Le;
        } else {
            const Float lightDensity = lightSampler_.PMF(walk.from, light) * light.PDF_Li(walk.from, walk.ray.d, true);
            weight = pbrt::PowerHeuristic(1, walk.scatteringDensity, 1, lightDensity);
            walk.estimate += walk.throughput * weight * Le;
            recorder.addIntersectionData("light pdf (hit)", number(lightDensity));
        }
        emission += Le;
        if (context.tally) context.tally->hit(weight * Le);
        recorder.addIntersectionData("MIS weight (hit)", number(weight));
        recorder.addIntersectionData("light (hit)", [&] { return view_.surfaces.lightName(light); });
        recorder.addContribution(
            [&] { return view_.colors.radiance(context.cameraWeight * walk.throughput * weight * Le, walk.lambda); },
            walk.alone ? "emitter hit" : "BSDF sampling", number(weight), LightEnd::hit);
    }
    recorder.setIntersectionEmission([&] { return view_.colors.radiance(emission, walk.lambda); });
}

void EmcaPathIntegrator::emittedLight(Walk& walk, const pbrt::SurfaceInteraction& at, PathContext& context) const {
    emca::PathRecorder& recorder = context.recorder;
    const SampledSpectrum Le = at.Le(-walk.ray.d, walk.lambda);
    if (at.areaLight) recorder.setIntersectionEmission([&] { return view_.colors.radiance(Le, walk.lambda); });
    if (!Le) return;
    Float weight = 1;
    if (walk.alone) {
        walk.estimate += walk.throughput * Le;
    } else {
        const Float lightDensity =
            lightSampler_.PMF(walk.from, at.areaLight) * at.areaLight.PDF_Li(walk.from, walk.ray.d, true);
        weight = pbrt::PowerHeuristic(1, walk.scatteringDensity, 1, lightDensity);
        walk.estimate += walk.throughput * weight * Le;
        recorder.addIntersectionData("light pdf (hit)", number(lightDensity));
    }
    if (context.tally) context.tally->hit(weight * Le);
    recorder.addIntersectionData("MIS weight (hit)", number(weight));
    recorder.addIntersectionData("light (hit)", [&] { return view_.surfaces.lightName(at.areaLight); });
    recorder.addContribution(
        [&] { return view_.colors.radiance(context.cameraWeight * walk.throughput * weight * Le, walk.lambda); },
        walk.alone ? "emitter hit" : "BSDF sampling", number(weight), LightEnd::hit);
}

void EmcaPathIntegrator::sampledLight(Walk& walk, const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf,
                                      PathContext& context) const {
    emca::PathRecorder& recorder = context.recorder;
    // From the side on which the surface scatters, so that rounding does not hide the light behind it.
    pbrt::LightSampleContext from(at);
    const bool reflects = IsReflective(bsdf.Flags()), transmits = IsTransmissive(bsdf.Flags());
    if (reflects != transmits) from.pi = at.OffsetRayOrigin(reflects ? at.wo : -at.wo);

    const Float uChoice = walk.sampler.Get1D();
    const auto choice = lightSampler_.Sample(from, uChoice);
    const pbrt::Point2f uPoint = walk.sampler.Get2D();
    recorder.addIntersectionData("random number (light choice)", number(uChoice));
    recorder.addIntersectionData("random numbers (light)", numbers(uPoint));
    if (!choice) return;
    recorder.addIntersectionData("light", [&] { return view_.surfaces.lightName(choice->light); });
    recorder.addIntersectionData("light choice probability", number(choice->p));

    const auto light = choice->light.SampleLi(from, uPoint, walk.lambda, true);
    if (!light || !light->L || light->pdf == 0) return;
    const Float lightDensity = choice->p * light->pdf;
    recorder.addIntersectionData("light pdf", number(lightDensity));
    if (context.tally && context.tally->wantsNextEvents()) {
        const SurfacePlace place = view_.surfaces.onLight(choice->light, light->pLight);
        context.tally->nextEvent({place.mesh, place.face, view_.world.point(light->pLight.p())});
    }

    const pbrt::Vector3f wo = at.wo, wi = light->wi;
    const SampledSpectrum f = bsdf.f(wo, wi) * AbsDot(wi, at.shading.n);
    if (!f) return;
    const bool visible = Unoccluded(at, light->pLight);
    recorder.setNextEventEstimationPos([&] { return view_.world.point(light->pLight.p()); }, visible);
    recorder.addIntersectionData("BSDF value (light)", [&] { return view_.colors.factor(f, walk.lambda); });
    const bool delta = IsDeltaLight(choice->light.Type());
    // Asked for by what is recorded also where the light is hidden; that changes nothing, as no number is drawn.
    const auto weightOf = [&](Float bsdfDensity) {
        return delta ? Float(1) : pbrt::PowerHeuristic(1, lightDensity, 1, bsdfDensity);
    };
    if (context.watch) {
        const Float bsdfDensity = density(bsdf, wo, wi);
        recorder.addIntersectionData("BSDF pdf (light)", number(bsdfDensity));
        recorder.addIntersectionData("MIS weight (light)", number(weightOf(bsdfDensity)));
        if (context.tally) context.tally->misWeight(number(weightOf(bsdfDensity)));
    }
    if (!visible) return;

    SampledSpectrum direct;
    Float weight = 1;
    if (delta) {
        direct = light->L * f / lightDensity;
    } else {
        weight = weightOf(density(bsdf, wo, wi));
        direct = weight * light->L * f / lightDensity;
    }
    walk.estimate += walk.throughput * direct;
    if (context.tally) context.tally->direct(direct);
    recorder.addContribution(
        [&] { return view_.colors.radiance(context.cameraWeight * walk.throughput * direct, walk.lambda); },
        "light sampling", number(weight), LightEnd::connected);
}

bool EmcaPathIntegrator::scatter(Walk& walk, const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf, int depth,
                                 PathContext& context) const {
    emca::PathRecorder& recorder = context.recorder;
    const auto material = [&] { return view_.materials.of(at.material); };
    const pbrt::Vector3f wo = -walk.ray.d;
    const Float uLobe = walk.sampler.Get1D();
    const pbrt::Point2f uDirection = walk.sampler.Get2D();
    recorder.addIntersectionData("random number (lobe)", number(uLobe));
    recorder.addIntersectionData("random numbers (direction)", numbers(uDirection));
    const auto sample = bsdf.Sample_f(wo, uLobe, uDirection);
    if (!sample) {
        recorder.setIntersectionEvent(at.areaLight ? Event::emission : Event::absorb, Lobe::none, material);
        if (context.tally) context.tally->invalidDirection();
        walk.end = "absorbed";
        return false;
    }
    walk.throughput *= sample->f * AbsDot(sample->wi, at.shading.n) / sample->pdf;
    walk.scatteringDensity = sample->pdfIsProportional ? density(bsdf, wo, sample->wi) : sample->pdf;
    walk.alone = sample->IsSpecular();
    walk.rough |= !sample->IsSpecular();
    if (sample->IsTransmission()) walk.etaScale *= pbrt::Sqr(sample->eta);
    walk.from = at;

    const auto factor = [&] { return sample->f * (AbsDot(sample->wi, at.shading.n) / sample->pdf); };
    recorder.setIntersectionEvent(eventOf(sample->flags), lobeOf(sample->flags), material);
    recorder.addIntersectionData("BSDF pdf", number(walk.scatteringDensity));
    recorder.addIntersectionData("BSDF weight", [&] { return view_.colors.factor(factor(), walk.lambda); });
    if (sample->eta != 1) recorder.addIntersectionData("relative index of refraction", number(sample->eta));

    walk.ray = at.SpawnRay(walk.ray, bsdf, sample->wi, sample->flags, sample->eta);
    const SampledSpectrum seen = walk.throughput * walk.etaScale;
    Float survival = 1;
    if (seen.MaxComponentValue() < 1 && depth > 1) {
        const Float quit = std::max<Float>(0, 1 - seen.MaxComponentValue());
        const Float u = walk.sampler.Get1D();
        recorder.addIntersectionData("roulette survival probability", number(1 - quit));
        recorder.addIntersectionData("random number (roulette)", number(u));
        if (u < quit) {
            if (context.tally) context.tally->rouletteEnd();
            walk.end = "Russian roulette";
            return false;
        }
        survival = 1 - quit;
        walk.throughput /= survival;
    }
    if (context.tally) context.tally->scattered(factor() / survival);
    return true;
}

}  // namespace emca::pbrt4
