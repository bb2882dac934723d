#pragma once

#include <optional>
#include <vector>

#include "emca/recorder/recorder.h"
#include "mitsuba_headers.h"
#include "traced_integrator.h"

namespace emca::mitsuba06 {

/// What is seen of one path of a stock integrator from outside: the calls that it makes to materials, emitters, phase
/// functions and the sampler. The proxies (proxies.h) tell it. Belongs to one thread; the integrator notices nothing.
///
/// What is concluded rather than seen:
/// - A vertex begins with the first call about a point that is not the point of the vertex before.
/// - A chosen point on a light counts as visible if the material is evaluated in its direction next: integrators do
/// that
///   for light that arrives.
/// - The last vertex of a path often causes no call at all. Where there are no media, EMCA traces the last segment
/// again
///   by itself to find it.
class Observation {
  public:
    /// \param ray  the path's first segment
    Observation(const mts::Scene& scene, const PathContext& context, const mts::RayDifferential& ray);
    ~Observation();
    Observation(const Observation&) = delete;
    Observation& operator=(const Observation&) = delete;

    /// The one of this thread; null if nobody looks.
    static Observation* current();

    void bsdfSampled(const mts::BSDFSamplingRecord& record, const mts::Spectrum& weight, const mts::Float* pdf,
                     const mts::BSDF& bsdf);
    void bsdfEvaluated(const mts::BSDFSamplingRecord& record, const mts::Spectrum& value);
    void bsdfDensity(const mts::BSDFSamplingRecord& record, mts::Float pdf);
    void phaseSampled(const mts::PhaseFunctionSamplingRecord& record, mts::Float weight, const mts::Float* pdf,
                      const mts::PhaseFunction& phase);
    void phaseEvaluated(const mts::PhaseFunctionSamplingRecord& record, mts::Float value);
    void emitted(const mts::Intersection& its, const mts::Spectrum& radiance, const mts::Emitter& emitter);
    /// A ray left the scene.
    void environmentSeen(const mts::RayDifferential& ray, const mts::Spectrum& radiance, const mts::Emitter& emitter);
    void lightSampled(const mts::DirectSamplingRecord& record, const mts::Spectrum& value, const mts::Emitter& emitter);
    void lightDensity(const mts::DirectSamplingRecord& record, mts::Float pdf, const mts::Emitter& emitter);
    void randomNumber(mts::Float u) { numbers_.push_back({u, 0, false}); }
    void randomNumbers(const mts::Point2& u) { numbers_.push_back({u.x, u.y, true}); }

    /// The integrator returned.
    void end();

  private:
    struct Number {
        mts::Float x, y;
        bool isPair;
    };
    /// Emission that was asked for at a point to which no vertex belongs yet, or outside of the scene.
    struct Hit {
        mts::Intersection its;  ///< not valid: the environment
        mts::Ray ray;           ///< to the environment
        mts::Spectrum radiance;
        const mts::Emitter* emitter;
        mts::Float lightPdf = -1;  ///< negative: not asked for
    };
    /// A chosen point on a light, until it is known whether it is visible.
    struct Light {
        mts::Point position;
        mts::Vector direction;
        bool visible = false;
    };

    bool isHere(const mts::Point& position) const { return depth_ > 0 && position == position_; }
    void begin(const mts::Point& position);
    void describe(const mts::Intersection& its);
    void tellHit(const Hit& hit);
    void finishLight();
    void finishVertex();
    void finishHit(const mts::Point* next);
    void tellNumbers(const char* ofPair);
    void goOn(const mts::Point& from, const mts::Vector& direction, mts::Float time, const mts::Spectrum& weight);
    void traceLastSegment();
    void leaveScene(const mts::Ray& ray);
    bool isTowardsLight(const mts::Point& from, const mts::Vector& direction) const;

    const mts::Scene& scene_;
    const PathContext& context_;
    PathRecorder emca_ = recorder();
    Observation* previous_;
    int depth_ = 0;  ///< of the open vertex
    mts::Point position_;
    bool described_ = false;  ///< its surface is known
    bool tallied_ = true;
    mts::Spectrum throughput_;
    std::optional<Hit> hit_;
    std::optional<Light> light_;
    std::optional<mts::Ray> segment_;  ///< where the path goes on to, until something is seen there
    std::vector<Number> numbers_;      ///< drawn since the last thing that was seen
};

}  // namespace emca::mitsuba06
