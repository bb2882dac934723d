#pragma once

#include "emca/emca.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a renderer has at one intersection, as both languages read it.
typedef struct bench_intersection {
    emca_vec3f position, direction, light_position;
    emca_color throughput, bsdf_weight, radiance, estimate;
    emca_vec2f sample;
    float pdf, survival;
    bool visible;
    const char* material;
} bench_intersection;

enum { BENCH_PATHS = 1024, BENCH_DEPTH = 8, BENCH_INTERSECTIONS = 61 };

/// All calls of one pixel, in C.
void bench_record_in_c(const bench_intersection* all);
/// The same without the calls.
void bench_nothing_in_c(const bench_intersection* all);

#ifdef __cplusplus
}
#endif
