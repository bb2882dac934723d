// As bindings to other languages see it: each name is a function, and no macro stands before it.
#define EMCA_NO_INLINE
#include "emca/emca.h"

#if defined(emca_set_depth_index) || defined(emca_locate)
#error "EMCA_NO_INLINE leaves macros"
#endif

void (*function())(emca_recorder*, int32_t, emca_subpath);
void (*function())(emca_recorder*, int32_t, emca_subpath) { return &emca_set_depth_index; }
