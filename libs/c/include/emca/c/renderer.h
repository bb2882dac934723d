#ifndef EMCA_C_RENDERER_H
#define EMCA_C_RENDERER_H

#include "emca/c/base.h"
#include "emca/c/recorder.h"
#include "emca/c/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

// What the functions of a renderer get and fill in. The library has set `size` and `version` of these structs (its own,
// at least as large as those of this header) and all members to what they mean by default.

/// What a renderer says about itself. Texts are copied as soon as the function returns.
typedef struct emca_info {
    uint32_t size, version;
    const char* renderer;            ///< program and version, e.g. "my renderer 2.1"
    const char* scene;               ///< name of the scene, for people
    const char* integrator;          ///< may be null
    const char* sampler;             ///< may be null
    uint64_t seed;
    uint32_t width, height;          ///< of the image, in pixels; at least 1
    uint32_t samples_per_pixel;      ///< the scene's own choice; 1 by default
    uint32_t threads;                ///< at once in render_pixel, if `concurrent`; 0: as many as the machine has
    int32_t concurrent;              ///< functions may run beside each other, render_pixel with itself; false by default
    int32_t deterministic;           ///< the same settings give the same bits; true by default
    int32_t paths_reach_any_pixel;   ///< light tracing, Metropolis: render_pixels does its work once for all pixels
    uint32_t capability_count;
    const char* const* capabilities; ///< further words, e.g. "denoiser"
} emca_info;

typedef int32_t emca_camera_kind;
enum { EMCA_PERSPECTIVE = 0, EMCA_SPHERICAL = 1, EMCA_ORTHOGRAPHIC = 2, EMCA_OTHER_CAMERA = 3 };

/// Where the image was taken from, as far as a viewer needs it. World space, scene units.
typedef struct emca_camera {
    uint32_t size, version;
    emca_camera_kind kind;         ///< EMCA_PERSPECTIVE by default
    int32_t right_handed;          ///< true by default; false for a camera that mirrors the image left to right
    emca_vec3f position;
    emca_vec3f direction;          ///< unit, the way it looks; (0, 0, -1) by default
    emca_vec3f up;                 ///< unit, upwards in the image, orthogonal to `direction`; (0, 1, 0) by default
    float vertical_field_of_view;  ///< degrees, top to bottom edge of the image; 45 by default
    float near_clip, far_clip;     ///< distances along `direction`; 0.01 and 10000 by default
    float focus_distance;          ///< thin lens: of the plane in focus; 0 for a pinhole
    float aperture_radius;         ///< thin lens; 0 for a pinhole
} emca_camera;

/// What to render with. The server has filled in what the client left to the scene.
typedef struct emca_settings {
    uint32_t size, version;
    uint32_t samples_per_pixel;
    int32_t has_seed;        ///< whether `seed` was said at all
    uint64_t seed;
    const char* integrator;  ///< never null; good until the function returns
    const char* sampler;     ///< never null
} emca_settings;

/// The image to be filled in. The arrays are the library's, zero at first, row by row from the top, good until the
/// function returns. Writing beside them is the renderer's own fault.
typedef struct emca_image {
    uint32_t size, version;
    uint32_t width, height;  ///< as emca_info said
    emca_color* color;       ///< width * height: mean radiance of each pixel
    float* samples;          ///< width * height: how many samples each pixel got; set `has_samples` to say them
    emca_color* variance;    ///< width * height: unbiased, of the samples of a pixel, 0 if fewer than 2; set `has_variance`
    int32_t has_samples;     ///< false by default: all pixels got the samples that were asked for
    int32_t has_variance;    ///< false by default: not said
} emca_image;

/// One shape as triangles: filled in by the renderer. Its place in the list is the `mesh` of
/// emca_set_intersection_surface, a triangle's place the `face`. Analytic shapes come tessellated.
typedef struct emca_mesh {
    uint32_t size, version;       ///< EMCA_SIZED
    const char* name;             ///< as the scene calls it; may be null
    const char* material;         ///< name of its material; may be null
    const emca_vec3f* positions;  ///< `position_count`, world space
    const uint32_t* triangles;    ///< 3 * `triangle_count` indices into positions, counter-clockwise seen from the front
    uint64_t position_count, triangle_count;
    emca_color diffuse;           ///< rough colour for display, in [0, 1]; black if left 0
    emca_color emission;          ///< radiance it emits, black if none
} emca_mesh;

