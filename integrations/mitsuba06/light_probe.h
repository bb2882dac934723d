#pragma once

#include <memory>

#include "emca/server/server_tool.h"
#include "mitsuba_renderer.h"

namespace emca::mitsuba06 {

/// The tool "light probe" for a scene of Mitsuba's. Probes start in vacuum: what a medium around the probe itself would
/// take away is not seen. The renderer must outlive the tool.
std::shared_ptr<ServerTool> makeLightProbeTool(const MitsubaRenderer& renderer);

}  // namespace emca::mitsuba06
