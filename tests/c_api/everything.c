#include "everything.h"

#include <math.h>
#include <pthread.h>  // not threads.h: ThreadSanitizer knows nothing of threads that it starts
#include <string.h>

static emca_color value_of(emca_pixel pixel, uint64_t sample, uint64_t seed) {
    const uint64_t bits = emca_seed(seed, pixel, sample);
    return (emca_color){(float)(bits & 0xffff) / 65536.f, (float)(bits >> 16 & 0xffff) / 65536.f, (float)(bits >> 32 & 0xffff) / 65536.f};
}

/// What belongs to vertices; `at` stands at one.
static void record_vertex(emca_recorder* at, int32_t depth, emca_color value) {
    static const char* const names[3] = {"first", "second", "third"};
    static emca_key b = EMCA_KEY("bool"), i = EMCA_KEY("int"), i2 = EMCA_KEY("int2"), i3 = EMCA_KEY("int3");
    static emca_key f = EMCA_KEY("float"), f2 = EMCA_KEY("float2"), f3 = EMCA_KEY("float3");
    static emca_key d = EMCA_KEY("double"), d2 = EMCA_KEY("double2"), d3 = EMCA_KEY("double3");
    static emca_key c = EMCA_KEY("color"), ca = EMCA_KEY("color with alpha"), t = EMCA_KEY("text"), s = EMCA_KEY("spectrum");
    emca_set_intersection_pos(at, (emca_vec3f){(float)depth, value.r, value.g});
    emca_set_intersection_surface(at, depth, depth + 7);
    emca_set_intersection_event(at, EMCA_TRANSMIT, EMCA_GLOSSY, names[depth - 1]);
    emca_set_intersection_emission(at, (emca_color){1, 2, (float)depth});
    emca_set_intersection_estimate(at, value);
    emca_set_next_event_estimation_pos(at, (emca_vec3f){0, 5, 0}, depth % 2 == 0);
    emca_set_next_event_estimation_pos(at, (emca_vec3f){0, 6, 0}, true);
    emca_add_contribution(at, value, "light sampling", 0.25f, EMCA_LIGHT_CONNECTED);
    emca_add_contribution(at, value, "not said", NAN, EMCA_LIGHT_AUTOMATIC);
    emca_add_intersection_bool(at, &b, depth == 1);
    emca_add_intersection_int(at, &i, -((int64_t)1 << 40) - depth);
    emca_add_intersection_int2(at, &i2, (emca_vec2i){depth, 2});
    emca_add_intersection_int3(at, &i3, (emca_vec3i){depth, 2, 3});
    emca_add_intersection_float(at, &f, value.b);
    emca_add_intersection_float2(at, &f2, (emca_vec2f){value.b, 1});
    emca_add_intersection_float3(at, &f3, (emca_vec3f){value.b, 1, 2});
    emca_add_intersection_double(at, &d, value.b / 3.0);
    emca_add_intersection_double2(at, &d2, (emca_vec2d){value.b / 3.0, 1});
    emca_add_intersection_double3(at, &d3, (emca_vec3d){value.b / 3.0, 1, 2});
    emca_add_intersection_color(at, &c, value);
    emca_add_intersection_color_a(at, &ca, (emca_color_a){value.r, value.g, value.b, 0.5f});
    emca_add_intersection_text(at, &t, names[depth - 1]);
    const float wavelengths[4] = {value.r, value.g, value.b, INFINITY};
    emca_add_intersection_spectrum(at, &s, wavelengths, (size_t)depth);
    EMCA_INTERSECTION_DATA(at, "twice", 1);
    EMCA_INTERSECTION_DATA(at, "twice", 2);
    EMCA_INTERSECTION_DATA(at, "both types", 1.5f);
    EMCA_INTERSECTION_DATA(at, "both types", 1.5);
}

/// What belongs to paths.
static void record_path(emca_recorder* at, emca_pixel pixel, emca_color value) {
    static emca_key b = EMCA_KEY("bool"), i2 = EMCA_KEY("int2"), i3 = EMCA_KEY("int3"), f2 = EMCA_KEY("float2"), f3 = EMCA_KEY("float3");
    static emca_key d = EMCA_KEY("double"), d2 = EMCA_KEY("double2"), d3 = EMCA_KEY("double3"), c = EMCA_KEY("color");
    static emca_key ca = EMCA_KEY("color with alpha"), s = EMCA_KEY("spectrum");
    emca_set_path_origin(at, (emca_vec3f){1, 2, 3});
    emca_add_splat(at, (emca_pixel){pixel.x ^ 1u, pixel.y}, value);
    emca_add_path_bool(at, &b, true);
    EMCA_PATH_DATA(at, "int", 7);
    emca_add_path_int2(at, &i2, (emca_vec2i){1, 2});
    emca_add_path_int3(at, &i3, (emca_vec3i){1, 2, 3});
    EMCA_PATH_DATA(at, "float", value.r);
    emca_add_path_float2(at, &f2, (emca_vec2f){1, 2});
    emca_add_path_float3(at, &f3, (emca_vec3f){1, 2, 3});
    emca_add_path_double(at, &d, 0.1);
    emca_add_path_double2(at, &d2, (emca_vec2d){0.1, 2});
    emca_add_path_double3(at, &d3, (emca_vec3d){0.1, 2, 3});
    emca_add_path_color(at, &c, value);
    emca_add_path_color_a(at, &ca, (emca_color_a){1, 2, 3, 0.5f});
    EMCA_PATH_DATA(at, "text", "a text that is longer than small strings are");
    emca_add_path_spectrum(at, &s, &value.r, 1);
    emca_set_final_estimate(at, value);
}