/// Where meshes go.
typedef struct emca_mesh_list emca_mesh_list;
/// Copies one mesh. Errors: EMCA_INVALID_ARGUMENT (null, a triangle with a vertex that does not exist: the sentence says
/// which), EMCA_OUT_OF_MEMORY.
EMCA_API emca_code emca_add_mesh(emca_mesh_list* list, const emca_mesh* mesh, emca_error* error);

/// Where descriptions of surface layers go.
typedef struct emca_layer_list emca_layer_list;
/// Copies one. Errors: EMCA_INVALID_ARGUMENT (null, no name, a kind that is none), EMCA_OUT_OF_MEMORY.
EMCA_API emca_code emca_add_layer(emca_layer_list* list, const emca_layer_description* layer, emca_error* error);

/// How a running request talks to its client. Any thread, until the function of the renderer returns.
typedef struct emca_monitor emca_monitor;
/// True as soon as the client cancelled or is gone: return early with EMCA_CANCELLED.
EMCA_API bool emca_cancelled(const emca_monitor* monitor);
/// \param fraction  done, in [0, 1]; may be called as often as one likes, few are sent
EMCA_API void emca_progress(emca_monitor* monitor, double fraction);
/// Pixels that are finished, for the preview. \param colors  of the rectangle, row by row; copied
/// A null pointer or an empty rectangle is ignored.
EMCA_API void emca_preview(emca_monitor* monitor, emca_rect rect, const emca_color* colors);
/// Around the replay of each pixel, in the thread that replays: tools are told. Only for render_pixels of one's own.
EMCA_API void emca_begin_pixel(emca_monitor* monitor, emca_pixel pixel);
EMCA_API void emca_end_pixel(emca_monitor* monitor, emca_pixel pixel);

/// A renderer as functions. Each gets `user`, returns EMCA_OK or says by emca_fail what went wrong, which goes to the
/// client as it is. The server calls them from threads of its own, one at a time unless emca_info.concurrent. They must
/// not end the process or leap out (longjmp); a C++ exception is caught and becomes an error reply.
///
///     emca_renderer renderer = {EMCA_SIZED(emca_renderer), .user = &scene, .info = info, …};
///
/// Those of the first group are needed, the others may be null.
typedef struct emca_renderer {
    uint32_t size, version;  ///< EMCA_SIZED
    void* user;              ///< anything; never looked at

    /// Called once, when the server starts: what it says must stay true.
    emca_code (*info)(void* user, emca_info* info, emca_error* error);
    emca_code (*camera)(void* user, emca_camera* camera, emca_error* error);
    /// Gives all meshes to emca_add_mesh, always in the same order. Called once per client that asks.
    emca_code (*meshes)(void* user, emca_mesh_list* list, emca_error* error);
    /// Renders the whole image. Nothing is recorded meanwhile.
    emca_code (*render_image)(void* user, const emca_settings* settings, emca_monitor* monitor, emca_image* image,
                              emca_error* error);
    /// Renders one pixel again, bit by bit as render_image does. The calling thread records into `recording` already.
    /// \param pixel  inside the image
    /// \param value  the pixel as the film code computes it
    emca_code (*render_pixel)(void* user, emca_pixel pixel, const emca_settings* settings, emca_recording* recording,
                              emca_monitor* monitor, emca_color* value, emca_error* error);

    /// For methods whose paths may hit any pixel (light tracing, Metropolis): one pass that records splats. Null:
    /// render_pixel is called for each. \param values  `count`, to be filled in, in the order of `pixels`
    emca_code (*render_pixels)(void* user, const emca_pixel* pixels, size_t count, const emca_settings* settings,
                               emca_recording* recording, emca_monitor* monitor, emca_color* values, emca_error* error);
    /// Gives the surface layers that can be collected to emca_add_layer. Called once, when the server starts.
    emca_code (*surface_layers)(void* user, emca_layer_list* list, emca_error* error);
    /// render_image while layers are collected, with the same bits. Called instead of it if a client asks for a layer. All
    /// threads that add must be done when it returns.
    emca_code (*render_image_with_layers)(void* user, const emca_settings* settings, emca_surface* surface,
                                          emca_monitor* monitor, emca_image* image, emca_error* error);
} emca_renderer;

#ifdef __cplusplus
}
#endif

#endif
