// What a person writes who installed EMCA and knows no C++: a renderer that is served, and a recording of one's own.
#include <stdio.h>
#include <string.h>

#include "emca/emca.h"

static emca_code info(void* user, emca_info* info, emca_error* error) {
    (void)user, (void)error;
    info->renderer = "grey, in C";
    info->scene = "nothing";
    info->width = info->height = 4;
    return EMCA_OK;
}

static emca_code camera(void* user, emca_camera* camera, emca_error* error) {
    (void)user, (void)camera, (void)error;
    return EMCA_OK;
}

static emca_code meshes(void* user, emca_mesh_list* list, emca_error* error) {
    (void)user, (void)list, (void)error;
    return EMCA_OK;
}

static emca_color grey(void) {
    const emca_color value = {0.5f, 0.5f, 0.5f};
    emca_recorder* emca = emca_thread_recorder();
    emca_set_path_index(emca, 1, 0);
    EMCA_PATH_DATA(emca, "shade", "grey");
    emca_set_final_estimate(emca, value);
    return value;
}

static emca_code render_image(void* user, const emca_settings* settings, emca_monitor* monitor, emca_image* image, emca_error* error) {
    (void)user, (void)settings, (void)monitor, (void)error;
    for (uint32_t i = 0; i < image->width * image->height; ++i) image->color[i] = grey();
    return EMCA_OK;
}

static emca_code render_pixel(void* user, emca_pixel pixel, const emca_settings* settings, emca_recording* recording,
                              emca_monitor* monitor, emca_color* value, emca_error* error) {
    (void)user, (void)pixel, (void)settings, (void)recording, (void)monitor, (void)error;
    *value = grey();
    return EMCA_OK;
}

static int failed(const emca_error* error) {
    printf("%s: %s\n", emca_code_name(error->code), error->message);
    return 1;
}

int main(void) {
    emca_error error;
    emca_server* server;
    emca_recording* recording;
    emca_scope* scope;
    const emca_pixel pixel = {1, 2};
    const emca_renderer renderer = {EMCA_SIZED(emca_renderer), .info = info, .camera = camera, .meshes = meshes,
        .render_image = render_image, .render_pixel = render_pixel};
    emca_recording_counts counts = {EMCA_SIZED(emca_recording_counts)};
    if (emca_check_abi(EMCA_ABI, &error)) return failed(&error);
    if (emca_server_start(&renderer, NULL, &server, &error)) return failed(&error);
    printf("EMCA %s at %s\n", emca_version(), emca_server_address(server));
    emca_server_destroy(server);
    if (emca_recording_create(0, &recording, &error) || emca_scope_open(recording, &pixel, &scope, &error)) return failed(&error);
    grey();
    if (emca_scope_close(scope, &error) || emca_recording_finish(recording, &counts, &error)) return failed(&error);
    emca_recording_destroy(recording);
    return counts.paths == 1 && counts.values == 1 ? 0 : 1;
}