static emca_color pixel_value(emca_pixel pixel, uint32_t samples, uint64_t seed) {
    emca_recorder* emca = emca_thread_recorder();
    emca_color sum = {0, 0, 0};
    for (uint32_t k = 0; k < samples; ++k) {
        const emca_color value = value_of(pixel, k, seed);
        emca_set_pixel(emca, pixel);
        emca_set_path_index(emca, 10 + (int64_t)k, (int32_t)(k % 2));
        for (int32_t depth = 3; depth >= 1; --depth) {  // also in another order than they will have
            emca_set_depth_index(emca, depth, EMCA_CAMERA_SUBPATH);
            record_vertex(emca, depth, value);
        }
        emca_set_depth_index(emca, 1, EMCA_LIGHT_SUBPATH);
        record_vertex(emca, 1, value);
        emca_set_depth_index(emca, 3, EMCA_CAMERA_SUBPATH);
        emca_set_intersection_pos_envmap(emca, (emca_vec3f){0, 0, 1000});
        record_path(emca, pixel, value);
        emca_end_path(emca);
        sum = (emca_color){sum.r + value.r, sum.g + value.g, sum.b + value.b};
    }
    return (emca_color){sum.r / (float)samples, sum.g / (float)samples, sum.b / (float)samples};
}

static emca_code info(void* user, emca_info* info, emca_error* error) {
    (void)user, (void)error;
    static const char* const words[2] = {"one", "two"};
    info->renderer = "everything in C";
    info->scene = "nothing";
    info->integrator = "hash";
    info->sampler = "none";
    info->seed = 11;
    info->width = EVERYTHING_WIDTH;
    info->height = EVERYTHING_HEIGHT;
    info->samples_per_pixel = EVERYTHING_SAMPLES;
    info->capability_count = 2;
    info->capabilities = words;
    return EMCA_OK;
}

static emca_code camera(void* user, emca_camera* camera, emca_error* error) {
    (void)user, (void)error;
    camera->kind = EMCA_ORTHOGRAPHIC;
    camera->position = (emca_vec3f){1, 2, 3};
    camera->focus_distance = 4;
    camera->right_handed = false;
    return EMCA_OK;
}

