// Twice, and in use: the inline calls compile without a warning in every standard.
#include "emca/emca.h"
#include "emca/emca.h"

void c_header_in_use(void);
void c_header_in_use(void) {
    static emca_key key = EMCA_KEY("pdf");
    emca_recorder* emca = emca_thread_recorder();
    const emca_vec3f position = {1, 2, 3};
    emca_set_path_index(emca, 1, 0);
    emca_set_depth_index(emca, 1, EMCA_CAMERA_SUBPATH);
    emca_set_intersection_pos(emca, position);
    emca_add_intersection_float(emca, &key, 0.5f);
}
