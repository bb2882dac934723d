#ifndef EMCA_C_RECORDER_H
#define EMCA_C_RECORDER_H

#include "emca/c/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a renderer calls in its loop: Algorithm 1 of the paper (Ruppert et al., "EMCA", VMV 2021, section 4).
///
///     emca_recorder* emca = emca_thread_recorder();      // once per path; null while nothing is recorded
///     emca_set_path_index(emca, sample, 0);
///     emca_set_depth_index(emca, 1, EMCA_CAMERA_SUBPATH);
///     emca_set_intersection_pos(emca, position);
///
/// Each call does nothing if its recorder is null. In C and C++ that test is inline (recorder_inline.h), so that outside
/// of a replay a call costs one predictable branch; arguments are evaluated as in any call, and whatever is costly to
/// compute goes into `if (emca) {…}`. The image is the same bit by bit. With EMCA_DISABLED defined nothing remains.
///
/// Indices are identifiers, stored as given: they may start anywhere and have gaps. Only the indices are needed. Values
/// before any path or vertex are dropped and counted. A call with an argument that cannot be recorded (a null key, an
/// event that is none) is ignored and counted: emca_misuse.
typedef struct emca_recorder emca_recorder;

/// A request's recording, as emca_renderer.render_pixel gets it; or one of the caller's own: emca_recording_create.
typedef struct emca_recording emca_recording;

/// This thread's recorder: null unless the thread is recording. Fetch it once per path or pixel. It belongs to the
/// thread and is to be used by it alone, until the function of the renderer returns in which it was fetched.
EMCA_API emca_recorder* emca_thread_recorder(void);

// Paths

/// The pixel that the next paths belong to. Set already where render_pixel is called.
EMCA_API void emca_set_pixel(emca_recorder* recorder, emca_pixel pixel);
/// The next paths belong to no pixel: light paths, kept if they splat on a pixel that was asked for.
EMCA_API void emca_clear_pixel(emca_recorder* recorder);
/// Begins a path. \param part  0 unless a sample splits into several paths.
EMCA_API void emca_set_path_index(emca_recorder* recorder, int64_t sample, int32_t part);
EMCA_API void emca_set_path_origin(emca_recorder* recorder, emca_vec3f origin);
/// Ends the path; so does the next emca_set_path_index, and the end of render_pixel.
EMCA_API void emca_end_path(emca_recorder* recorder);
/// The path's value before division by samples per pixel.
EMCA_API void emca_set_final_estimate(emca_recorder* recorder, emca_color estimate);
/// Light that this path adds to any pixel of the film, in the film's units.
EMCA_API void emca_add_splat(emca_recorder* recorder, emca_pixel pixel, emca_color value);

// Vertices

typedef int32_t emca_subpath;
enum { EMCA_CAMERA_SUBPATH = 0, EMCA_LIGHT_SUBPATH = 1 };

/// What happened at a vertex, for light path expressions (their letters in brackets).
typedef int32_t emca_event;
enum {
    EMCA_EVENT_NONE = 0,
    EMCA_REFLECT = 1,     ///< [R]
    EMCA_TRANSMIT = 2,    ///< [T]
    EMCA_VOLUME = 3,      ///< [V] scattering in a medium
    EMCA_EMISSION = 4,    ///< [O] the walk ended on an emitter
    EMCA_BACKGROUND = 5,  ///< [B] the walk left the scene
    EMCA_ABSORB = 6,      ///< the walk ended here without light: no valid direction, absorbed, or roulette
    EMCA_PASS = 7         ///< went straight through (mask, index-matched boundary)
};
typedef int32_t emca_lobe;
enum { EMCA_LOBE_NONE = 0, EMCA_DIFFUSE = 1, EMCA_GLOSSY = 2, EMCA_SPECULAR = 3, EMCA_STRAIGHT = 4 };

/// How a contribution met its light.
typedef int32_t emca_light_end;
enum {
    EMCA_LIGHT_AUTOMATIC = 0,  ///< hit if the vertex has emission or is the environment, else connected
    EMCA_LIGHT_HIT = 1,        ///< this vertex is on the light
    EMCA_LIGHT_CONNECTED = 2   ///< from this vertex straight to a sampled point on a light
};

