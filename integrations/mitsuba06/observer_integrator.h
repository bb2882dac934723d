#pragma once

#include <vector>

#include "serving.h"
#include "traced_integrator.h"

namespace emca::mitsuba06 {

/// "emca": a stock integrator, unmodified, seen from outside. Mitsuba's own image is the stock integrator's.
///
/// The integrator is a nested element, or the property "integrator" names its plugin (path, if nothing is said); other
/// properties are handed on to it then. Besides, those of Serving.
class EmcaObserver final : public mts::SamplingIntegrator, public TracedIntegrator {
  public:
    explicit EmcaObserver(const mts::Properties& properties);

    void addChild(const std::string& name, mts::ConfigurableObject* child) override;
    void configure() override;

    mts::Spectrum Li(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query) const override {
        return observed_->Li(ray, query);
    }
    mts::Spectrum trace(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query,
                        const PathContext& context) const override;
    std::vector<LayerDescription> layers() const override;
    std::string label() const override;
    bool isDeterministic() const override;
    mts::SamplingIntegrator& computing() const override {
        return *const_cast<mts::SamplingIntegrator*>(observed_.get());
    }

    bool preprocess(const mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                    int sensorId, int samplerId) override;
    /// Lets the stock integrator render, then serves if asked to.
    bool render(mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId, int sensorId,
                int samplerId) override;
    void postprocess(const mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                     int sensorId, int samplerId) override;
    void cancel() override;
    void configureSampler(const mts::Scene* scene, mts::Sampler* sampler) override;
    const mts::Integrator* getSubIntegrator(int index) const override { return index == 0 ? observed_.get() : nullptr; }
    std::string toString() const override { return "EmcaObserver[]"; }

    const mts::Class* getClass() const override;
    static mts::Class* m_theClass;

  private:
    std::string pluginName() const { return observed_->getProperties().getPluginName(); }

    Serving serving_;
    mts::ref<mts::SamplingIntegrator> observed_;
    const TracedIntegrator* traced_ = nullptr;  ///< if it is one of ours, which records by itself
};

}  // namespace emca::mitsuba06
