// Never linked. Compiled to assembly, from which observed_names.cmake reads what the linker calls lajolla's functions:
// that depends on the person's headers (how precise Real is, which materials a Material may be).
#include "lajolla_headers.h"

#define EMCA_ADDRESS(name, function, ...) \
    extern "C" { __attribute__((used)) __VA_ARGS__ emca_name_##name = &function; }

template <typename R, typename... A>
using Function = R (*)(A...);

EMCA_ADDRESS(sample_primary, sample_primary, Function<Ray, const Camera&, const Vector2&>)
EMCA_ADDRESS(intersect, intersect, Function<std::optional<PathVertex>, const Scene&, const Ray&, const RayDifferential&>)
EMCA_ADDRESS(occluded, occluded, Function<bool, const Scene&, const Ray&>)
EMCA_ADDRESS(sample_light, sample_light, Function<int, const Scene&, Real>)
EMCA_ADDRESS(light_pmf, light_pmf, Function<Real, const Scene&, int>)
EMCA_ADDRESS(sample_point_on_light, sample_point_on_light, Function<PointAndNormal, const Light&, const Vector3&, const Vector2&, Real, const Scene&>)
EMCA_ADDRESS(pdf_point_on_light, pdf_point_on_light, Function<Real, const Light&, const PointAndNormal&, const Vector3&, const Scene&>)
EMCA_ADDRESS(light_emission, emission, Function<Spectrum, const Light&, const Vector3&, Real, const PointAndNormal&, const Scene&>)
EMCA_ADDRESS(hit_emission, emission, Function<Spectrum, const PathVertex&, const Vector3&, const Scene&>)
EMCA_ADDRESS(eval_bsdf, eval, Function<Spectrum, const Material&, const Vector3&, const Vector3&, const PathVertex&, const TexturePool&, TransportDirection>)
EMCA_ADDRESS(sample_bsdf, sample_bsdf,
             Function<std::optional<BSDFSampleRecord>, const Material&, const Vector3&, const PathVertex&, const TexturePool&, const Vector2&, const Real&, TransportDirection>)
EMCA_ADDRESS(pdf_sample_bsdf, pdf_sample_bsdf,
             Function<Real, const Material&, const Vector3&, const Vector3&, const PathVertex&, const TexturePool&, TransportDirection>)
EMCA_ADDRESS(eval_phase, eval, Function<Spectrum, const PhaseFunction&, const Vector3&, const Vector3&>)
EMCA_ADDRESS(sample_phase_function, sample_phase_function, Function<std::optional<Vector3>, const PhaseFunction&, const Vector3&, const Vector2&>)
EMCA_ADDRESS(pdf_sample_phase, pdf_sample_phase, Function<Real, const PhaseFunction&, const Vector3&, const Vector3&>)
