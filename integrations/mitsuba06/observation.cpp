#include "observation.h"

#include "scattering.h"

namespace emca::mitsuba06 {

namespace {

thread_local Observation* currentObservation = nullptr;

constexpr mts::Float kSameDirection =
    mts::Float(0.99999);  ///< cosine between a direction and what became of it in another frame

}  // namespace

Observation* Observation::current() { return currentObservation; }

Observation::Observation(const mts::Scene& scene, const PathContext& context, const mts::RayDifferential& ray)
    : scene_(scene),
      context_(context),
      previous_(currentObservation),
      throughput_(context.cameraWeight),
      segment_(ray) {
    currentObservation = this;
}

Observation::~Observation() { currentObservation = previous_; }

void Observation::begin(const mts::Point& position) {
    if (isHere(position)) return;
    finishHit(&position);
    finishVertex();
    ++depth_;
    position_ = position;
    described_ = tallied_ = false;
    segment_.reset();
    emca_.setDepthIndex(depth_);
    emca_.setIntersectionPos(position);
    emca_.addIntersectionData("throughput without roulette", throughput_);
    if (hit_) {
        describe(hit_->its);
        tellHit(*hit_);
        hit_.reset();
    }
}

void Observation::describe(const mts::Intersection& its) {
    if (described_) return;
    described_ = true;
    const SurfacePlace place = context_.shapes ? context_.shapes->place(its) : SurfacePlace{};
    if (place) emca_.setIntersectionSurface(place.mesh, place.face);
    emca_.addIntersectionData("shape", [&] { return nameOf(*its.shape); });
    emca_.addIntersectionData(
        "material", [&] { return its.shape->getBSDF() ? nameOf(*its.shape->getBSDF()) : std::string_view("none"); });
    emca_.addIntersectionData("normal", its.shFrame.n);
    if (context_.tally) context_.tally->intersection({place.mesh, place.face, toVec3f(its.p)});
    tallied_ = true;
}

void Observation::tellHit(const Hit& hit) {
    emca_.setIntersectionEmission(hit.radiance);
    emca_.addIntersectionData("light (hit)", [&] { return nameOf(*hit.emitter); });
    if (hit.lightPdf >= 0) emca_.addIntersectionData("light pdf (hit)", hit.lightPdf);
}

void Observation::finishHit(const mts::Point* next) {
    if (!hit_ || (next && hit_->its.isValid() && hit_->its.p == *next)) return;
    // Light from behind a boundary that does not deflect it, which volpath collects ahead of the vertices in between.
    emca_.addIntersectionData("emission beyond a boundary", hit_->radiance);
    hit_.reset();
}

void Observation::finishLight() {
    if (light_) emca_.setNextEventEstimationPos(light_->position, light_->visible);
    light_.reset();
}

void Observation::finishVertex() {
    finishLight();
    if (!tallied_ && context_.tally) context_.tally->background();
    tallied_ = true;
}

void Observation::tellNumbers(const char* ofPair) {
    for (const Number& number : numbers_) {
        if (number.isPair)
            emca_.addIntersectionData(Key(ofPair), Vec2f{static_cast<float>(number.x), static_cast<float>(number.y)});
        else
            emca_.addIntersectionData("random number", number.x);
    }
    numbers_.clear();
}

void Observation::goOn(const mts::Point& from, const mts::Vector& direction, mts::Float time,
                       const mts::Spectrum& weight) {
    throughput_ *= weight;
    segment_.emplace(from, direction, time);
}

void Observation::bsdfSampled(const mts::BSDFSamplingRecord& record, const mts::Spectrum& weight, const mts::Float* pdf,
                              const mts::BSDF& bsdf) {
    const mts::Intersection& its = record.its;
    begin(its.p);
    describe(its);
    finishLight();
    tellNumbers("random numbers (direction)");
    emca_.addIntersectionData("BSDF weight", weight);
    if (weight.isZero()) {
        emca_.setIntersectionEvent(its.isEmitter() ? Event::emission : Event::absorb, Lobe::none,
                                   [&] { return nameOf(bsdf); });
        if (context_.tally) context_.tally->invalidDirection();
        return;
    }
    const Scattering scattering = scatteringOf(record.sampledType);
    emca_.setIntersectionEvent(scattering.event, scattering.lobe, [&] { return nameOf(bsdf); });
    const mts::Vector direction = its.toWorld(record.wo);
    if (pdf) emca_.addIntersectionData("BSDF pdf", *pdf);
    emca_.addIntersectionData("direction", direction);
    goOn(its.p, direction, its.time, weight);
}

bool Observation::isTowardsLight(const mts::Point& from, const mts::Vector& direction) const {
    return light_ && isHere(from) && dot(light_->direction, direction) > kSameDirection;
}

void Observation::bsdfEvaluated(const mts::BSDFSamplingRecord& record, const mts::Spectrum& value) {
    begin(record.its.p);
    describe(record.its);
    if (!isTowardsLight(record.its.p, record.its.toWorld(record.wo))) return;
    light_->visible = true;
    emca_.addIntersectionData("BSDF value (light)", value);
}

void Observation::bsdfDensity(const mts::BSDFSamplingRecord& record, mts::Float pdf) {
    if (isTowardsLight(record.its.p, record.its.toWorld(record.wo))) emca_.addIntersectionData("BSDF pdf (light)", pdf);
}

void Observation::phaseSampled(const mts::PhaseFunctionSamplingRecord& record, mts::Float weight, const mts::Float* pdf,
                               const mts::PhaseFunction& phase) {
    begin(record.mRec.p);
    finishLight();
    tellNumbers("random numbers (direction)");
    emca_.setIntersectionEvent(weight == 0 ? Event::absorb : Event::volume, Lobe::none, [&] { return nameOf(phase); });
    emca_.addIntersectionData("phase function weight", weight);
    if (weight == 0) return;
    if (pdf) emca_.addIntersectionData("phase function pdf", *pdf);
    emca_.addIntersectionData("direction", record.wo);
    goOn(record.mRec.p, record.wo, record.mRec.time, mts::Spectrum(weight));
}

void Observation::phaseEvaluated(const mts::PhaseFunctionSamplingRecord& record, mts::Float value) {
    begin(record.mRec.p);
    if (!isTowardsLight(record.mRec.p, record.wo)) return;
    light_->visible = true;
    emca_.addIntersectionData("phase function value (light)", value);
}

void Observation::emitted(const mts::Intersection& its, const mts::Spectrum& radiance, const mts::Emitter& emitter) {
    const Hit hit{its, mts::Ray(), radiance, &emitter};
    if (isHere(its.p)) return tellHit(hit);
    finishHit(nullptr);
    hit_ = hit;
}

void Observation::environmentSeen(const mts::RayDifferential& ray, const mts::Spectrum& radiance,
                                  const mts::Emitter& emitter) {
    finishHit(nullptr);
    hit_ = Hit{mts::Intersection(), ray, radiance, &emitter};
}

void Observation::lightSampled(const mts::DirectSamplingRecord& record, const mts::Spectrum& value,
                               const mts::Emitter& emitter) {
    begin(record.ref);
    finishLight();
    tellNumbers("random numbers (light)");
    if (record.pdf == 0) return;  // it does not shine this way: no shadow ray
    light_ = Light{record.p, record.d};
    emca_.addIntersectionData("light", [&] { return nameOf(emitter); });
    emca_.addIntersectionData("light pdf", record.pdf * scene_.pdfEmitterDiscrete(&emitter));
    emca_.addIntersectionData("light radiance over pdf",
                              [&] { return mts::Spectrum(value / scene_.pdfEmitterDiscrete(&emitter)); });
    if (context_.tally && context_.tally->wantsNextEvents() && emitter.getShape()) {
        const SurfacePlace place = context_.shapes->place(emitter.getShape(), record.p);
        context_.tally->nextEvent({place.mesh, place.face, toVec3f(record.p)});
    }
}

void Observation::lightDensity(const mts::DirectSamplingRecord& record, mts::Float pdf, const mts::Emitter& emitter) {
    const mts::Float whole = pdf * scene_.pdfEmitterDiscrete(&emitter);
    if (hit_ && (hit_->its.isValid() ? hit_->its.p == record.p : hit_->emitter == &emitter)) {
        hit_->lightPdf = whole;
    } else if (isHere(record.p)) {
        emca_.addIntersectionData("light pdf (hit)", whole);
    }
}

void Observation::end() {
    currentObservation = previous_;
    if (hit_ && !hit_->its.isValid()) {
        const Hit hit = *hit_;
        hit_.reset();
        leaveScene(hit.ray);
        tellHit(hit);
    } else if (hit_) {
        const mts::Intersection its = hit_->its;
        begin(its.p);
        emca_.setIntersectionEvent(Event::emission, Lobe::none, [&] {
            return its.shape->getBSDF() ? nameOf(*its.shape->getBSDF()) : std::string_view();
        });
    } else if (segment_ && !scene_.hasMedia()) {
        traceLastSegment();
    }
    tellNumbers("random numbers");
    finishVertex();
    if (context_.tally) context_.tally->end(depth_);
}

void Observation::traceLastSegment() {
    const mts::RayDifferential ray(*segment_);
    mts::Intersection its;
    if (scene_.rayIntersect(ray, its)) {
        begin(its.p);
        describe(its);
        emca_.setIntersectionEvent(its.isEmitter() ? Event::emission : Event::absorb, Lobe::none, [&] {
            return its.shape->getBSDF() ? nameOf(*its.shape->getBSDF()) : std::string_view();
        });
        emca_.addIntersectionData("found by EMCA", true);
        return;
    }
    leaveScene(ray);
    emca_.addIntersectionData("found by EMCA", true);
}

void Observation::leaveScene(const mts::Ray& ray) {
    finishVertex();
    emca_.setDepthIndex(++depth_);
    emca_.setIntersectionPosEnvmap([&] {
        const mts::BSphere bounds = scene_.getBSphere();
        return ray((ray.o - bounds.center).length() + 2 * bounds.radius);
    });
    emca_.setIntersectionEvent(Event::background);
    emca_.addIntersectionData("throughput without roulette", throughput_);
    emca_.addPathData("left scene", true);
    if (context_.tally) context_.tally->background();
}

}  // namespace emca::mitsuba06
