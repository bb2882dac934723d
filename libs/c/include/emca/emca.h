/// EMCA for renderers in C, and in every language that can call C. docs/c-api.md
///
/// The meaning of everything is that of the C++ interface (docs/recording.md); this one has fixed sizes and places of
/// all members, so that a renderer and a newer libemca.so fit together. C99 or newer, or C++.
///
///   emca/c/base.h      version, errors, vectors, seeds
///   emca/c/recorder.h  what a renderer calls in its loop
///   emca/c/surface.h   data on surfaces, collected while an image renders
///   emca/c/renderer.h  what a renderer offers: a struct of functions
///   emca/c/server.h    the server, and tools that answer requests of their own
///
/// Rules that hold everywhere
/// - Errors: functions that can fail return an emca_code, 0 (EMCA_OK) or what went wrong, and write a sentence to the
///   caller's emca_error unless that is null. Nothing is printed, nothing is thrown, nothing ends the process. A null
///   pointer, a number out of range or a struct of a wrong size is an error, not a crash.
/// - Structs that the caller fills begin with `size` and `version`: EMCA_SIZED(type) sets both. All other members are 0
///   for "as usual". Structs that the library hands to a function of the renderer have them filled in.
/// - Ownership: what a function gets it reads until it returns, unless it says otherwise; what it hands out belongs to
///   the library, and the comment says for how long. Nothing is freed by the other side's allocator.
/// - Threads: any, unless the comment says otherwise. What is one thread's own (recorders, scopes, surface cursors and
///   points) is passed to no other.
/// - Text is UTF-8 and ends with a zero byte. Null is the empty text, unless said otherwise.
/// - Space and units: positions in world space and scene units; radiance linear Rec. 709 RGB, W/(sr m^2); densities per
///   steradian, per unit area where a name ends in "_area". (0, 0) is the top-left pixel.
#ifndef EMCA_EMCA_H
#define EMCA_EMCA_H

#include "emca/c/base.h"
#include "emca/c/recorder.h"
#include "emca/c/renderer.h"
#include "emca/c/server.h"
#include "emca/c/surface.h"

#endif
