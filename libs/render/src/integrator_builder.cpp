#include <algorithm>
#include <limits>
#include <string>

#include "scene_building.h"

namespace emca::render {

bool setIntegratorType(std::string_view type, IntegratorSettings& settings) {
    if (type == "path") return true;
    if (type != "direct") return false;
    settings.maximumDepth = 2;  // direct light is the path tracer's paths of up to two segments
    return true;
}

void buildIntegrator(const SceneNode& integrator, SceneBuilding& building) {
    PropertyReader read = building.reader(integrator);
    IntegratorSettings& settings = building.parts.integrator;
    const auto depth = [&](const char* name, int fallback) {
        const std::int64_t value = read.integer(name, fallback);
        return static_cast<int>(std::clamp<std::int64_t>(value, -1, std::numeric_limits<int>::max()));
    };
    settings.maximumDepth = depth("max_depth", -1);
    if (settings.maximumDepth == 0) {
        read.reportProperty("max_depth", "is 0, which shows nothing; 1 shows emitters, -1 is no limit. Taken as 1.");
        settings.maximumDepth = 1;
    }
    settings.rouletteDepth = std::max(depth("rr_depth", 5), 0);
    settings.strictNormals = read.flag("strict_normals", false);
    settings.hideEmitters = read.flag("hide_emitters", false);
    settings.reuseTriangleSample = read.flag("reuse_triangle_sample", false);
    const std::string& type = read.type();
    if (!setIntegratorType(type, settings)) {
        read.report(read.description() + " is replaced by path: path and direct are known.");
        return;  // what else it says concerns another method
    }
    if (type == "direct") {
        for (const char* counts : {"shading_samples", "emitter_samples", "bsdf_samples"}) {
            if (read.integer(counts, 1) != 1) read.reportProperty(counts, "is taken as 1; use more samples per pixel instead.");
        }
    }
    read.reportUnused();
}

}  // namespace emca::render
