#ifndef EMCA_C_SURFACE_H
#define EMCA_C_SURFACE_H

#include "emca/c/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Data on surfaces, collected while an image renders: heat maps. docs/heat-maps.md
///
///     emca_layer density = emca_find_layer(surface, "intersection density");     // once per image
///     emca_surface_cursor* cursor = emca_thread_surface_cursor(surface);         // once per thread or tile
///     emca_surface_point at = emca_locate(cursor, mesh, face, position);         // once per point
///     emca_layer_add(density, &at, 1);
///
/// Where `surface` is null (an image without layers) the layers, cursors and points are inert, so that one renderer
/// serves both. Threads never wait for each other.
typedef struct emca_surface emca_surface;

/// One thread's way into a collection: never shared between threads, good as long as the collection.
typedef struct emca_surface_cursor emca_surface_cursor;

/// A place on a surface, for the thread that located it. A value; all zero: no place, which ignores what is added.
typedef struct emca_surface_point { uint64_t opaque[8]; } emca_surface_point;

/// A layer that is collected. A value, for all threads; all zero: one that nobody asked for, which ignores what is added.
typedef struct emca_layer { uint64_t opaque[4]; } emca_layer;

typedef int32_t emca_layer_kind;
enum {
    EMCA_LAYER_MEAN = 0,        ///< mean of the values
    EMCA_LAYER_MEAN_COLOR = 1,  ///< mean of the colours
    EMCA_LAYER_SUM = 2,         ///< sum of the values on a face
    EMCA_LAYER_DENSITY = 3      ///< sum of the values per area
};

/// How a layer introduces itself.
typedef struct emca_layer_description {
    uint32_t size, version;   ///< EMCA_SIZED
    const char* name;         ///< unique among the layers of a renderer, e.g. "intersection density"; not empty
    const char* unit;         ///< for the colour bar, e.g. "1/m^2"; may be null
    const char* description;  ///< one sentence: which events add which value; may be null
    emca_layer_kind kind;
    int32_t reserved;         ///< 0
} emca_layer_description;

/// The handle of a layer; the inert one where nobody asked for it. Any thread.
EMCA_API emca_layer emca_find_layer(const emca_surface* surface, const char* name);
/// A layer that is collected besides, whether or not somebody asked: before any thread has its cursor.
/// Errors: EMCA_INVALID_ARGUMENT (null, name empty or taken, called too late), EMCA_TOO_LARGE (more than 4096).
EMCA_API emca_code emca_add_surface_layer(emca_surface* surface, const emca_layer_description* description,
                                          emca_layer* layer, emca_error* error);
/// Null if `surface` is, or if there is no memory.
EMCA_API emca_surface_cursor* emca_thread_surface_cursor(emca_surface* surface);

/// A point on triangle `face` of mesh `mesh` (places in emca_renderer.meshes), counted once: this is what drives the
/// subdivision. Any point counts: of an intersection, on a light that was sampled.
/// \param position  taken to the nearest point of the triangle. Not finite, or no such face: counted as invalid, and the
///                  place ignores what is added.
EMCA_API emca_surface_point emca_locate(emca_surface_cursor* cursor, uint32_t mesh, uint32_t face, emca_vec3f position);
/// \param barycentrics  weights of the second and third vertex; faster, as no vertex is read
EMCA_API emca_surface_point emca_locate_barycentric(emca_surface_cursor* cursor, uint32_t mesh, uint32_t face,
                                                    emca_vec2f barycentrics);

/// One sample at a place; every call is one of its own. Values that are not finite are counted as invalid. To a layer of
/// colours a number is grey; of a colour, a layer of numbers gets the luminance. Densities of events add 1.
EMCA_API void emca_layer_add(emca_layer layer, const emca_surface_point* at, float value);
EMCA_API void emca_layer_add_color(emca_layer layer, const emca_surface_point* at, emca_color value);

/// Between two passes over the whole image, with the part of all samples that has been taken, in (0, 1), while no thread
/// adds. From then on faces divide here only, so that the order of pixels within a pass does not show. Points are to be
/// located anew. `surface` null: nothing.
EMCA_API void emca_pass_done(emca_surface* surface, double part);

#ifndef EMCA_NO_INLINE
static inline emca_surface_point emca_inline_locate(emca_surface_cursor* cursor, uint32_t mesh, uint32_t face,
                                                    emca_vec3f position) {
    emca_surface_point none = {{0}};
    return cursor ? emca_locate(cursor, mesh, face, position) : none;
}
static inline emca_surface_point emca_inline_locate_barycentric(emca_surface_cursor* cursor, uint32_t mesh,
                                                                uint32_t face, emca_vec2f barycentrics) {
    emca_surface_point none = {{0}};
    return cursor ? emca_locate_barycentric(cursor, mesh, face, barycentrics) : none;
}
static inline void emca_inline_layer_add(emca_layer layer, const emca_surface_point* at, float value) {
    if (layer.opaque[0]) emca_layer_add(layer, at, value);
}
static inline void emca_inline_layer_add_color(emca_layer layer, const emca_surface_point* at, emca_color value) {
    if (layer.opaque[0]) emca_layer_add_color(layer, at, value);
}
#define emca_locate emca_inline_locate
#define emca_locate_barycentric emca_inline_locate_barycentric
#define emca_layer_add emca_inline_layer_add
#define emca_layer_add_color emca_inline_layer_add_color
#endif

#ifdef __cplusplus
}
#endif

#endif
