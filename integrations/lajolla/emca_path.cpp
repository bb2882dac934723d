#include "emca_path.h"

#include <algorithm>
#include <cmath>

namespace emca::lajolla {

namespace {

constexpr int kLargestVertex = 4096;         ///< a chain of borders between media has an end
constexpr Real kLargestSurvival = Real(0.95);

/// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2.4, exponent 2.
Real powerHeuristic(Real pdf, Real otherPdf) {
    if (!(pdf > 0)) return 0;
    const Real ratio = otherPdf / pdf;
    return 1 / (1 + ratio * ratio);
}

bool isZero(const Spectrum& s) { return s.x == 0 && s.y == 0 && s.z == 0; }
Real largest(const Spectrum& s) { return std::max(s.x, std::max(s.y, s.z)); }
Vec2d recordable(const Vector2& u) { return {double(u.x), double(u.y)}; }

/// lajolla's lobes are microfacets of some roughness, or diffuse: those say 1.
Lobe lobeOf(const BSDFSampleRecord& sample) { return sample.roughness < 1 ? Lobe::glossy : Lobe::diffuse; }

}  // namespace

Spectrum EmcaPath::radiance(Ray ray, RayDifferential cone, Random& random, PathRecorder emca, SurfaceTally* tally) const {
    Spectrum estimate = make_zero_spectrum(), throughput{1, 1, 1};
    Real eta = 1;  // product of relative indices of refraction: roulette must not see radiance squeezed inside glass
    Arrival arrival{ray.org};
    const char* end = "";
    std::optional<PathVertex> hit = intersect(scene_, ray, cone);

    for (int vertex = 1, depth = 1;; ++vertex) {
        emca.setDepthIndex(vertex);
        if (!hit) {
            if (tally) tally->elsewhere();
            estimate += environmentLight(ray, cone.spread, arrival, throughput, emca, tally);
            emca.setIntersectionEstimate(estimate);
            emca.addPathData("left scene", true);
            end = "left the scene";
            break;
        }
        const PathVertex at = *hit;
        emca.setIntersectionPos(at.position);
        emca.setIntersectionSurface(at.shape_id, loaded_.faceOf(at));
        emca.addIntersectionData("shape", [&] { return std::string_view(loaded_.shapeName(at.shape_id)); });
        emca.addIntersectionData("material", [&] { return std::string_view(loaded_.materialName(at.material_id)); });
        emca.addIntersectionData("throughput", [&] { return toColor(throughput); });
        if (tally) tally->intersection(at), tally->throughput(throughput);

        if (at.material_id < 0 && vertex < kLargestVertex) {  // a border between media, which light does not notice
            emca.setIntersectionEvent(Event::pass, Lobe::straight, loaded_.materialName(at.material_id));
            if (tally) tally->scattered({1, 1, 1});
            ray.org = at.position;
            ray.tnear = get_intersection_epsilon(scene_);
            hit = intersect(scene_, ray);
            continue;
        }

        estimate += emittedLight(at, ray, arrival, throughput, emca, tally);
        const bool onLight = is_light(scene_.shapes[static_cast<std::size_t>(at.shape_id)]);
        const auto label = [&] { return std::string_view(loaded_.materialName(at.material_id)); };
        if (depth == maximumDepth_ || vertex == kLargestVertex) {
            emca.setIntersectionEvent(onLight ? Event::emission : Event::absorb, Lobe::none, label);
            emca.setIntersectionEstimate(estimate);
            end = depth == maximumDepth_ ? "maximum depth" : "too many vertices";
            break;
        }

        const Vector3 wo = -ray.dir;
        estimate += sampledLight(at, wo, throughput, random, emca, tally);
        emca.setIntersectionEstimate(estimate);

        const Material& material = scene_.materials[static_cast<std::size_t>(at.material_id)];
        const Vector2 uDirection{random.next(), random.next()};
        const Real uLobe = random.next();
        emca.addIntersectionData("random numbers (direction)", [&] { return recordable(uDirection); });
        emca.addIntersectionData("random number (lobe)", uLobe);
        const std::optional<BSDFSampleRecord> scattered = sample_bsdf(material, wo, at, scene_.texture_pool, uDirection, uLobe);
        const Real pdf = scattered ? pdf_sample_bsdf(material, wo, scattered->dir_out, at, scene_.texture_pool) : Real(0);
        const Spectrum value = pdf > 0 ? eval(material, wo, scattered->dir_out, at, scene_.texture_pool) : make_zero_spectrum();
        emca.addIntersectionData("BSDF pdf", pdf);
        if (isZero(value)) {
            emca.setIntersectionEvent(onLight ? Event::emission : Event::absorb, Lobe::none, label);
            if (tally) tally->invalidDirection();
            end = "absorbed";
            break;
        }
        const bool transmitted = scattered->eta != 0;
        const Spectrum weight = value / pdf;
        throughput *= weight;
        if (transmitted) eta *= scattered->eta;
        cone.spread = transmitted ? refract(cone, at.mean_curvature, scattered->eta, scattered->roughness)
                                  : reflect(cone, at.mean_curvature, scattered->roughness);
        emca.setIntersectionEvent(transmitted ? Event::transmit : Event::reflect, lobeOf(*scattered), label);
        emca.addIntersectionData("BSDF value", [&] { return toColor(value); });
        emca.addIntersectionData("BSDF weight", [&] { return toColor(weight); });
        emca.addIntersectionData("roughness", scattered->roughness);
        if (transmitted) emca.addIntersectionData("relative index of refraction", scattered->eta);

        Real survival = 1;
        if (depth + 1 >= scene_.options.rr_depth) {
            survival = std::min(largest(throughput) * eta * eta, kLargestSurvival);
            const Real u = random.next();
            emca.addIntersectionData("roulette survival probability", survival);
            emca.addIntersectionData("random number (roulette)", u);
            if (u >= survival) {
                if (tally) tally->rouletteEnd();
                end = "Russian roulette";
                break;
            }
            throughput = throughput / survival;
        }
        if (tally) tally->scattered(weight / survival);

        arrival = {at.position, pdf, false};
        ray = Ray{at.position, scattered->dir_out, get_intersection_epsilon(scene_), infinity<Real>()};
        hit = intersect(scene_, ray);
        ++depth;
    }
    if (tally) tally->end();
    emca.addPathData("end", std::string_view(end));
    emca.setFinalEstimate(estimate);
    return estimate;
}

Spectrum EmcaPath::emittedLight(const PathVertex& at, const Ray& ray, const Arrival& arrival, const Spectrum& throughput,
                                PathRecorder emca, SurfaceTally* tally) const {
    const int id = get_area_light_id(scene_.shapes[static_cast<std::size_t>(at.shape_id)]);
    if (id < 0) return make_zero_spectrum();
    const Spectrum emission = ::emission(at, -ray.dir, scene_);
    emca.setIntersectionEmission(emission);
    if (isZero(emission)) return emission;
    emca.addIntersectionData("light (hit)", [&] { return std::string_view(loaded_.lightName(id)); });
    Real pdf = 0;
    if (!arrival.direct) {
        const PointAndNormal point{at.position, at.geometric_normal};
        const Real areaPdf = light_pmf(scene_, id) * pdf_point_on_light(scene_.lights[static_cast<std::size_t>(id)], point, arrival.from, scene_);
        pdf = areaPdf * distance_squared(at.position, arrival.from) / std::abs(::dot(ray.dir, at.geometric_normal));
        emca.addIntersectionData("light pdf (hit)", pdf);
    }
    return addHit(emission, pdf, arrival, throughput, emca, tally);
}

Spectrum EmcaPath::environmentLight(const Ray& ray, Real spread, const Arrival& arrival, const Spectrum& throughput, PathRecorder emca,
                                    SurfaceTally* tally) const {
    emca.setIntersectionPosEnvmap([&] { return loaded_.beyond(ray); });
    emca.setIntersectionEvent(Event::background);
    emca.addIntersectionData("throughput", [&] { return toColor(throughput); });
    if (!has_envmap(scene_)) return make_zero_spectrum();
    const Light& light = get_envmap(scene_);
    const Spectrum emission = ::emission(light, -ray.dir, spread, PointAndNormal{}, scene_);
    emca.setIntersectionEmission(emission);
    if (isZero(emission)) return emission;
    emca.addIntersectionData("light (hit)", [&] { return std::string_view(loaded_.lightName(scene_.envmap_light_id)); });
    Real pdf = 0;
    if (!arrival.direct) {
        const PointAndNormal direction{Vector3{0, 0, 0}, -ray.dir};
        pdf = light_pmf(scene_, scene_.envmap_light_id) * pdf_point_on_light(light, direction, arrival.from, scene_);
        emca.addIntersectionData("light pdf (hit)", pdf);
    }
    return addHit(emission, pdf, arrival, throughput, emca, tally);
}

Spectrum EmcaPath::addHit(const Spectrum& emission, Real lightPdf, const Arrival& arrival, const Spectrum& throughput, PathRecorder emca,
                          SurfaceTally* tally) const {
    const Real weight = arrival.direct ? Real(1) : powerHeuristic(arrival.pdf, lightPdf);
    const Spectrum contribution = throughput * emission * weight;
    if (tally) tally->hit(emission * weight);
    emca.addIntersectionData("MIS weight (hit)", weight);
    emca.addContribution(contribution, arrival.direct ? "emitter hit" : "BSDF sampling", static_cast<float>(weight), LightEnd::hit);
    return contribution;
}

EmcaPath::LightSample EmcaPath::sampleLight(const PathVertex& at, Random& random, PathRecorder emca, SurfaceTally* tally) const {
    const Vector2 uPoint{random.next(), random.next()};
    const Real uLight = random.next(), uTriangle = random.next();
    const int id = sample_light(scene_, uLight);
    const Light& light = scene_.lights[static_cast<std::size_t>(id)];
    const PointAndNormal point = sample_point_on_light(light, at.position, uPoint, uTriangle, scene_);
    emca.addIntersectionData("random numbers (light)", [&] { return recordable(uPoint); });
    emca.addIntersectionData("random number (light choice)", uLight);
    emca.addIntersectionData("random number (triangle)", uTriangle);
    emca.addIntersectionData("light", [&] { return std::string_view(loaded_.lightName(id)); });
    if (tally) tally->nextEvent(light, point, uTriangle);

    const Real pointPdf = light_pmf(scene_, id) * pdf_point_on_light(light, point, at.position, scene_);
    LightSample sample;
    if (is_envmap(light)) {  // where a direction is all there is
        sample.direction = -point.normal;
        sample.position = loaded_.beyond(Ray{at.position, sample.direction, 0, 0});
        sample.distance = infinity<Real>();
        sample.pdf = pointPdf;
    } else {
        const Vector3 towards = point.position - at.position;
        sample.distance = ::length(towards);
        sample.direction = towards / sample.distance;
        sample.position = point.position;
        const Real cosine = -::dot(sample.direction, point.normal);
        sample.pdf = cosine > 0 ? pointPdf * sample.distance * sample.distance / cosine : Real(0);
        emca.addIntersectionData("light pdf_area", pointPdf);
    }
    emca.addIntersectionData("light pdf", sample.pdf);
    sample.radiance = sample.pdf > 0 ? ::emission(light, -sample.direction, Real(0), point, scene_) : make_zero_spectrum();
    return sample;
}

Spectrum EmcaPath::sampledLight(const PathVertex& at, const Vector3& wo, const Spectrum& throughput, Random& random, PathRecorder emca,
                                SurfaceTally* tally) const {
    if (scene_.lights.empty()) return make_zero_spectrum();
    const LightSample light = sampleLight(at, random, emca, tally);
    if (isZero(light.radiance)) return make_zero_spectrum();
    const Material& material = scene_.materials[static_cast<std::size_t>(at.material_id)];
    const Spectrum value = eval(material, wo, light.direction, at, scene_.texture_pool);
    const Real bsdfPdf = pdf_sample_bsdf(material, wo, light.direction, at, scene_.texture_pool);
    emca.addIntersectionData("BSDF value (light)", [&] { return toColor(value); });
    emca.addIntersectionData("BSDF pdf (light)", bsdfPdf);
    if (isZero(value)) return make_zero_spectrum();

    const Real weight = powerHeuristic(light.pdf, bsdfPdf);
    const Real epsilon = get_shadow_epsilon(scene_);
    const bool visible = !occluded(scene_, Ray{at.position, light.direction, epsilon, (1 - epsilon) * light.distance});
    emca.setNextEventEstimationPos(light.position, visible);
    if (tally) tally->misWeight(weight), tally->shadowTest(visible);
    if (!visible) return make_zero_spectrum();
    const Spectrum reflected = value * light.radiance * (weight / light.pdf);
    const Spectrum contribution = throughput * reflected;
    if (tally) tally->direct(reflected);
    emca.addIntersectionData("MIS weight (light)", weight);
    emca.addContribution(contribution, "light sampling", static_cast<float>(weight), LightEnd::connected);
    return contribution;
}

}  // namespace emca::lajolla
