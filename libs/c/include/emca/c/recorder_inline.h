#ifndef EMCA_C_RECORDER_INLINE_H
#define EMCA_C_RECORDER_INLINE_H

// Nothing to read: the calls of recorder.h with their test for null in the caller. Bindings to other languages define
// EMCA_NO_INLINE and see the functions alone, which test for null themselves.

#include "emca/c/recorder.h"

#ifndef EMCA_NO_INLINE

#ifdef EMCA_DISABLED
#define EMCA_RECORDING(recorder) ((void)(recorder), 0)
#elif defined(__GNUC__)
#define EMCA_RECORDING(recorder) __builtin_expect((recorder) != NULL, 0)
#else
#define EMCA_RECORDING(recorder) ((recorder) != NULL)
#endif

#ifdef __cplusplus
extern "C" {
#endif

static inline void emca_inline_set_pixel(emca_recorder* recorder, emca_pixel pixel) {
    if (EMCA_RECORDING(recorder)) emca_set_pixel(recorder, pixel);
}
static inline void emca_inline_clear_pixel(emca_recorder* recorder) {
    if (EMCA_RECORDING(recorder)) emca_clear_pixel(recorder);
}
static inline void emca_inline_set_path_index(emca_recorder* recorder, int64_t sample, int32_t part) {
    if (EMCA_RECORDING(recorder)) emca_set_path_index(recorder, sample, part);
}
static inline void emca_inline_set_path_origin(emca_recorder* recorder, emca_vec3f origin) {
    if (EMCA_RECORDING(recorder)) emca_set_path_origin(recorder, origin);
}
static inline void emca_inline_end_path(emca_recorder* recorder) {
    if (EMCA_RECORDING(recorder)) emca_end_path(recorder);
}
static inline void emca_inline_set_final_estimate(emca_recorder* recorder, emca_color estimate) {
    if (EMCA_RECORDING(recorder)) emca_set_final_estimate(recorder, estimate);
}
static inline void emca_inline_add_splat(emca_recorder* recorder, emca_pixel pixel, emca_color value) {
    if (EMCA_RECORDING(recorder)) emca_add_splat(recorder, pixel, value);
}
static inline void emca_inline_set_depth_index(emca_recorder* recorder, int32_t depth, emca_subpath subpath) {
    if (EMCA_RECORDING(recorder)) emca_set_depth_index(recorder, depth, subpath);
}
static inline void emca_inline_set_intersection_pos(emca_recorder* recorder, emca_vec3f position) {
    if (EMCA_RECORDING(recorder)) emca_set_intersection_pos(recorder, position);
}
static inline void emca_inline_set_intersection_pos_envmap(emca_recorder* recorder, emca_vec3f position) {
    if (EMCA_RECORDING(recorder)) emca_set_intersection_pos_envmap(recorder, position);
}
static inline void emca_inline_set_next_event_estimation_pos(emca_recorder* recorder, emca_vec3f position,
                                                             bool visible) {
    if (EMCA_RECORDING(recorder)) emca_set_next_event_estimation_pos(recorder, position, visible);
}
static inline void emca_inline_set_intersection_surface(emca_recorder* recorder, int64_t mesh, int64_t face) {
    if (EMCA_RECORDING(recorder)) emca_set_intersection_surface(recorder, mesh, face);
}
static inline void emca_inline_set_intersection_event(emca_recorder* recorder, emca_event event, emca_lobe lobe,
                                                      const char* label) {
    if (EMCA_RECORDING(recorder)) emca_set_intersection_event(recorder, event, lobe, label);
}
static inline void emca_inline_set_intersection_estimate(emca_recorder* recorder, emca_color estimate) {
    if (EMCA_RECORDING(recorder)) emca_set_intersection_estimate(recorder, estimate);
}
static inline void emca_inline_set_intersection_emission(emca_recorder* recorder, emca_color emission) {
    if (EMCA_RECORDING(recorder)) emca_set_intersection_emission(recorder, emission);
}
static inline void emca_inline_add_contribution(emca_recorder* recorder, emca_color value, const char* technique,
                                                float mis_weight, emca_light_end end) {
    if (EMCA_RECORDING(recorder)) emca_add_contribution(recorder, value, technique, mis_weight, end);
}
static inline void emca_inline_add_path_bool(emca_recorder* recorder, emca_key* key, bool value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_bool(recorder, key, value);
}
static inline void emca_inline_add_path_int(emca_recorder* recorder, emca_key* key, int64_t value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_int(recorder, key, value);
}
static inline void emca_inline_add_path_int2(emca_recorder* recorder, emca_key* key, emca_vec2i value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_int2(recorder, key, value);
}
static inline void emca_inline_add_path_int3(emca_recorder* recorder, emca_key* key, emca_vec3i value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_int3(recorder, key, value);
}
static inline void emca_inline_add_path_float(emca_recorder* recorder, emca_key* key, float value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_float(recorder, key, value);
}
static inline void emca_inline_add_path_float2(emca_recorder* recorder, emca_key* key, emca_vec2f value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_float2(recorder, key, value);
}
static inline void emca_inline_add_path_float3(emca_recorder* recorder, emca_key* key, emca_vec3f value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_float3(recorder, key, value);
}
static inline void emca_inline_add_path_double(emca_recorder* recorder, emca_key* key, double value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_double(recorder, key, value);
}
static inline void emca_inline_add_path_double2(emca_recorder* recorder, emca_key* key, emca_vec2d value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_double2(recorder, key, value);
}
static inline void emca_inline_add_path_double3(emca_recorder* recorder, emca_key* key, emca_vec3d value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_double3(recorder, key, value);
}
static inline void emca_inline_add_path_color(emca_recorder* recorder, emca_key* key, emca_color value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_color(recorder, key, value);
}
static inline void emca_inline_add_path_color_a(emca_recorder* recorder, emca_key* key, emca_color_a value) {
    if (EMCA_RECORDING(recorder)) emca_add_path_color_a(recorder, key, value);
}
static inline void emca_inline_add_path_text(emca_recorder* recorder, emca_key* key, const char* text) {
    if (EMCA_RECORDING(recorder)) emca_add_path_text(recorder, key, text);
}
static inline void emca_inline_add_path_spectrum(emca_recorder* recorder, emca_key* key, const float* values,
                                                 size_t count) {
    if (EMCA_RECORDING(recorder)) emca_add_path_spectrum(recorder, key, values, count);
}
static inline void emca_inline_add_intersection_bool(emca_recorder* recorder, emca_key* key, bool value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_bool(recorder, key, value);
}
static inline void emca_inline_add_intersection_int(emca_recorder* recorder, emca_key* key, int64_t value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_int(recorder, key, value);
}
static inline void emca_inline_add_intersection_int2(emca_recorder* recorder, emca_key* key, emca_vec2i value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_int2(recorder, key, value);
}
static inline void emca_inline_add_intersection_int3(emca_recorder* recorder, emca_key* key, emca_vec3i value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_int3(recorder, key, value);
}
static inline void emca_inline_add_intersection_float(emca_recorder* recorder, emca_key* key, float value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_float(recorder, key, value);
}
static inline void emca_inline_add_intersection_float2(emca_recorder* recorder, emca_key* key, emca_vec2f value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_float2(recorder, key, value);
}
static inline void emca_inline_add_intersection_float3(emca_recorder* recorder, emca_key* key, emca_vec3f value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_float3(recorder, key, value);
}
static inline void emca_inline_add_intersection_double(emca_recorder* recorder, emca_key* key, double value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_double(recorder, key, value);
}
static inline void emca_inline_add_intersection_double2(emca_recorder* recorder, emca_key* key, emca_vec2d value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_double2(recorder, key, value);
}
static inline void emca_inline_add_intersection_double3(emca_recorder* recorder, emca_key* key, emca_vec3d value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_double3(recorder, key, value);
}
static inline void emca_inline_add_intersection_color(emca_recorder* recorder, emca_key* key, emca_color value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_color(recorder, key, value);
}
static inline void emca_inline_add_intersection_color_a(emca_recorder* recorder, emca_key* key, emca_color_a value) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_color_a(recorder, key, value);
}
static inline void emca_inline_add_intersection_text(emca_recorder* recorder, emca_key* key, const char* text) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_text(recorder, key, text);
}
static inline void emca_inline_add_intersection_spectrum(emca_recorder* recorder, emca_key* key, const float* values,
                                                         size_t count) {
    if (EMCA_RECORDING(recorder)) emca_add_intersection_spectrum(recorder, key, values, count);
}

