#ifndef EMCA_TESTS_C_API_EVERYTHING_H
#define EMCA_TESTS_C_API_EVERYTHING_H

#include "emca/emca.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A renderer in C without a scene, which makes every call that there is; everything_test.cpp has its twin in C++.
enum { EVERYTHING_WIDTH = 6, EVERYTHING_HEIGHT = 4, EVERYTHING_SAMPLES = 3 };

emca_renderer everything(void);
/// The same, whose render_pixel uses handles from several threads (wavefront), or a thread with a scope of its own.
emca_renderer everything_by_handles(void);
emca_renderer everything_in_threads(void);
/// A light tracer: all paths belong to no pixel and splat.
emca_renderer everything_by_splats(void);

#ifdef __cplusplus
}
#endif

#endif
