#pragma once

#include "emca/core/camera.h"
#include "mitsuba_headers.h"

namespace emca::mitsuba06 {

/// The scene's sensor as a viewer needs it: perspective and thin-lens cameras, orthographic ones, others by the ray
/// through the middle of their image. At the time when the shutter opens.
Camera cameraOf(const mts::Scene& scene);

}  // namespace emca::mitsuba06
