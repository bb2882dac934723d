#include "c_recorder_calls.h"

/// The values were touched: a renderer computes them, recorded or not.
static inline void used(const bench_intersection* its) { __asm__ volatile("" : : "r"(its) : "memory"); }

void bench_record_in_c(const bench_intersection* all) {
    static emca_key material = EMCA_KEY("material"), pdf = EMCA_KEY("pdf"), survival = EMCA_KEY("survival probability");
    static emca_key throughput = EMCA_KEY("throughput"), weight = EMCA_KEY("BSDF weight"), radiance = EMCA_KEY("radiance");
    static emca_key sample = EMCA_KEY("sample"), direction = EMCA_KEY("direction");
    const emca_vec3f origin = {0, 0, 0};
    int next = 0;
    for (int path = 0; path < BENCH_PATHS; ++path) {
        emca_recorder* emca = emca_thread_recorder();
        emca_set_path_index(emca, path, 0);
        emca_set_path_origin(emca, origin);
        for (int depth = 1; depth <= BENCH_DEPTH; ++depth) {
            const bench_intersection* its = &all[next];
            next = next + 1 == BENCH_INTERSECTIONS ? 0 : next + 1;
            used(its);
            emca_set_depth_index(emca, depth, EMCA_CAMERA_SUBPATH);
            emca_set_intersection_pos(emca, its->position);
            emca_add_intersection_text(emca, &material, its->material);
            emca_add_intersection_float(emca, &pdf, its->pdf);
            emca_add_intersection_float(emca, &survival, its->survival);
            emca_add_intersection_color(emca, &throughput, its->throughput);
            emca_add_intersection_color(emca, &weight, its->bsdf_weight);
            emca_add_intersection_color(emca, &radiance, its->radiance);
            emca_add_intersection_float2(emca, &sample, its->sample);
            emca_add_intersection_float3(emca, &direction, its->direction);
            emca_set_next_event_estimation_pos(emca, its->light_position, its->visible);
            emca_set_intersection_estimate(emca, its->estimate);
        }
        emca_set_final_estimate(emca, all[next].estimate);
    }
}

void bench_nothing_in_c(const bench_intersection* all) {
    int next = 0;
    for (int path = 0; path < BENCH_PATHS; ++path)
        for (int depth = 1; depth <= BENCH_DEPTH; ++depth) {
            const bench_intersection* its = &all[next];
            next = next + 1 == BENCH_INTERSECTIONS ? 0 : next + 1;
            used(its);
        }
}