static emca_code meshes(void* user, emca_mesh_list* list, emca_error* error) {
    (void)user;
    const emca_vec3f positions[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const uint32_t triangle[3] = {0, 1, 2};
    const emca_mesh mesh = {EMCA_SIZED(emca_mesh), .name = "triangle", .material = "chalk", .positions = positions, .triangles = triangle,
        .position_count = 3, .triangle_count = 1, .diffuse = {0.5f, 0.25f, 1}, .emission = {3, 2, 1}};
    return emca_add_mesh(list, &mesh, error);
}

static emca_code render_image(void* user, const emca_settings* settings, emca_monitor* monitor, emca_image* image, emca_error* error) {
    (void)user, (void)error;
    image->has_samples = image->has_variance = true;
    for (uint32_t y = 0; y < image->height; ++y) {
        if (emca_cancelled(monitor)) return emca_fail(error, EMCA_CANCELLED, "The render was cancelled.");
        for (uint32_t x = 0; x < image->width; ++x) {
            const uint32_t at = y * image->width + x;
            image->color[at] = pixel_value((emca_pixel){x, y}, settings->samples_per_pixel, settings->seed);
            image->samples[at] = (float)settings->samples_per_pixel + (float)x;
            image->variance[at] = (emca_color){(float)x, (float)y, 1};
        }
        emca_preview(monitor, (emca_rect){0, y, image->width, y + 1}, image->color + y * image->width);
        emca_progress(monitor, (y + 1.0) / image->height);
    }
    return EMCA_OK;
}

static emca_code render_pixel(void* user, emca_pixel pixel, const emca_settings* settings, emca_recording* recording,
                              emca_monitor* monitor, emca_color* value, emca_error* error) {
    (void)user, (void)recording, (void)monitor, (void)error;
    *value = pixel_value(pixel, settings->samples_per_pixel, settings->seed);
    return EMCA_OK;
}

emca_renderer everything(void) {
    const emca_renderer renderer = {EMCA_SIZED(emca_renderer), .info = info, .camera = camera, .meshes = meshes,
        .render_image = render_image, .render_pixel = render_pixel};
    return renderer;
}

// Handles: each thread records one depth of all paths.

typedef struct {
    emca_recording* recording;
    emca_pixel pixel;
    const emca_settings* settings;
    int32_t depth;
} stage;

static void* record_stage(void* given) {
    const stage* s = given;
    for (uint32_t k = 0; k < s->settings->samples_per_pixel; ++k) {
        const emca_color value = value_of(s->pixel, k, s->settings->seed);
        if (s->depth == 0) {
            record_vertex(emca_at_vertex(s->recording, s->pixel, 10 + (int64_t)k, (int32_t)(k % 2), 1, EMCA_LIGHT_SUBPATH), 1, value);
            record_path(emca_at_path(s->recording, s->pixel, 10 + (int64_t)k, (int32_t)(k % 2)), s->pixel, value);
            continue;
        }
        emca_recorder* at = emca_at_vertex(s->recording, s->pixel, 10 + (int64_t)k, (int32_t)(k % 2), s->depth, EMCA_CAMERA_SUBPATH);
        record_vertex(at, s->depth, value);
        if (s->depth == 3) emca_set_intersection_pos_envmap(at, (emca_vec3f){0, 0, 1000});
    }
    return NULL;
}

static emca_code in_stages(void* user, emca_pixel pixel, const emca_settings* settings, emca_recording* recording,
                           emca_monitor* monitor, emca_color* value, emca_error* error) {
    (void)user, (void)monitor;
    stage stages[4];
    pthread_t threads[4];
    for (int i = 0; i < 4; ++i) {
        stages[i] = (stage){recording, pixel, settings, i};
        if (pthread_create(&threads[i], NULL, record_stage, &stages[i]) != 0) return emca_fail(error, EMCA_RENDERER_FAILED, "No thread.");
    }
    for (int i = 0; i < 4; ++i) pthread_join(threads[i], NULL);
    emca_color sum = {0, 0, 0};
    for (uint32_t k = 0; k < settings->samples_per_pixel; ++k) {
        const emca_color one = value_of(pixel, k, settings->seed);
        sum = (emca_color){sum.r + one.r, sum.g + one.g, sum.b + one.b};
    }
    const float n = (float)settings->samples_per_pixel;
    *value = (emca_color){sum.r / n, sum.g / n, sum.b / n};
    return EMCA_OK;
}

emca_renderer everything_by_handles(void) {
    emca_renderer renderer = everything();
    renderer.render_pixel = in_stages;
    return renderer;
}

// Scopes: the pixel is rendered by another thread.

typedef struct {
    stage what;
    emca_color value;
    emca_code code;
    emca_error error;
} job;

static void* run_job(void* given) {
    job* j = given;
    emca_scope* scope;
    j->code = emca_scope_open(j->what.recording, &j->what.pixel, &scope, &j->error);
    if (j->code != EMCA_OK) return NULL;
    j->value = pixel_value(j->what.pixel, j->what.settings->samples_per_pixel, j->what.settings->seed);
    j->code = emca_scope_close(scope, &j->error);
    return NULL;
}

static emca_code in_thread(void* user, emca_pixel pixel, const emca_settings* settings, emca_recording* recording,
                           emca_monitor* monitor, emca_color* value, emca_error* error) {
    (void)user, (void)monitor;
    job j;
    memset(&j, 0, sizeof j);
    j.what = (stage){recording, pixel, settings, 0};
    pthread_t thread;
    if (pthread_create(&thread, NULL, run_job, &j) != 0) return emca_fail(error, EMCA_RENDERER_FAILED, "No thread.");
    pthread_join(thread, NULL);
    if (j.code != EMCA_OK) return emca_fail(error, j.code, j.error.message);
    *value = j.value;
    return EMCA_OK;
}

emca_renderer everything_in_threads(void) {
    emca_renderer renderer = everything();
    renderer.render_pixel = in_thread;
    return renderer;
}

// Splats: one pass for all pixels, every path adds to the pixel of its index.

static emca_code trace_light(void* user, const emca_pixel* pixels, size_t count, const emca_settings* settings, emca_recording* recording,
                             emca_monitor* monitor, emca_color* values, emca_error* error) {
    (void)user, (void)recording, (void)error;
    emca_recorder* emca = emca_thread_recorder();
    for (size_t i = 0; i < count; ++i) {
        emca_begin_pixel(monitor, pixels[i]);
        values[i] = value_of(pixels[i], 0, settings->seed);
        emca_end_pixel(monitor, pixels[i]);
    }
    for (uint32_t y = 0; y < EVERYTHING_HEIGHT; ++y)
        for (uint32_t x = 0; x < EVERYTHING_WIDTH; ++x) {
            emca_clear_pixel(emca);
            emca_set_path_index(emca, y * EVERYTHING_WIDTH + x, 0);
            emca_set_depth_index(emca, 0, EMCA_LIGHT_SUBPATH);
            emca_set_intersection_pos(emca, (emca_vec3f){(float)x, (float)y, 0});
            emca_add_splat(emca, (emca_pixel){x, y}, value_of((emca_pixel){x, y}, 0, settings->seed));
        }
    emca_end_path(emca);
    return EMCA_OK;
}

emca_renderer everything_by_splats(void) {
    emca_renderer renderer = everything();
    renderer.render_pixels = trace_light;
    return renderer;
}