#ifdef EMCA_DISABLED
static inline emca_recorder* emca_inline_thread_recorder(void) { return NULL; }
static inline emca_recorder* emca_inline_at_path(emca_recording* recording, emca_pixel pixel, int64_t sample, int32_t part) {
    (void)recording, (void)pixel, (void)sample, (void)part;
    return NULL;
}
static inline emca_recorder* emca_inline_at_vertex(emca_recording* recording, emca_pixel pixel, int64_t sample,
                                                   int32_t part, int32_t depth, emca_subpath subpath) {
    (void)recording, (void)pixel, (void)sample, (void)part, (void)depth, (void)subpath;
    return NULL;
}
#define emca_thread_recorder emca_inline_thread_recorder
#define emca_at_path emca_inline_at_path
#define emca_at_vertex emca_inline_at_vertex
#endif

#ifdef __cplusplus
}
#endif

#define emca_set_pixel emca_inline_set_pixel
#define emca_clear_pixel emca_inline_clear_pixel
#define emca_set_path_index emca_inline_set_path_index
#define emca_set_path_origin emca_inline_set_path_origin
#define emca_end_path emca_inline_end_path
#define emca_set_final_estimate emca_inline_set_final_estimate
#define emca_add_splat emca_inline_add_splat
#define emca_set_depth_index emca_inline_set_depth_index
#define emca_set_intersection_pos emca_inline_set_intersection_pos
#define emca_set_intersection_pos_envmap emca_inline_set_intersection_pos_envmap
#define emca_set_next_event_estimation_pos emca_inline_set_next_event_estimation_pos
#define emca_set_intersection_surface emca_inline_set_intersection_surface
#define emca_set_intersection_event emca_inline_set_intersection_event
#define emca_set_intersection_estimate emca_inline_set_intersection_estimate
#define emca_set_intersection_emission emca_inline_set_intersection_emission
#define emca_add_contribution emca_inline_add_contribution
#define emca_add_path_bool emca_inline_add_path_bool
#define emca_add_path_int emca_inline_add_path_int
#define emca_add_path_int2 emca_inline_add_path_int2
#define emca_add_path_int3 emca_inline_add_path_int3
#define emca_add_path_float emca_inline_add_path_float
#define emca_add_path_float2 emca_inline_add_path_float2
#define emca_add_path_float3 emca_inline_add_path_float3
#define emca_add_path_double emca_inline_add_path_double
#define emca_add_path_double2 emca_inline_add_path_double2
#define emca_add_path_double3 emca_inline_add_path_double3
#define emca_add_path_color emca_inline_add_path_color
#define emca_add_path_color_a emca_inline_add_path_color_a
#define emca_add_path_text emca_inline_add_path_text
#define emca_add_path_spectrum emca_inline_add_path_spectrum
#define emca_add_intersection_bool emca_inline_add_intersection_bool
#define emca_add_intersection_int emca_inline_add_intersection_int
#define emca_add_intersection_int2 emca_inline_add_intersection_int2
#define emca_add_intersection_int3 emca_inline_add_intersection_int3
#define emca_add_intersection_float emca_inline_add_intersection_float
#define emca_add_intersection_float2 emca_inline_add_intersection_float2
#define emca_add_intersection_float3 emca_inline_add_intersection_float3
#define emca_add_intersection_double emca_inline_add_intersection_double
#define emca_add_intersection_double2 emca_inline_add_intersection_double2
#define emca_add_intersection_double3 emca_inline_add_intersection_double3
#define emca_add_intersection_color emca_inline_add_intersection_color
#define emca_add_intersection_color_a emca_inline_add_intersection_color_a
#define emca_add_intersection_text emca_inline_add_intersection_text
#define emca_add_intersection_spectrum emca_inline_add_intersection_spectrum

