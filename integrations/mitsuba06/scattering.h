#pragma once

#include "emca/core/event.h"
#include "mitsuba_headers.h"

namespace emca::mitsuba06 {

/// What a sampled component of a BSDF does, in the terms of light path expressions.
struct Scattering {
    Event event = Event::none;
    Lobe lobe = Lobe::none;
};

inline Scattering scatteringOf(unsigned int sampledType) {
    using mts::BSDF;
    if (sampledType & BSDF::ENull) return {Event::pass, Lobe::straight};
    const Event event = sampledType & BSDF::EReflection     ? Event::reflect
                        : sampledType & BSDF::ETransmission ? Event::transmit
                                                            : Event::none;
    if (sampledType & BSDF::EDiffuse) return {event, Lobe::diffuse};
    if (sampledType & BSDF::EGlossy) return {event, Lobe::glossy};
    return {event, sampledType & (BSDF::EDelta | BSDF::EDelta1D) ? Lobe::specular : Lobe::none};
}

}  // namespace emca::mitsuba06
