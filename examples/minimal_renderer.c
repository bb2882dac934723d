// A path tracer in C with EMCA's calls in it, side by side with Algorithm 1 of the EMCA paper, and the functions that
// serve it, with two surface layers. What minimal_renderer.cpp is for C++. Start it, then open the explorer:
//
//     minimal_renderer_c 50013 &
//     emca-explorer 127.0.0.1:50013
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "emca/emca.h"

// A scene: four spheres, one of which shines.

typedef emca_vec3f vec;
typedef emca_color color;
typedef struct { vec centre; float radius; color albedo, emission; } sphere;
typedef struct { vec origin, direction; } ray;
typedef struct { float distance; int sphere; } hit;

enum { WIDTH = 160, HEIGHT = 120, SAMPLES = 64, MAX_BOUNCES = 16, SPHERES = 4, RINGS = 24, SEGMENTS = 48 };
static const float PI = 3.14159265f;
static const sphere spheres[SPHERES] = {
    {{0, -1000, 0}, 1000, {0.6f, 0.6f, 0.6f}, {0, 0, 0}},
    {{-1.1f, 1, 0}, 1, {0.8f, 0.3f, 0.2f}, {0, 0, 0}},
    {{1.1f, 1, 0}, 1, {0.2f, 0.5f, 0.8f}, {0, 0, 0}},
    {{0, 5, 1}, 1, {0, 0, 0}, {12, 11, 9}},
};
static const color sky = {0.2f, 0.25f, 0.3f};

static vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec scale(float s, vec a) { return (vec){s * a.x, s * a.y, s * a.z}; }
static vec minus(vec a, vec b) { return add(a, scale(-1, b)); }
static float dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec cross(vec a, vec b) { return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static vec normalize(vec a) { return scale(1 / sqrtf(dot(a, a)), a); }
static color times(color a, color b) { return (color){a.r * b.r, a.g * b.g, a.b * b.b}; }
static color plus(color a, color b) { return (color){a.r + b.r, a.g + b.g, a.b + b.b}; }
static bool is_black(color c) { return c.r == 0 && c.g == 0 && c.b == 0; }

static hit intersect(ray r) {
    hit nearest = {INFINITY, -1};
    for (int i = 0; i < SPHERES; ++i) {
        const vec to_ray = minus(r.origin, spheres[i].centre);
        const float b = dot(to_ray, r.direction), c = dot(to_ray, to_ray) - spheres[i].radius * spheres[i].radius;
        const float root = b * b - c;
        if (root < 0) continue;
        const float both[2] = {-b - sqrtf(root), -b + sqrtf(root)};
        for (int k = 0; k < 2; ++k)
            if (both[k] > 1e-3f && both[k] < nearest.distance) {
                nearest = (hit){both[k], i};
                break;
            }
    }
    return nearest;
}

// Random numbers: SplitMix64, seeded for each sample of each pixel, so that any pixel can be rendered again alone.
static float uniform(uint64_t* state) {
    uint64_t x = *state += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return (float)((x ^ x >> 31) >> 40) * 0x1p-24f;
}

static vec cosine_direction(vec normal, float u, float v) {
    const float z = 1 - 2 * u, phi = 2 * PI * v, r = sqrtf(fmaxf(0, 1 - z * z));
    return normalize(add(normal, (vec){r * cosf(phi), r * sinf(phi), z}));
}

static void set_camera(emca_camera* camera) {
    camera->position = (vec){0, 2.2f, 7};
    camera->direction = normalize((vec){0, -0.18f, -1});
    camera->up = normalize((vec){0, 1, -0.18f});
    camera->vertical_field_of_view = 40;
}

static ray camera_ray(emca_pixel pixel, uint64_t* random) {
    emca_camera camera;
    set_camera(&camera);
    const float size = tanf(camera.vertical_field_of_view * 0.5f * PI / 180);
    const float x = (2 * ((float)pixel.x + uniform(random)) / WIDTH - 1) * size * WIDTH / HEIGHT;
    const float y = (1 - 2 * ((float)pixel.y + uniform(random)) / HEIGHT) * size;
    const vec right = cross(camera.direction, camera.up);
    return (ray){camera.position, normalize(add(camera.direction, add(scale(x, right), scale(y, camera.up))))};
}

// Spheres are shown as grids of triangles. Two triangles for each ring and segment; those at the poles have no area.

static vec grid_point(const sphere* s, int ring, int segment) {
    const float theta = PI * (float)ring / RINGS, phi = 2 * PI * (float)segment / SEGMENTS;
    return add(s->centre, scale(s->radius, (vec){sinf(theta) * cosf(phi), cosf(theta), sinf(theta) * sinf(phi)}));
}

static uint32_t face_at(vec normal) {
    const float v = acosf(fmaxf(-1, fminf(1, normal.y))) / PI * RINGS;
    const float u = (atan2f(normal.z, normal.x) / (2 * PI) + (normal.z < 0 ? 1.f : 0.f)) * SEGMENTS;
    const int ring = v < RINGS ? (int)v : RINGS - 1, segment = u < SEGMENTS ? (int)u : SEGMENTS - 1;
    const bool second = ring == 0 || (ring < RINGS - 1 && (u - (float)segment) + (v - (float)ring) > 1);
    return (uint32_t)(2 * (ring * SEGMENTS + segment) + second);
}

// The path tracer. Lines that begin with `emca_` or EMCA_ are all that EMCA needs, besides the layers.

typedef struct { emca_surface_cursor* cursor; emca_layer density, throughput; } layers;  // all null: nothing is collected

static color trace(ray r, uint64_t* random, int max_bounces, const layers* collect) {  // function trace(ray):
    emca_recorder* emca = emca_thread_recorder();                              //   import emca
    color radiance = {0, 0, 0}, throughput = {1, 1, 1};                        //   L = Color(0), T = Color(1)
    for (int bounce = 1; bounce <= max_bounces; ++bounce) {                    //   for bounce=1 to max bounces do
        const hit its = intersect(r);                                          //     its = scene.intersect(ray)
        emca_set_depth_index(emca, bounce, EMCA_CAMERA_SUBPATH);               //     emca->setDepthIndex(bounce)
        if (its.sphere < 0) {                                                  //     if no intersection then
            emca_set_intersection_pos_envmap(emca, add(r.origin, scale(20, r.direction)));
            emca_set_intersection_event(emca, EMCA_BACKGROUND, EMCA_LOBE_NONE, NULL);
            emca_set_intersection_emission(emca, sky);
            emca_add_contribution(emca, times(throughput, sky), "BSDF sampling", 1, EMCA_LIGHT_HIT);
            radiance = plus(radiance, times(throughput, sky));
            emca_set_intersection_estimate(emca, radiance);
            EMCA_PATH_DATA(emca, "left scene", (bool)true);                    //       emca->addPathData("left scene", true)
            break;                                                             //       break
        }
        const sphere* s = &spheres[its.sphere];
        const vec position = add(r.origin, scale(its.distance, r.direction));
        const vec outwards = scale(1 / s->radius, minus(position, s->centre));
        const vec normal = dot(outwards, r.direction) > 0 ? scale(-1, outwards) : outwards;
        const uint32_t face = face_at(outwards);
        const emca_surface_point at = emca_locate(collect->cursor, (uint32_t)its.sphere, face, position);
        emca_layer_add(collect->density, &at, 1);
        emca_layer_add_color(collect->throughput, &at, throughput);
        emca_set_intersection_pos(emca, position);                             //     emca->setIntersectionPos(its.pos)
        emca_set_intersection_surface(emca, its.sphere, face);
        emca_set_intersection_emission(emca, s->emission);
        const color light = times(throughput, s->emission);
        if (!is_black(light)) emca_add_contribution(emca, light, "BSDF sampling", 1, EMCA_LIGHT_HIT);
        radiance = plus(radiance, light);                                      //     L += T · Le(...)
        emca_set_intersection_estimate(emca, radiance);
        const float u = uniform(random), v = uniform(random);
        const vec direction = cosine_direction(normal, u, v);                  //     ωo = sample outgoing ray direction
        const float pdf = dot(direction, normal) / PI;                         //     p = PDF of outgoing ray direction
        throughput = times(throughput, s->albedo);                             //     T *= fs(...) · cos θo / p
        if (is_black(throughput)) {
            emca_set_intersection_event(emca, EMCA_EMISSION, EMCA_LOBE_NONE, "lamp");
            break;
        }
        emca_set_intersection_event(emca, EMCA_REFLECT, EMCA_DIFFUSE, "paint");
        EMCA_INTERSECTION_DATA(emca, "PDF", pdf);                              //     emca->addIntersectionData("PDF", p)
        EMCA_INTERSECTION_DATA(emca, "random numbers", ((emca_vec2f){u, v}));
        EMCA_INTERSECTION_DATA(emca, "throughput", throughput);
        r = (ray){position, direction};
    }
    emca_set_final_estimate(emca, radiance);                                   //   emca->setFinalEstimate(L)
    return radiance;                                                           //   return L
}

/// Adds samples [begin, end) of a pixel, always in the order of their indices: the same bits in an image and alone.
static color add_samples(color sum, emca_pixel pixel, uint32_t begin, uint32_t end, uint64_t seed, const layers* collect) {
    emca_recorder* emca = emca_thread_recorder();
    for (uint32_t sample = begin; sample < end; ++sample) {                    //   for sample=1 to samples per pixel do
        uint64_t random = emca_seed(seed, pixel, sample);
        emca_set_path_index(emca, sample, 0);                                  //     emca->setPathIndex(sample)
        const ray r = camera_ray(pixel, &random);                              //     ray = sample camera ray for pixel (x, y)
        emca_set_path_origin(emca, r.origin);                                  //     emca->setPathOrigin(ray.origin)
        sum = plus(sum, trace(r, &random, MAX_BOUNCES, collect));              //     L += trace(ray)
    }
    return sum;
}

static color mean(color sum, uint32_t samples) {                               //   L /= sample count
    return (color){sum.r / (float)samples, sum.g / (float)samples, sum.b / (float)samples};
}

// What is served: some functions.

static emca_code info(void* user, emca_info* info, emca_error* error) {
    (void)user, (void)error;
    info->renderer = "minimal renderer in C";
    info->scene = "four spheres";
    info->width = WIDTH;
    info->height = HEIGHT;
    info->samples_per_pixel = SAMPLES;
    info->concurrent = true;
    return EMCA_OK;
}

static emca_code camera(void* user, emca_camera* camera, emca_error* error) {
    (void)user, (void)error;
    set_camera(camera);
    return EMCA_OK;
}

static emca_code meshes(void* user, emca_mesh_list* list, emca_error* error) {
    (void)user;
    static const char* const names[SPHERES] = {"ground", "red ball", "blue ball", "lamp"};
    vec positions[(RINGS + 1) * (SEGMENTS + 1)];
    uint32_t triangles[RINGS * SEGMENTS * 6];
    for (int i = 0; i < SPHERES; ++i) {
        for (int ring = 0; ring <= RINGS; ++ring)
            for (int segment = 0; segment <= SEGMENTS; ++segment)
                positions[ring * (SEGMENTS + 1) + segment] = grid_point(&spheres[i], ring, segment);
        uint32_t* next = triangles;
        for (uint32_t ring = 0; ring < RINGS; ++ring)
            for (uint32_t segment = 0; segment < SEGMENTS; ++segment) {
                const uint32_t a = ring * (SEGMENTS + 1) + segment, b = a + 1, c = a + SEGMENTS + 1, d = c + 1;
                const uint32_t both[6] = {a, b, c, b, d, c};
                for (int k = 0; k < 6; ++k) *next++ = both[k];
            }
        const emca_mesh mesh = {EMCA_SIZED(emca_mesh), .name = names[i], .material = i == 3 ? "lamp" : "paint",
            .positions = positions, .triangles = triangles, .position_count = (RINGS + 1) * (SEGMENTS + 1),
            .triangle_count = RINGS * SEGMENTS * 2, .diffuse = spheres[i].albedo, .emission = spheres[i].emission};
        const emca_code code = emca_add_mesh(list, &mesh, error);
        if (code != EMCA_OK) return code;
    }
    return EMCA_OK;
}

/// In passes over the whole image, so that the layers divide their faces by what is everywhere.
static emca_code render(const emca_settings* settings, emca_surface* surface, emca_monitor* monitor, emca_image* image,
                        emca_error* error) {
    const layers collect = {emca_thread_surface_cursor(surface), emca_find_layer(surface, "intersection density"),
        emca_find_layer(surface, "throughput")};
    const uint32_t samples = settings->samples_per_pixel;
    for (uint32_t begin = 0, end; begin < samples; begin = end) {
        end = begin == 0 ? 1 : 4 * (uint64_t)begin < samples ? 2 * begin : samples;
        for (uint32_t y = 0; y < HEIGHT; ++y) {
            if (emca_cancelled(monitor)) return emca_fail(error, EMCA_CANCELLED, "The render was cancelled.");
            for (uint32_t x = 0; x < WIDTH; ++x) {                             // foreach pixel(x,y) in the image do
                color* sum = &image->color[y * WIDTH + x];
                *sum = add_samples(*sum, (emca_pixel){x, y}, begin, end, settings->seed, &collect);
            }
            emca_progress(monitor, (begin + (double)(end - begin) * (y + 1) / HEIGHT) / samples);
        }
        if (end < samples) emca_pass_done(surface, (double)end / samples);
    }
    for (int i = 0; i < WIDTH * HEIGHT; ++i) image->color[i] = mean(image->color[i], samples);
    return EMCA_OK;
}

static emca_code render_image(void* user, const emca_settings* settings, emca_monitor* monitor, emca_image* image,
                              emca_error* error) {
    (void)user;
    return render(settings, NULL, monitor, image, error);
}

static emca_code surface_layers(void* user, emca_layer_list* list, emca_error* error) {
    (void)user;
    const emca_layer_description density = {EMCA_SIZED(emca_layer_description), .name = "intersection density",
        .unit = "1/m²", .description = "Intersections of all paths.", .kind = EMCA_LAYER_DENSITY};
    const emca_layer_description throughput = {EMCA_SIZED(emca_layer_description), .name = "throughput",
        .description = "Throughput with which paths arrive.", .kind = EMCA_LAYER_MEAN_COLOR};
    const emca_code code = emca_add_layer(list, &density, error);
    return code != EMCA_OK ? code : emca_add_layer(list, &throughput, error);
}

static emca_code render_image_with_layers(void* user, const emca_settings* settings, emca_surface* surface,
                                          emca_monitor* monitor, emca_image* image, emca_error* error) {
    (void)user;
    return render(settings, surface, monitor, image, error);
}

static emca_code render_pixel(void* user, emca_pixel pixel, const emca_settings* settings, emca_recording* recording,
                              emca_monitor* monitor, emca_color* value, emca_error* error) {
    (void)user, (void)recording, (void)monitor, (void)error;
    const layers none = {0};
    const uint32_t samples = settings->samples_per_pixel;
    *value = mean(add_samples((color){0, 0, 0}, pixel, 0, samples, settings->seed, &none), samples);
    return EMCA_OK;
}

/// For the explorer's light probe: what arrives along a ray.
static emca_color radiance(void* worker, const emca_probe_request* request, emca_vec3f origin, emca_vec3f direction,
                           emca_pixel pixel, uint32_t sample) {
    (void)worker;
    const layers none = {0};
    uint64_t random = emca_seed(request->seed, pixel, sample);
    const bool limited = request->maximum_depth > 0 && request->maximum_depth < MAX_BOUNCES;
    return trace((ray){origin, direction}, &random, limited ? request->maximum_depth : MAX_BOUNCES, &none);
}

int main(int argc, char** argv) {
    const emca_renderer renderer = {EMCA_SIZED(emca_renderer), .info = info, .camera = camera, .meshes = meshes,
        .render_image = render_image, .render_pixel = render_pixel, .surface_layers = surface_layers,
        .render_image_with_layers = render_image_with_layers};
    const emca_server_options options = {EMCA_SIZED(emca_server_options), .allow_quit = true,
        .port = (uint16_t)(argc > 1 ? atoi(argv[1]) : 50013)};
    const emca_light_probe probe = {EMCA_SIZED(emca_light_probe), .surface_offset = 1e-3f, .radiance = radiance};
    emca_server* server;
    emca_error error;
    if (emca_server_start(&renderer, &options, &server, &error) != EMCA_OK ||
        emca_server_add_light_probe(server, &probe, &error) != EMCA_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 4;
    }
    printf("listening on %s\n", emca_server_address(server));
    fflush(stdout);
    emca_server_wait(server);
    emca_server_destroy(server);
    return 0;
}