#endif  // EMCA_NO_INLINE

#if !defined(__cplusplus) && defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
// A value of any type under a literal name, whose key is made here: EMCA_INTERSECTION_DATA(emca, "pdf", pdf). C11. Note
// that `true` is an int before C23: (bool)true. Spectra have an own call.
#define EMCA_PATH_DATA(recorder, name, value)                       \
    do {                                                            \
        static emca_key emca_key_ = EMCA_KEY(name);                 \
        EMCA_PATH_FUNCTION(value)((recorder), &emca_key_, (value)); \
    } while (0)
#define EMCA_INTERSECTION_DATA(recorder, name, value)                       \
    do {                                                                    \
        static emca_key emca_key_ = EMCA_KEY(name);                         \
        EMCA_INTERSECTION_FUNCTION(value)((recorder), &emca_key_, (value)); \
    } while (0)
#define EMCA_PATH_FUNCTION(value)                                                                                   \
    _Generic((value),                                                                                               \
        bool: emca_add_path_bool, signed char: emca_add_path_int, short: emca_add_path_int, int: emca_add_path_int, \
        long: emca_add_path_int, long long: emca_add_path_int, unsigned char: emca_add_path_int,                    \
        unsigned short: emca_add_path_int, unsigned: emca_add_path_int, unsigned long: emca_add_path_int,           \
        unsigned long long: emca_add_path_int, float: emca_add_path_float, double: emca_add_path_double,            \
        emca_vec2i: emca_add_path_int2, emca_vec3i: emca_add_path_int3, emca_vec2f: emca_add_path_float2,           \
        emca_vec3f: emca_add_path_float3, emca_vec2d: emca_add_path_double2, emca_vec3d: emca_add_path_double3,     \
        emca_color: emca_add_path_color, emca_color_a: emca_add_path_color_a, const char*: emca_add_path_text,      \
        char*: emca_add_path_text)
#define EMCA_INTERSECTION_FUNCTION(value)                                                                           \
    _Generic((value),                                                                                               \
        bool: emca_add_intersection_bool, signed char: emca_add_intersection_int, short: emca_add_intersection_int, \
        int: emca_add_intersection_int, long: emca_add_intersection_int, long long: emca_add_intersection_int,      \
        unsigned char: emca_add_intersection_int, unsigned short: emca_add_intersection_int,                        \
        unsigned: emca_add_intersection_int, unsigned long: emca_add_intersection_int,                              \
        unsigned long long: emca_add_intersection_int, float: emca_add_intersection_float,                          \
        double: emca_add_intersection_double, emca_vec2i: emca_add_intersection_int2,                               \
        emca_vec3i: emca_add_intersection_int3, emca_vec2f: emca_add_intersection_float2,                           \
        emca_vec3f: emca_add_intersection_float3, emca_vec2d: emca_add_intersection_double2,                        \
        emca_vec3d: emca_add_intersection_double3, emca_color: emca_add_intersection_color,                         \
        emca_color_a: emca_add_intersection_color_a, const char*: emca_add_intersection_text,                       \
        char*: emca_add_intersection_text)
#endif

#endif
