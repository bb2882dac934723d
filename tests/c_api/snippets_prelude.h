// What the pieces of C in docs/c-api.md take for granted: a renderer around them.
#include "emca/emca.h"

typedef struct { emca_vec3f origin; } my_ray;
typedef struct { emca_vec3f position; int mesh, face; } my_hit;
typedef struct { int lobes; } my_bsdf;

extern my_ray ray;
extern my_hit its, light;
extern my_bsdf bsdf;
extern int sample, max_bounces, bounce;
extern uint32_t mesh, face;
extern emca_vec3f position;
extern bool visible;
extern float mis_weight, pdf;
extern emca_color light_value, emission, radiance;
extern emca_pixel pixel;
extern emca_recording* recording;
extern emca_surface* surface;
extern emca_error error;
const char* describe(my_bsdf);
void shade_a_part(void);

