#pragma once

#include "emca/core/result.h"
#include "emca/probe/light_probe.h"
#include "emca/render/image_renderer.h"

namespace emca::render {

/// Renders the radiance that arrives at a point from all directions (paper, section 3.5.1): each pixel is the mean over
/// its solid angle. Emitters are seen, whatever the integrator hides from the camera. Depends on scene, request and
/// integrator alone, never on threads.
/// \param request     a valid one; `integrator` has been understood by the caller, `maximumDepth` 0 is that of `integrator`
/// \param threads     how many render; 0: one per processor
/// \param callbacks   `tileDone` is not called
/// Errors: those of probe::validate; cancelled.
Result<probe::LightProbe> renderLightProbe(const Scene& scene, const probe::LightProbeRequest& request,
                                           IntegratorSettings integrator, SamplerKind sampler, int threads = 0,
                                           const RenderCallbacks& callbacks = {});

}  // namespace emca::render
