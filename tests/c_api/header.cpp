// In C++, beside the C++ interface.
#include "emca/emca.h"
#include "emca/emca.h"

void cppHeaderInUse();
void cppHeaderInUse() {
    static emca_key key = EMCA_KEY("pdf");
    emca_recorder* emca = emca_thread_recorder();
    const emca_mesh mesh = {EMCA_SIZED(emca_mesh), .name = "mesh"};
    emca_set_path_index(emca, 1, 0);
    emca_add_intersection_text(emca, &key, mesh.name);
}
