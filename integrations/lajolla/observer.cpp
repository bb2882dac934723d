#include "observer.h"

#include <cmath>

namespace emca::lajolla {

namespace {

/// Directions that agree but for rounding.
bool sameDirection(const Vector3& a, const Vector3& b) { return ::dot(a, b) > (Real(1) - Real(1e-9)) * ::length(a) * ::length(b); }
Vec2d recordable(const Vector2& u) { return {double(u.x), double(u.y)}; }
Lobe lobeOf(const BSDFSampleRecord& sample) { return sample.roughness < 1 ? Lobe::glossy : Lobe::diffuse; }

}  // namespace

Observer*& currentObserver() {
    thread_local Observer* observer = nullptr;
    return observer;
}

const Ray*& cameraRayOverride() {
    thread_local const Ray* ray = nullptr;
    return ray;
}

void Observer::beginPath(PathRecorder emca, SurfaceTally* tally) {
    emca_ = emca;
    tally_ = tally;
    depth_ = 0;
    begun_ = hereIsMedium_ = false;
    here_.reset(), waiting_.reset(), leaving_.reset(), sampled_.reset(), phase_.reset(), light_.reset(), choice_.reset(), shadowChain_.reset();
}

void Observer::endPath(const Spectrum& radiance) {
    endShadowChain();
    // Where there is no medium, the path surely came to its last hit.
    const bool unsaid = waiting_ || leaving_;
    if (unsaid && !medium_) {
        if (waiting_) beginSurfaceVertex(*waiting_);
        else beginBackgroundVertex();
    } else if (unsaid) {
        emca_.addPathData("last hit reached", std::string_view("unknown"));
    }
    if (tally_) tally_->end();
    emca_.setFinalEstimate(radiance);
}

bool Observer::near(const Vector3& a, const Vector3& b) const { return distance(a, b) <= 4 * get_intersection_epsilon(scene_); }

void Observer::arriveAt(const Vector3& position) {
    // Without media a path is at the hit that waits, however far off the surface it starts its next ray.
    if (waiting_ && (!medium_ || near(position, waiting_->position))) return beginSurfaceVertex(*waiting_);
    if (medium_ && !(here_ && near(position, *here_))) beginMediumVertex(position);
}

void Observer::beginVertex() {
    emca_.setDepthIndex(++depth_);
    waiting_.reset(), leaving_.reset(), sampled_.reset(), light_.reset();
}

void Observer::beginSurfaceVertex(const PathVertex& waiting) {
    const PathVertex hit = waiting;
    beginVertex();
    phase_.reset();
    here_ = hit.position;
    hereIsMedium_ = false;
    emca_.setIntersectionPos(hit.position);
    emca_.setIntersectionSurface(hit.shape_id, loaded_.faceOf(hit));
    emca_.addIntersectionData("shape", [&] { return std::string_view(loaded_.shapeName(hit.shape_id)); });
    emca_.addIntersectionData("material", [&] { return std::string_view(loaded_.materialName(hit.material_id)); });
    if (hit.material_id < 0) emca_.setIntersectionEvent(Event::pass, Lobe::straight, loaded_.materialName(hit.material_id));
    if (tally_) tally_->intersection(hit);
}

void Observer::beginMediumVertex(const Vector3& position) {
    beginVertex();
    here_ = position;
    hereIsMedium_ = true;
    emca_.setIntersectionPos(position);
    if (tally_) tally_->elsewhere();
    if (phase_) sayScattering();
}

void Observer::beginBackgroundVertex() {
    const Ray ray = *leaving_;
    beginVertex();
    here_.reset();
    emca_.setIntersectionPosEnvmap([&] { return loaded_.beyond(ray); });
    emca_.setIntersectionEvent(Event::background);
    emca_.addPathData("left scene", true);
    if (tally_) tally_->elsewhere();
}

/// A direction was sampled in the medium where the path is.
void Observer::sayScattering() {
    emca_.setIntersectionEvent(Event::volume, Lobe::glossy, "phase function");
    emca_.addIntersectionData("random numbers (direction)", recordable(*phase_->random));
    if (phase_->value) emca_.addIntersectionData("phase function value", toColor(*phase_->value));
    if (phase_->pdf) emca_.addIntersectionData("phase function pdf", *phase_->pdf);
    sampled_ = phase_;
    phase_.reset();
}

void Observer::saySampled(Sampled& sampled) {
    if (sampled.weightSaid || !sampled.value || !sampled.pdf || !(*sampled.pdf > 0)) return;
    sampled.weightSaid = true;
    emca_.addIntersectionData("BSDF weight", toColor(*sampled.value / *sampled.pdf));
}

void Observer::cameraRay(const Vector2& screen, const Ray& ray) {
    emca_.setPathOrigin(ray.org);
    emca_.addPathData("film position", Vec2d{double(screen.x) * scene_.camera.width, double(screen.y) * scene_.camera.height});
}

bool Observer::isShadowRay(const Ray& ray) const {
    if (!light_) return false;
    if (sampled_ && sameDirection(ray.dir, sampled_->direction)) return false;
    if (phase_ && sameDirection(ray.dir, phase_->direction)) return false;
    const Vector3 towards = light_->infinite ? light_->position : ::normalize(light_->position - ray.org);
    return sameDirection(ray.dir, towards);
}

Vector3 Observer::lightPosition(const Ray& ray) const {
    if (light_ && isShadowRay(ray) && !light_->infinite) return light_->position;
    return std::isfinite(ray.tfar) ? ray.org + ray.dir * ray.tfar : loaded_.beyond(ray);
}

void Observer::endShadowChain() {
    if (!shadowChain_) return;
    // Shadow rays that went through a border between media, and no further ones.
    emca_.setNextEventEstimationPos(*shadowChain_, false);
    shadowChain_.reset();
}

void Observer::intersected(const Ray& ray, const std::optional<PathVertex>& hit) {
    if (!begun_) {
        emca_.setPathOrigin(ray.org);
    } else if (isShadowRay(ray)) {  // volumetric integrators test visibility so, to see the media on the way
        const Vector3 light = lightPosition(ray);
        shadowChain_.reset();
        if (hit && hit->material_id < 0) {
            shadowChain_ = light;
            return;
        }
        emca_.setNextEventEstimationPos(light, !hit);
        if (tally_) tally_->shadowTest(!hit);
        return;
    } else {
        endShadowChain();
        arriveAt(ray.org);
    }
    begun_ = true;
    waiting_ = hit;
    leaving_ = hit ? std::optional<Ray>() : ray;
}

void Observer::shadowTested(const Ray& ray, bool occluded) {
    arriveAt(ray.org);
    emca_.setNextEventEstimationPos(lightPosition(ray), !occluded);
    if (tally_) tally_->shadowTest(!occluded);
}

void Observer::lightChosen(Real u, int light) { choice_ = LightChoice{u, light}; }  // of where the path is, lightSampled() tells

void Observer::lightProbability(int, Real probability) { emca_.addIntersectionData("light probability", probability); }

void Observer::lightSampled(const Light& light, const Vector3& from, const Vector2& u, Real uTriangle, const PointAndNormal& point) {
    endShadowChain();
    arriveAt(from);
    const bool infinite = is_envmap(light);
    light_ = {infinite ? -point.normal : point.position, infinite};
    if (choice_) {
        emca_.addIntersectionData("random number (light choice)", choice_->u);
        emca_.addIntersectionData("light", [&] { return std::string_view(loaded_.lightName(choice_->light)); });
        choice_.reset();
    }
    emca_.addIntersectionData("random numbers (light)", recordable(u));
    emca_.addIntersectionData("random number (triangle)", uTriangle);
    if (tally_) tally_->nextEvent(light, point, uTriangle);
}

void Observer::lightPdf(const Light& light, const PointAndNormal& point, Real pdf) {
    const bool infinite = is_envmap(light);
    const bool chosen = light_ && (infinite ? sameDirection(-point.normal, light_->position) : near(point.position, light_->position));
    // Without the probability of the light: that is another call.
    if (chosen && infinite) emca_.addIntersectionData("point pdf", pdf);
    else if (chosen) emca_.addIntersectionData("point pdf_area", pdf);
    else if (infinite) emca_.addIntersectionData("hit point pdf", pdf);
    else emca_.addIntersectionData("hit point pdf_area", pdf);
}

void Observer::emitted(const Light* light, const PathVertex* hit, const PointAndNormal& point, const Spectrum& emission) {
    if (hit) {
        arriveAt(hit->position);
        emca_.setIntersectionEmission(emission);
        return;
    }
    const bool infinite = is_envmap(*light);
    const bool chosen = light_ && (infinite ? sameDirection(-point.normal, light_->position) : near(point.position, light_->position));
    if (infinite && leaving_) {  // the point of an environment that a path met is not said
        beginBackgroundVertex();
        emca_.setIntersectionEmission(emission);
    } else if (chosen || infinite) {
        emca_.addIntersectionData("light emission", toColor(emission));
    }
}

void Observer::bsdfSampled(const PathVertex& at, const Vector2& u, Real uLobe, const std::optional<BSDFSampleRecord>& sample) {
    endShadowChain();
    arriveAt(at.position);
    emca_.addIntersectionData("random numbers (direction)", recordable(u));
    emca_.addIntersectionData("random number (lobe)", uLobe);
    const auto label = [&] { return std::string_view(loaded_.materialName(at.material_id)); };
    if (!sample) {
        emca_.setIntersectionEvent(Event::absorb, Lobe::none, label);
        if (tally_) tally_->invalidDirection();
        return;
    }
    sampled_ = Sampled{.direction = sample->dir_out, .random = u};
    emca_.setIntersectionEvent(sample->eta != 0 ? Event::transmit : Event::reflect, lobeOf(*sample), label);
    emca_.addIntersectionData("roughness", sample->roughness);
    if (sample->eta != 0) emca_.addIntersectionData("relative index of refraction", sample->eta);
}

void Observer::bsdfValue(const Vector3& direction, const PathVertex& at, const Spectrum& value) {
    if (waiting_ && near(at.position, waiting_->position)) arriveAt(at.position);
    if (sampled_ && sameDirection(direction, sampled_->direction)) {
        sampled_->value = value;
        emca_.addIntersectionData("BSDF value", toColor(value));
        saySampled(*sampled_);
    } else {
        emca_.addIntersectionData("BSDF value (light)", toColor(value));
    }
}

void Observer::bsdfPdf(const Vector3& direction, const PathVertex& at, Real pdf) {
    if (waiting_ && near(at.position, waiting_->position)) arriveAt(at.position);
    if (sampled_ && sameDirection(direction, sampled_->direction)) {
        sampled_->pdf = pdf;
        emca_.addIntersectionData("BSDF pdf", pdf);
        saySampled(*sampled_);
    } else {
        emca_.addIntersectionData("BSDF pdf (light)", pdf);
    }
}

void Observer::phaseSampled(const Vector2& u, const std::optional<Vector3>& direction) {
    endShadowChain();
    if (!direction) return;
    phase_ = Sampled{.direction = *direction, .random = u};
    if (hereIsMedium_ && here_ && !sampled_) sayScattering();
}

void Observer::phaseValue(const Vector3& direction, const Spectrum& value) {
    if (phase_ && sameDirection(direction, phase_->direction)) phase_->value = value;
    else if (sampled_ && sameDirection(direction, sampled_->direction)) emca_.addIntersectionData("phase function value", toColor(value));
    else emca_.addIntersectionData("phase function value (light)", toColor(value));
}

void Observer::phasePdf(const Vector3& direction, Real pdf) {
    if (phase_ && sameDirection(direction, phase_->direction)) phase_->pdf = pdf;
    else if (sampled_ && sameDirection(direction, sampled_->direction)) emca_.addIntersectionData("phase function pdf", pdf);
    else emca_.addIntersectionData("phase function pdf (light)", pdf);
}

}  // namespace emca::lajolla
