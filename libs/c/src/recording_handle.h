#pragma once

#include <memory>

#include "emca/recorder/recording.h"
#include "guard.h"

/// A recording as the caller sees it: of a request, or of the caller's own.
struct emca_recording {
    explicit emca_recording(emca::Recording& ofRequest) : recording(&ofRequest) {}
    explicit emca_recording(std::unique_ptr<emca::Recording> made) : recording(made.get()), own(std::move(made)) {}
    emca::Recording* recording;
    std::unique_ptr<emca::Recording> own;
    bool finished = false;
};

namespace emca::c {
inline emca::Vec3f vec(emca_vec3f v) { return {v.x, v.y, v.z}; }
inline emca::Color color(emca_color c) { return {c.r, c.g, c.b}; }
inline emca::Pixel pixel(emca_pixel p) { return {p.x, p.y}; }
}  // namespace emca::c
