#include "plugin_entries.h"

#include "emca_sampler.h"
#include "observer_integrator.h"
#include "path_integrator.h"

namespace emca::mitsuba06 {

void* makeObserver(const mitsuba::Properties& properties) {
    return static_cast<mts::ConfigurableObject*>(new EmcaObserver(properties));
}

void* makePathIntegrator(const mitsuba::Properties& properties) {
    return static_cast<mts::ConfigurableObject*>(new EmcaPathIntegrator(properties));
}

void* makeSampler(const mitsuba::Properties& properties) {
    return static_cast<mts::ConfigurableObject*>(new EmcaSampler(properties));
}

}  // namespace emca::mitsuba06