/// Begins a vertex or continues the one of that depth. Depth 0 is the camera (or the light), 1 the first hit.
EMCA_API void emca_set_depth_index(emca_recorder* recorder, int32_t depth, emca_subpath subpath);
EMCA_API void emca_set_intersection_pos(emca_recorder* recorder, emca_vec3f position);
/// The path left the scene towards `position`. An environment hit is a vertex of its own: if this one has a position
/// already, the hit gets the next depth.
EMCA_API void emca_set_intersection_pos_envmap(emca_recorder* recorder, emca_vec3f position);
/// One shadow test towards a sampled point on a light; several at one vertex are kept in call order.
EMCA_API void emca_set_next_event_estimation_pos(emca_recorder* recorder, emca_vec3f position, bool visible);
/// Place in the list of emca_renderer.meshes, and triangle of that mesh. Negative or beyond 2^31 - 1: misuse.
EMCA_API void emca_set_intersection_surface(emca_recorder* recorder, int64_t mesh, int64_t face);
/// \param label  e.g. the material's name; may be null. The same address again costs least: it is looked up, not hashed.
EMCA_API void emca_set_intersection_event(emca_recorder* recorder, emca_event event, emca_lobe lobe, const char* label);
/// Camera-weighted running sum of the path up to here.
EMCA_API void emca_set_intersection_estimate(emca_recorder* recorder, emca_color estimate);
/// Unweighted emitted radiance towards the path.
EMCA_API void emca_set_intersection_emission(emca_recorder* recorder, emca_color emission);
/// Light that one technique added here, weighted by the camera path and by `mis_weight` (NaN: not said).
/// \param technique  e.g. "light sampling"; as `label` above
EMCA_API void emca_add_contribution(emca_recorder* recorder, emca_color value, const char* technique, float mis_weight,
                                    emca_light_end end);

// Data of any name

/// A name, with what EMCA remembers of it: made once, by `static emca_key pdf_key = EMCA_KEY("pdf");` or emca_make_key,
/// so that no call hashes it. Any number of threads may use one. Not const: the library completes it at its first use.
typedef struct emca_key {
    const char* text;  ///< not null; must stay as it is as long as the key is used
    const char* file;  ///< a literal: the source file that the key stands in, or null
    uint32_t line;     ///< of that file
    uint32_t length;   ///< of the text; 0: not yet known. The library's.
    uint64_t hash;     ///< of the text; 0: not yet known. The library's.
} emca_key;
#define EMCA_KEY(literal) {literal, __FILE__, __LINE__, 0, 0}
/// For languages without macros, and names that are made at run time. \param text  not copied, null: the empty text
EMCA_API emca_key emca_make_key(const char* text);

/// A value of the current path. Repeated names are kept in call order.
EMCA_API void emca_add_path_bool(emca_recorder* recorder, emca_key* key, bool value);
EMCA_API void emca_add_path_int(emca_recorder* recorder, emca_key* key, int64_t value);
EMCA_API void emca_add_path_int2(emca_recorder* recorder, emca_key* key, emca_vec2i value);
EMCA_API void emca_add_path_int3(emca_recorder* recorder, emca_key* key, emca_vec3i value);
EMCA_API void emca_add_path_float(emca_recorder* recorder, emca_key* key, float value);
EMCA_API void emca_add_path_float2(emca_recorder* recorder, emca_key* key, emca_vec2f value);
EMCA_API void emca_add_path_float3(emca_recorder* recorder, emca_key* key, emca_vec3f value);
EMCA_API void emca_add_path_double(emca_recorder* recorder, emca_key* key, double value);
EMCA_API void emca_add_path_double2(emca_recorder* recorder, emca_key* key, emca_vec2d value);
EMCA_API void emca_add_path_double3(emca_recorder* recorder, emca_key* key, emca_vec3d value);
EMCA_API void emca_add_path_color(emca_recorder* recorder, emca_key* key, emca_color value);
EMCA_API void emca_add_path_color_a(emca_recorder* recorder, emca_key* key, emca_color_a value);
/// \param text  copied
EMCA_API void emca_add_path_text(emca_recorder* recorder, emca_key* key, const char* text);
/// \param values  `count` numbers, copied; null only if there are none
EMCA_API void emca_add_path_spectrum(emca_recorder* recorder, emca_key* key, const float* values, size_t count);

