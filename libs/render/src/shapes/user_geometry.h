#pragma once

#include "emca/core/vector.h"
#include "embree_compat.h"

namespace emca::render {

inline Vec3d widen(Vec3f v) { return {double(v.x), double(v.y), double(v.z)}; }
inline Vec3f narrow(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// Makes an Embree geometry of one primitive out of a shape with lowerCorner(), upperCorner() and intersect().
template <typename AnalyticShape>
RTCGeometry makeUserGeometry(RTCDevice device, const AnalyticShape& shape) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, const_cast<AnalyticShape*>(&shape));
    rtcSetGeometryBoundsFunction(
        geometry,
        [](const RTCBoundsFunctionArguments* arguments) {
            const auto& self = *static_cast<const AnalyticShape*>(arguments->geometryUserPtr);
            const Vec3f low = self.lowerCorner(), high = self.upperCorner();
            RTCBounds& bounds = *arguments->bounds_o;
            bounds.lower_x = low.x, bounds.lower_y = low.y, bounds.lower_z = low.z;
            bounds.upper_x = high.x, bounds.upper_y = high.y, bounds.upper_z = high.z;
        },
        nullptr);
    rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* arguments) {
        if (arguments->valid[0] == 0) return;
        const auto& self = *static_cast<const AnalyticShape*>(arguments->geometryUserPtr);
        auto& rayHit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);  // rays are traced one by one: N is 1
        RTCRay& ray = rayHit.ray;
        const auto t = self.intersect({double(ray.org_x), double(ray.org_y), double(ray.org_z)},
                                      {double(ray.dir_x), double(ray.dir_y), double(ray.dir_z)}, double(ray.tnear),
                                      double(ray.tfar));
        if (!t) return;
        ray.tfar = static_cast<float>(*t);
        rayHit.hit.geomID = arguments->geomID;
        rayHit.hit.primID = arguments->primID;
        rayHit.hit.instID[0] = arguments->context->instID[0];
        rayHit.hit.u = rayHit.hit.v = 0.f;
    });
    rtcSetGeometryOccludedFunction(geometry, [](const RTCOccludedFunctionNArguments* arguments) {
        if (arguments->valid[0] == 0) return;
        const auto& self = *static_cast<const AnalyticShape*>(arguments->geometryUserPtr);
        auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
        const auto t = self.intersect({double(ray.org_x), double(ray.org_y), double(ray.org_z)},
                                      {double(ray.dir_x), double(ray.dir_y), double(ray.dir_z)}, double(ray.tnear),
                                      double(ray.tfar));
        if (t) ray.tfar = -std::numeric_limits<float>::infinity();
    });
    return geometry;
}

}  // namespace emca::render
