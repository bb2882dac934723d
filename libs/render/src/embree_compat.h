#pragma once

/// The one place that names Embree's headers, so that another major version can be added here. Built and tested with
/// Embree 3 alone.
#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#error "emca::render needs Embree 3 (libembree-dev on Debian 12)"
#endif

static_assert(RTC_VERSION_MAJOR == 3, "Embree 4 changed rtcIntersect1 and rtcOccluded1: add its calls here first");

namespace emca::render {

using EmbreeContext = RTCIntersectContext;

inline EmbreeContext makeEmbreeContext() {
    EmbreeContext context;
    rtcInitIntersectContext(&context);
    return context;
}

}  // namespace emca::render
