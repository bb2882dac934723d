#include "observer_integrator.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "emca/recorder/recorder.h"
#include "observation.h"
#include "proxies.h"

namespace emca::mitsuba06 {

EmcaObserver::EmcaObserver(const mts::Properties& properties)
    : mts::SamplingIntegrator(properties), serving_(properties) {
    // All others are for the nested integrator, which says itself if it does not know one.
    for (const std::string& name : properties.getPropertyNames()) properties.markQueried(name);
}

void EmcaObserver::addChild(const std::string& name, mts::ConfigurableObject* child) {
    if (!child->getClass()->derivesFrom(MTS_CLASS(mts::SamplingIntegrator)))
        return mts::SamplingIntegrator::addChild(name, child);
    if (observed_ != nullptr) throw std::runtime_error("emca: there are two nested integrators; one is observed.");
    observed_ = static_cast<mts::SamplingIntegrator*>(child);
}

void EmcaObserver::configure() {
    if (observed_ == nullptr) {
        mts::Properties properties(getProperties());
        properties.setPluginName(properties.getString("integrator", "path"));
        properties.removeProperty("integrator");
        for (const std::string& name : Serving::propertyNames()) properties.removeProperty(name);
        observed_ = static_cast<mts::SamplingIntegrator*>(
            mts::PluginManager::getInstance()->createObject(MTS_CLASS(mts::SamplingIntegrator), properties));
        observed_->configure();
        for (const std::string& name : properties.getUnqueried()) {
            SLog(mts::EWarn, "emca: the integrator \"%s\" does not know the property \"%s\".", pluginName().c_str(),
                 name.c_str());
        }
    }
    traced_ = dynamic_cast<const TracedIntegrator*>(observed_.get());
    mts::SamplingIntegrator::configure();
}

std::vector<LayerDescription> EmcaObserver::layers() const {
    if (traced_) return traced_->layers();
    return pathLayers(
        {PathLayer::intersections, PathLayer::nextEvents, PathLayer::invalidDirections, PathLayer::pathDepth});
}

std::string EmcaObserver::label() const { return traced_ ? traced_->label() : pluginName() + " (observed)"; }

bool EmcaObserver::isDeterministic() const {
    // Others build maps or caches on the way, which depend on the order of what was rendered.
    constexpr std::array<std::string_view, 6> kPure{"path", "volpath", "volpath_simple", "direct", "ao", "emcapath"};
    return std::ranges::find(kPure, pluginName()) != kPure.end();
}

mts::Spectrum EmcaObserver::trace(const mts::RayDifferential& ray, mts::RadianceQueryRecord& query,
                                  const PathContext& context) const {
    if (traced_) return traced_->trace(ray, query, context);
    if (!recorder().isRecording() && !context.tally) return observed_->Li(ray, query);
    mts::Sampler* const sampler = query.sampler;
    mts::ref<mts::Sampler> numbers = observed(*sampler);
    query.sampler = numbers.get();
    Observation observation(*query.scene, context, ray);
    const mts::Spectrum radiance = observed_->Li(ray, query);
    observation.end();
    query.sampler = sampler;
    return radiance;
}

bool EmcaObserver::preprocess(const mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                              int sensorId, int samplerId) {
    return observed_->preprocess(scene, queue, job, sceneId, sensorId, samplerId);
}

bool EmcaObserver::render(mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                          int sensorId, int samplerId) {
    if (!observed_->render(scene, queue, job, sceneId, sensorId, samplerId)) return false;
    if (!serving_.isAsked()) return true;
    const ObservedScene proxies(*scene);
    serving_.run(*scene, *this);
    return true;
}

void EmcaObserver::postprocess(const mts::Scene* scene, mts::RenderQueue* queue, const mts::RenderJob* job, int sceneId,
                               int sensorId, int samplerId) {
    observed_->postprocess(scene, queue, job, sceneId, sensorId, samplerId);
}

void EmcaObserver::cancel() {
    observed_->cancel();
    serving_.stop();
}

void EmcaObserver::configureSampler(const mts::Scene* scene, mts::Sampler* sampler) {
    observed_->configureSampler(scene, sampler);
}

using mts::Class;
MTS_IMPLEMENT_CLASS(EmcaObserver, false, SamplingIntegrator)

}  // namespace emca::mitsuba06
