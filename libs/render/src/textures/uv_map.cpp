#include "textures/uv_map.h"

namespace emca::render {

UvMap readUvMap(PropertyReader& read) {
    const double both = read.number("uvscale", 1.0);
    const double uScale = read.number("uscale", both), vScale = read.number("vscale", both);
    const double uOffset = read.number("uoffset", 0.0), vOffset = read.number("voffset", 0.0);
    Transform toUv = read.transform("to_uv", Transform());
    if (read.node().early && read.hasProperty("to_uv")) {
        read.reportProperty("to_uv", "is ignored, as Mitsuba up to 0.6 does; uscale and vscale work in all versions.");
        toUv = Transform();
    }
    const auto f = [](double x) { return static_cast<float>(x); };
    return {f(uScale * toUv(0, 0)), f(uScale * toUv(0, 1)), f(uScale * toUv(0, 3) + uOffset),
            f(vScale * toUv(1, 0)), f(vScale * toUv(1, 1)), f(vScale * toUv(1, 3) + vOffset)};
}

}  // namespace emca::render