/// The same of the current vertex.
EMCA_API void emca_add_intersection_bool(emca_recorder* recorder, emca_key* key, bool value);
EMCA_API void emca_add_intersection_int(emca_recorder* recorder, emca_key* key, int64_t value);
EMCA_API void emca_add_intersection_int2(emca_recorder* recorder, emca_key* key, emca_vec2i value);
EMCA_API void emca_add_intersection_int3(emca_recorder* recorder, emca_key* key, emca_vec3i value);
EMCA_API void emca_add_intersection_float(emca_recorder* recorder, emca_key* key, float value);
EMCA_API void emca_add_intersection_float2(emca_recorder* recorder, emca_key* key, emca_vec2f value);
EMCA_API void emca_add_intersection_float3(emca_recorder* recorder, emca_key* key, emca_vec3f value);
EMCA_API void emca_add_intersection_double(emca_recorder* recorder, emca_key* key, double value);
EMCA_API void emca_add_intersection_double2(emca_recorder* recorder, emca_key* key, emca_vec2d value);
EMCA_API void emca_add_intersection_double3(emca_recorder* recorder, emca_key* key, emca_vec3d value);
EMCA_API void emca_add_intersection_color(emca_recorder* recorder, emca_key* key, emca_color value);
EMCA_API void emca_add_intersection_color_a(emca_recorder* recorder, emca_key* key, emca_color_a value);
EMCA_API void emca_add_intersection_text(emca_recorder* recorder, emca_key* key, const char* text);
EMCA_API void emca_add_intersection_spectrum(emca_recorder* recorder, emca_key* key, const float* values, size_t count);

// Threads of the renderer's own, and wavefront renderers

/// While it is open, the calling thread records into `recording`. Threads that a replay starts need one each; the thread
/// that the server calls render_pixel in has one already. Scopes nest; the inner one counts.
typedef struct emca_scope emca_scope;
/// \param pixel  that paths belong to until emca_set_pixel says otherwise; null: none (light paths)
/// \param scope  to be closed by the same thread, before render_pixel returns
/// Errors: EMCA_INVALID_ARGUMENT (null, a recording that is finished), EMCA_OUT_OF_MEMORY.
EMCA_API emca_code emca_scope_open(emca_recording* recording, const emca_pixel* pixel, emca_scope** scope,
                                   emca_error* error);
/// Null is nothing. Errors: EMCA_INVALID_ARGUMENT (another thread than the one that opened it, or a scope inside is still
/// open: the scope stays open).
EMCA_API emca_code emca_scope_close(emca_scope* scope, emca_error* error);

/// For renderers that advance many paths a stage at a time: a recorder that stands at that path, or vertex, from any
/// thread, without a scope. Good until this thread's next call of one of the two; `recording` null: null. Calls that
/// begin or end paths and vertices are not for such recorders.
EMCA_API emca_recorder* emca_at_path(emca_recording* recording, emca_pixel pixel, int64_t sample, int32_t part);
EMCA_API emca_recorder* emca_at_vertex(emca_recording* recording, emca_pixel pixel, int64_t sample, int32_t part,
                                       int32_t depth, emca_subpath subpath);

// Tests and measurements of an adapter, without a server

/// \param budget  bytes; 0: 256 MiB. Beyond it values are dropped and counted.
/// \param recording  the caller's until emca_recording_destroy. Keeps all paths.
EMCA_API emca_code emca_recording_create(uint64_t budget, emca_recording** recording, emca_error* error);

typedef struct emca_recording_counts {
    uint32_t size, version;         ///< EMCA_SIZED
    uint64_t paths, vertices;
    uint64_t columns;               ///< of user data: by name, by path or vertex, by type
    uint64_t values;                ///< in these columns
    uint64_t contributions, next_events, splats;
    uint64_t bytes;                 ///< that recording used
    uint64_t dropped_by_budget;     ///< values that did not fit
    uint64_t dropped_without_path;  ///< values recorded before a path was begun
    uint64_t dropped_without_vertex;
} emca_recording_counts;

/// Puts together what was recorded, and says how much that is. Once, after all scopes are closed.
/// Errors: EMCA_INVALID_ARGUMENT (null, finished already, not made by emca_recording_create), EMCA_TOO_LARGE (more than
/// 2^31 paths or vertices).
EMCA_API emca_code emca_recording_finish(emca_recording* recording, emca_recording_counts* counts, emca_error* error);
/// Null is nothing, and so is a recording that belongs to a request. All scopes must be closed.
EMCA_API void emca_recording_destroy(emca_recording* recording);

/// How many recorder and surface calls of this process were ignored because an argument made no sense; 0 is what one
/// wants. \param first  if there are any, the sentence about the first one; may be null
EMCA_API uint64_t emca_misuse(emca_error* first);

#ifdef __cplusplus
}
#endif

#include "emca/c/recorder_inline.h"

#endif
