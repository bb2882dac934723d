#pragma once

#include <mitsuba/mitsuba.h>

/// The integration's code is one shared library, so that all plugins share one recorder; a plugin of Mitsuba's is a
/// file that hands its two functions on. Objects as Mitsuba expects them: pointers to ConfigurableObject, made with
/// new.
#define EMCA_MITSUBA06_EXPORT __attribute__((visibility("default")))

namespace emca::mitsuba06 {

EMCA_MITSUBA06_EXPORT void* makeObserver(const mitsuba::Properties& properties);
EMCA_MITSUBA06_EXPORT void* makePathIntegrator(const mitsuba::Properties& properties);
EMCA_MITSUBA06_EXPORT void* makeSampler(const mitsuba::Properties& properties);

}  // namespace emca::mitsuba06

/// Once in a plugin's file. Names and types are Mitsuba's.
#define EMCA_MITSUBA06_PLUGIN(make, description)                                                   \
    extern "C" EMCA_MITSUBA06_EXPORT void* CreateInstance(const mitsuba::Properties& properties) { \
        return make(properties);                                                                   \
    }                                                                                              \
    extern "C" EMCA_MITSUBA06_EXPORT const char* GetDescription() { return description; }
