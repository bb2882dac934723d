// What the linker puts in place of lajolla's functions (--wrap): each calls the real one and tells the observer of this
// thread, if there is one. So integrators are seen whose source knows nothing of it, and their bits stay the same.
#include "emca/adapter/exchanged.h"
#include "lajolla_headers.h"
#include "observed_names.h"
#include "observer.h"

#define EMCA_WRAPPED(result, name, ...)                                     \
    result real_##name(__VA_ARGS__) __asm__("__real_" EMCA_NAME_##name); \
    __attribute__((used)) result wrap_##name(__VA_ARGS__) __asm__("__wrap_" EMCA_NAME_##name)

using emca::adapter::Exchanged;
using emca::lajolla::cameraRayOverride;
using emca::lajolla::currentObserver;
using emca::lajolla::Observer;

EMCA_WRAPPED(Ray, sample_primary, const Camera&, const Vector2&);
EMCA_WRAPPED(std::optional<PathVertex>, intersect, const Scene&, const Ray&, const RayDifferential&);
EMCA_WRAPPED(bool, occluded, const Scene&, const Ray&);
EMCA_WRAPPED(int, sample_light, const Scene&, Real);
EMCA_WRAPPED(Real, light_pmf, const Scene&, int);
EMCA_WRAPPED(PointAndNormal, sample_point_on_light, const Light&, const Vector3&, const Vector2&, Real, const Scene&);
EMCA_WRAPPED(Real, pdf_point_on_light, const Light&, const PointAndNormal&, const Vector3&, const Scene&);
EMCA_WRAPPED(Spectrum, light_emission, const Light&, const Vector3&, Real, const PointAndNormal&, const Scene&);
EMCA_WRAPPED(Spectrum, hit_emission, const PathVertex&, const Vector3&, const Scene&);
EMCA_WRAPPED(Spectrum, eval_bsdf, const Material&, const Vector3&, const Vector3&, const PathVertex&, const TexturePool&, TransportDirection);
EMCA_WRAPPED(std::optional<BSDFSampleRecord>, sample_bsdf, const Material&, const Vector3&, const PathVertex&, const TexturePool&, const Vector2&,
             const Real&, TransportDirection);
EMCA_WRAPPED(Real, pdf_sample_bsdf, const Material&, const Vector3&, const Vector3&, const PathVertex&, const TexturePool&, TransportDirection);
EMCA_WRAPPED(Spectrum, eval_phase, const PhaseFunction&, const Vector3&, const Vector3&);
EMCA_WRAPPED(std::optional<Vector3>, sample_phase_function, const PhaseFunction&, const Vector3&, const Vector2&);
EMCA_WRAPPED(Real, pdf_sample_phase, const PhaseFunction&, const Vector3&, const Vector3&);

Ray wrap_sample_primary(const Camera& camera, const Vector2& screen) {
    const Ray ray = cameraRayOverride() ? *cameraRayOverride() : real_sample_primary(camera, screen);
    if (Observer* observer = currentObserver()) observer->cameraRay(screen, ray);
    return ray;
}

std::optional<PathVertex> wrap_intersect(const Scene& scene, const Ray& ray, const RayDifferential& cone) {
    const std::optional<PathVertex> hit = real_intersect(scene, ray, cone);
    if (Observer* observer = currentObserver()) observer->intersected(ray, hit);
    return hit;
}

bool wrap_occluded(const Scene& scene, const Ray& ray) {
    const bool hit = real_occluded(scene, ray);
    if (Observer* observer = currentObserver()) observer->shadowTested(ray, hit);
    return hit;
}

int wrap_sample_light(const Scene& scene, Real u) {
    const int light = real_sample_light(scene, u);
    if (Observer* observer = currentObserver()) observer->lightChosen(u, light);
    return light;
}

Real wrap_light_pmf(const Scene& scene, int light) {
    const Real probability = real_light_pmf(scene, light);
    if (Observer* observer = currentObserver()) observer->lightProbability(light, probability);
    return probability;
}

PointAndNormal wrap_sample_point_on_light(const Light& light, const Vector3& from, const Vector2& u, Real w, const Scene& scene) {
    const PointAndNormal point = real_sample_point_on_light(light, from, u, w, scene);
    if (Observer* observer = currentObserver()) observer->lightSampled(light, from, u, w, point);
    return point;
}

Real wrap_pdf_point_on_light(const Light& light, const PointAndNormal& point, const Vector3& from, const Scene& scene) {
    const Real pdf = real_pdf_point_on_light(light, point, from, scene);
    if (Observer* observer = currentObserver()) observer->lightPdf(light, point, pdf);
    return pdf;
}

Spectrum wrap_light_emission(const Light& light, const Vector3& direction, Real footprint, const PointAndNormal& point, const Scene& scene) {
    const Spectrum emission = real_light_emission(light, direction, footprint, point, scene);
    if (Observer* observer = currentObserver()) observer->emitted(&light, nullptr, point, emission);
    return emission;
}

Spectrum wrap_hit_emission(const PathVertex& hit, const Vector3& direction, const Scene& scene) {
    const Spectrum emission = [&] {
        const Exchanged unobserved(currentObserver(), nullptr);  // what it calls inside is not the integrator's
        return real_hit_emission(hit, direction, scene);
    }();
    if (Observer* observer = currentObserver()) observer->emitted(nullptr, &hit, {hit.position, hit.geometric_normal}, emission);
    return emission;
}

Spectrum wrap_eval_bsdf(const Material& material, const Vector3& in, const Vector3& out, const PathVertex& vertex, const TexturePool& textures,
                        TransportDirection transport) {
    const Spectrum value = real_eval_bsdf(material, in, out, vertex, textures, transport);
    if (Observer* observer = currentObserver()) observer->bsdfValue(out, vertex, value);
    return value;
}

std::optional<BSDFSampleRecord> wrap_sample_bsdf(const Material& material, const Vector3& in, const PathVertex& vertex, const TexturePool& textures,
                                                 const Vector2& u, const Real& w, TransportDirection transport) {
    const std::optional<BSDFSampleRecord> sample = real_sample_bsdf(material, in, vertex, textures, u, w, transport);
    if (Observer* observer = currentObserver()) observer->bsdfSampled(vertex, u, w, sample);
    return sample;
}

Real wrap_pdf_sample_bsdf(const Material& material, const Vector3& in, const Vector3& out, const PathVertex& vertex, const TexturePool& textures,
                          TransportDirection transport) {
    const Real pdf = real_pdf_sample_bsdf(material, in, out, vertex, textures, transport);
    if (Observer* observer = currentObserver()) observer->bsdfPdf(out, vertex, pdf);
    return pdf;
}

Spectrum wrap_eval_phase(const PhaseFunction& phase, const Vector3& in, const Vector3& out) {
    const Spectrum value = real_eval_phase(phase, in, out);
    if (Observer* observer = currentObserver()) observer->phaseValue(out, value);
    return value;
}

std::optional<Vector3> wrap_sample_phase_function(const PhaseFunction& phase, const Vector3& in, const Vector2& u) {
    const std::optional<Vector3> direction = real_sample_phase_function(phase, in, u);
    if (Observer* observer = currentObserver()) observer->phaseSampled(u, direction);
    return direction;
}

Real wrap_pdf_sample_phase(const PhaseFunction& phase, const Vector3& in, const Vector3& out) {
    const Real pdf = real_pdf_sample_phase(phase, in, out);
    if (Observer* observer = currentObserver()) observer->phasePdf(out, pdf);
    return pdf;
}
