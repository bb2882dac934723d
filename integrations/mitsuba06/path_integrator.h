#pragma once

#include "emca/recorder/recorder.h"
#include "serving.h"
#include "traced_integrator.h"

namespace emca::mitsuba06 {

/// "emcapath": a path tracer with next-event estimation, multiple importance sampling and Russian roulette that records
/// every value on its way. Surfaces only: participating media are not seen.
///
/// Properties: those of MonteCarloIntegrator (maxDepth, rrDepth, strictNormals, hideEmitters) with Mitsuba's meanings,
/// and those of Serving.
class EmcaPathIntegrator final : public mts::MonteCarloIntegrator, public TracedIntegrator {
  public:
    explicit EmcaPathIntegrator(const mts::Properties& properties);

    mts::Spectrum Li(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query) const override {
        return trace(ray, query, {});
    }
    mts::Spectrum trace(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query,
                        const PathContext& context) const override;

    std::vector<LayerDescription> layers() const override { return pathLayers(); }
    std::string label() const override { return "emcapath"; }
    bool isDeterministic() const override { return true; }
    mts::SamplingIntegrator& computing() const override { return const_cast<EmcaPathIntegrator&>(*this); }

    bool preprocess(const mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                    int sensorId, int samplerId) override;
    /// Renders as Mitsuba does, then serves if asked to.
    bool render(mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId, int sensorId,
                int samplerId) override;
    void cancel() override;
    std::string toString() const override { return "EmcaPathIntegrator[]"; }

    const mts::Class* getClass() const override;
    static mts::Class* m_theClass;

  private:
    struct Walk;

    /// One vertex with all that happens there. \return why the path ends at it; null: it goes on
    const char* surface(Walk& walk) const;
    const char* environment(Walk& walk) const;
    void arrive(Walk& walk) const;
    void emission(Walk& walk) const;
    void subsurface(Walk& walk) const;
    void sampledLight(Walk& walk, const mts::BSDF& bsdf) const;
    bool scatter(Walk& walk, const mts::BSDF& bsdf) const;
    /// Roulette, once the light met here is counted: its ray is traced already.
    bool survives(Walk& walk) const;
    void addHit(Walk& walk, const mts::Spectrum& emission, mts::Float lightPdf, const mts::Emitter& emitter) const;
    bool violatesStrictNormals(const mts::Intersection& its, const mts::Vector& world, const mts::Vector& local) const;

    Serving serving_;
};

}  // namespace emca::mitsuba06
