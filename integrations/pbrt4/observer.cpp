#include "observer.h"

#include <cmath>

namespace emca::pbrt4 {

namespace {

/// pbrt shortens rays towards a point by this much, so that they do not hit what is there.
constexpr pbrt::Float kToPoint = 1 - pbrt::ShadowEpsilon;

/// Subsurface scattering looks for surfaces along a segment of exactly this length.
constexpr pbrt::Float kProbe = 1;

/// Where a medium is, a ray that starts farther from the last hit than this part of its distance started inside it.
constexpr pbrt::Float kAtSurface = 1e-3f;

}  // namespace

void PathObserver::begin(const pbrt::SampledWavelengths& lambda) {
    lambda_ = &lambda;
    arrival_.pending = false;
    vertex_ = 0;
    hasBsdf_ = scattered_ = left_ = false;
}

void PathObserver::end() {
    flush(nullptr);
    if (vertex_ > 0 && !scattered_ && !left_) {
        recorder_.setIntersectionEvent(arrival_.at.areaLight ? Event::emission : Event::absorb, Lobe::none,
                                       [&] { return view_.materials.of(arrival_.at.material); });
    }
    recorder_.addPathData("end", std::string_view(left_ ? "left the scene" : "inside the scene"));
    if (left_) recorder_.addPathData("left scene", true);
    if (tally_) tally_->end(vertex_);
}

void PathObserver::traced(const pbrt::Ray& ray, pbrt::Float tMax, const pbrt::SurfaceInteraction* hit,
                          const HitChain& chain) {
    if (tMax == kProbe) return;
    departure(ray);
    if (tMax == kToPoint) {  // a shadow ray through media and boundaries, segment by segment
        if (!hit || hit->material)
            recorder_.setNextEventEstimationPos([&] { return view_.world.point(ray.o + ray.d); }, hit == nullptr);
        return;
    }
    if (vertex_ > 0) recordDirection(ray.d);
    ++vertex_;
    hasBsdf_ = scattered_ = false;
    recorder_.setDepthIndex(vertex_);
    if (!hit) {
        left_ = true;
        if (tally_) tally_->background();
        recorder_.setIntersectionPosEnvmap([&] { return view_.environmentPoint(ray); });
        recorder_.setIntersectionEvent(Event::background);
        return;
    }
    arrival_ = {ray, *hit, chain, true};
    if (!ray.medium) flush(nullptr);
}

void PathObserver::tested(const pbrt::Ray& ray, pbrt::Float tMax, bool blocked) {
    departure(ray);
    if (vertex_ == 0) return;
    // Towards a light: a segment to a point. Ambient occlusion asks along a direction.
    const bool toPoint = tMax == kToPoint;
    recorder_.setNextEventEstimationPos(
        [&] {
            if (toPoint) return view_.world.point(ray.o + ray.d);
            return std::isinf(tMax) ? view_.environmentPoint(ray) : view_.world.point(ray.o + tMax * ray.d);
        },
        !blocked);
}

void PathObserver::scattersBy(const pbrt::SurfaceInteraction& at, const pbrt::BSDF& bsdf) {
    flush(nullptr);  // only where the path did scatter on the surface, it is asked for its BSDF
    hasBsdf_ = bool(bsdf);
    bsdf_ = bsdf;
    arrival_.at.material = at.material;  // mixtures have chosen one now
    arrival_.at.shading = at.shading;    // and bumps are there
    recorder_.addIntersectionData("material", [&] { return view_.materials.of(at.material); });
}

/// A ray starts: from where tells whether the hit before was reached at all.
void PathObserver::departure(const pbrt::Ray& ray) { flush(&ray); }

void PathObserver::flush(const pbrt::Ray* next) {
    if (!arrival_.pending) return;
    arrival_.pending = false;
    const pbrt::Float distance = pbrt::Distance(arrival_.ray.o, arrival_.at.p());
    if (!next || pbrt::Distance(next->o, arrival_.at.p()) <= kAtSurface * distance) return recordSurface();
    recorder_.setIntersectionPos([&] { return view_.world.point(next->o); });
    recorder_.setIntersectionEvent(Event::volume, Lobe::none, "medium");
    scattered_ = true;
    if (tally_) tally_->background();
}

void PathObserver::recordSurface() {
    const pbrt::SurfaceInteraction& at = arrival_.at;
    const Vec3f position = view_.world.point(at.p());
    const SurfacePlace place = view_.surfaces.at(arrival_.chain, at);
    recorder_.setIntersectionPos(position);
    if (place.known()) {
        recorder_.setIntersectionSurface(place.mesh, place.face);
        recorder_.addIntersectionData(
            "shape", [&] { return std::string_view(view_.surfaces.meshes()[std::size_t(place.mesh)].name); });
    }
    if (at.areaLight) {
        recorder_.setIntersectionEmission(
            [&] { return view_.colors.radiance(at.Le(-arrival_.ray.d, *lambda_), *lambda_); });
        recorder_.addIntersectionData("light (hit)", [&] { return view_.surfaces.lightName(at.areaLight); });
    }
    if (tally_) tally_->intersection({place.mesh, place.face, position});
}

void PathObserver::recordDirection(pbrt::Vector3f wi) {
    if (scattered_ || left_) return;
    scattered_ = true;
    const pbrt::SurfaceInteraction& at = arrival_.at;
    const auto material = [&] { return view_.materials.of(at.material); };
    if (!hasBsdf_) {
        if (!at.material) recorder_.setIntersectionEvent(Event::pass, Lobe::straight, material);
        return;
    }
    const pbrt::Vector3f wo = -arrival_.ray.d;
    const bool through = Dot(wi, at.n) * Dot(wo, at.n) < 0;
    recorder_.setIntersectionEvent(through ? Event::transmit : Event::reflect, lobeOf(bsdf_.Flags()), material);
    if (!IsSpecular(bsdf_.Flags())) {
        recorder_.addIntersectionData("BSDF pdf", [&] { return static_cast<float>(bsdf_.PDF(wo, Normalize(wi))); });
    }
}

}  // namespace emca::pbrt4
