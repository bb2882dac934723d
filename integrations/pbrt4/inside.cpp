#include "inside.h"

#include <vector>

namespace emca::pbrt4::inside {

namespace {

/// Gives the member pointer that an explicit instantiation names to whoever has the tag.
template <typename Tag, auto member>
struct Shown {
    friend constexpr auto shown(Tag) { return member; }
};

// NOLINTBEGIN: a tag, its function, and the instantiation that may name a private member.
#define EMCA_SHOWN(Tag, Class, member)    \
    struct Tag {                          \
        friend constexpr auto shown(Tag); \
    };                                    \
    template struct Shown<Tag, &Class::member>;
// NOLINTEND

EMCA_SHOWN(SimpleShape, pbrt::SimplePrimitive, shape)
EMCA_SHOWN(SimpleMaterial, pbrt::SimplePrimitive, material)
EMCA_SHOWN(GeometricShape, pbrt::GeometricPrimitive, shape)
EMCA_SHOWN(GeometricMaterial, pbrt::GeometricPrimitive, material)
EMCA_SHOWN(GeometricLight, pbrt::GeometricPrimitive, areaLight)
EMCA_SHOWN(TransformedPlaced, pbrt::TransformedPrimitive, primitive)
EMCA_SHOWN(TransformedBy, pbrt::TransformedPrimitive, renderFromPrimitive)
EMCA_SHOWN(AnimatedPlaced, pbrt::AnimatedPrimitive, primitive)
EMCA_SHOWN(AnimatedBy, pbrt::AnimatedPrimitive, renderFromPrimitive)
EMCA_SHOWN(BvhParts, pbrt::BVHAggregate, primitives)
EMCA_SHOWN(KdTreeParts, pbrt::KdTreeAggregate, primitives)
EMCA_SHOWN(TriangleMeshIndex, pbrt::Triangle, meshIndex)
EMCA_SHOWN(TriangleIndex, pbrt::Triangle, triIndex)
EMCA_SHOWN(TriangleMeshes, pbrt::Triangle, allMeshes)
EMCA_SHOWN(PatchMeshIndex, pbrt::BilinearPatch, meshIndex)
EMCA_SHOWN(PatchIndex, pbrt::BilinearPatch, blpIndex)
EMCA_SHOWN(PatchMeshes, pbrt::BilinearPatch, allMeshes)
EMCA_SHOWN(SphereRadius, pbrt::Sphere, radius)
EMCA_SHOWN(SphereZMin, pbrt::Sphere, zMin)
EMCA_SHOWN(SphereZMax, pbrt::Sphere, zMax)
EMCA_SHOWN(SphereThetaZMin, pbrt::Sphere, thetaZMin)
EMCA_SHOWN(SphereThetaZMax, pbrt::Sphere, thetaZMax)
EMCA_SHOWN(SpherePhiMax, pbrt::Sphere, phiMax)
EMCA_SHOWN(SphereTransform, pbrt::Sphere, renderFromObject)
EMCA_SHOWN(SphereReversed, pbrt::Sphere, reverseOrientation)
EMCA_SHOWN(DiskHeight, pbrt::Disk, height)
EMCA_SHOWN(DiskRadius, pbrt::Disk, radius)
EMCA_SHOWN(DiskInnerRadius, pbrt::Disk, innerRadius)
EMCA_SHOWN(DiskPhiMax, pbrt::Disk, phiMax)
EMCA_SHOWN(DiskTransform, pbrt::Disk, renderFromObject)
EMCA_SHOWN(DiskReversed, pbrt::Disk, reverseOrientation)
EMCA_SHOWN(CylinderRadius, pbrt::Cylinder, radius)
EMCA_SHOWN(CylinderZMin, pbrt::Cylinder, zMin)
EMCA_SHOWN(CylinderZMax, pbrt::Cylinder, zMax)
EMCA_SHOWN(CylinderPhiMax, pbrt::Cylinder, phiMax)
EMCA_SHOWN(CylinderTransform, pbrt::Cylinder, renderFromObject)
EMCA_SHOWN(CylinderReversed, pbrt::Cylinder, reverseOrientation)
EMCA_SHOWN(CurveData, pbrt::Curve, common)
EMCA_SHOWN(RgbFilmSpace, pbrt::RGBFilm, colorSpace)
EMCA_SHOWN(RgbFilmLargest, pbrt::RGBFilm, maxComponentValue)
EMCA_SHOWN(GBufferFilmSpace, pbrt::GBufferFilm, colorSpace)
EMCA_SHOWN(GBufferFilmLargest, pbrt::GBufferFilm, maxComponentValue)
EMCA_SHOWN(SpectralFilmSpace, pbrt::SpectralFilm, colorSpace)
EMCA_SHOWN(SpectralFilmLargest, pbrt::SpectralFilm, maxComponentValue)
EMCA_SHOWN(PathDepth, pbrt::PathIntegrator, maxDepth)
EMCA_SHOWN(SimplePathDepth, pbrt::SimplePathIntegrator, maxDepth)
EMCA_SHOWN(VolPathDepth, pbrt::VolPathIntegrator, maxDepth)
EMCA_SHOWN(SimpleVolPathDepth, pbrt::SimpleVolPathIntegrator, maxDepth)
EMCA_SHOWN(RandomWalkDepth, pbrt::RandomWalkIntegrator, maxDepth)

#undef EMCA_SHOWN

template <typename Tag, typename T>
const auto& of(const T& object) {
    return object.*shown(Tag{});
}

template <typename Integrator, typename Tag>
std::unique_ptr<pbrt::RayIntegrator> copyWithDepth(const pbrt::RayIntegrator& integrator, int maximumDepth) {
    const auto* own = dynamic_cast<const Integrator*>(&integrator);
    if (!own) return nullptr;
    auto copy = std::make_unique<Integrator>(*own);
    (*copy).*shown(Tag{}) = maximumDepth;
    return copy;
}

}  // namespace

bool isLeaf(const pbrt::Primitive& primitive) {
    return primitive.Is<pbrt::SimplePrimitive>() || primitive.Is<pbrt::GeometricPrimitive>();
}

Leaf leaf(const pbrt::Primitive& primitive) {
    if (const auto* simple = primitive.CastOrNullptr<pbrt::SimplePrimitive>()) {
        return {of<SimpleShape>(*simple), of<SimpleMaterial>(*simple), nullptr};
    }
    const auto* geometric = primitive.Cast<pbrt::GeometricPrimitive>();
    return {of<GeometricShape>(*geometric), of<GeometricMaterial>(*geometric), of<GeometricLight>(*geometric)};
}

bool isInstance(const pbrt::Primitive& primitive) {
    return primitive.Is<pbrt::TransformedPrimitive>() || primitive.Is<pbrt::AnimatedPrimitive>();
}

pbrt::Primitive placed(const pbrt::Primitive& instance) {
    if (const auto* still = instance.CastOrNullptr<pbrt::TransformedPrimitive>()) return of<TransformedPlaced>(*still);
    return of<AnimatedPlaced>(*instance.Cast<pbrt::AnimatedPrimitive>());
}

pbrt::Transform transform(const pbrt::Primitive& instance, pbrt::Float time) {
    if (const auto* still = instance.CastOrNullptr<pbrt::TransformedPrimitive>()) return *of<TransformedBy>(*still);
    return of<AnimatedBy>(*instance.Cast<pbrt::AnimatedPrimitive>()).Interpolate(time);
}

std::span<const pbrt::Primitive> parts(const pbrt::Primitive& aggregate) {
    if (const auto* bvh = aggregate.CastOrNullptr<pbrt::BVHAggregate>()) return of<BvhParts>(*bvh);
    if (const auto* tree = aggregate.CastOrNullptr<pbrt::KdTreeAggregate>()) return of<KdTreeParts>(*tree);
    return {};
}

TriangleOf triangle(const pbrt::Triangle& triangle) {
    const auto& meshes = **shown(TriangleMeshes{});
    return {meshes[std::size_t(of<TriangleMeshIndex>(triangle))], of<TriangleIndex>(triangle)};
}

PatchOf patch(const pbrt::BilinearPatch& patch) {
    const auto& meshes = **shown(PatchMeshes{});
    return {meshes[std::size_t(of<PatchMeshIndex>(patch))], of<PatchIndex>(patch)};
}

Quadric quadric(const pbrt::Sphere& sphere) {
    return {.radius = of<SphereRadius>(sphere),
            .zMin = of<SphereZMin>(sphere),
            .zMax = of<SphereZMax>(sphere),
            .phiMax = of<SpherePhiMax>(sphere),
            .thetaAtZMin = of<SphereThetaZMin>(sphere),
            .thetaAtZMax = of<SphereThetaZMax>(sphere),
            .renderFromObject = of<SphereTransform>(sphere),
            .reverseOrientation = of<SphereReversed>(sphere)};
}

Quadric quadric(const pbrt::Disk& disk) {
    return {.radius = of<DiskRadius>(disk),
            .innerRadius = of<DiskInnerRadius>(disk),
            .zMin = of<DiskHeight>(disk),
            .zMax = of<DiskHeight>(disk),
            .phiMax = of<DiskPhiMax>(disk),
            .renderFromObject = of<DiskTransform>(disk),
            .reverseOrientation = of<DiskReversed>(disk)};
}

Quadric quadric(const pbrt::Cylinder& cylinder) {
    return {.radius = of<CylinderRadius>(cylinder),
            .zMin = of<CylinderZMin>(cylinder),
            .zMax = of<CylinderZMax>(cylinder),
            .phiMax = of<CylinderPhiMax>(cylinder),
            .renderFromObject = of<CylinderTransform>(cylinder),
            .reverseOrientation = of<CylinderReversed>(cylinder)};
}

const pbrt::CurveCommon* curve(const pbrt::Curve& segment) { return of<CurveData>(segment); }

FilmSettings settings(const pbrt::Film& film) {
    if (const auto* rgb = film.CastOrNullptr<pbrt::RGBFilm>())
        return {of<RgbFilmSpace>(*rgb), of<RgbFilmLargest>(*rgb)};
    if (const auto* buffer = film.CastOrNullptr<pbrt::GBufferFilm>()) {
        return {of<GBufferFilmSpace>(*buffer), of<GBufferFilmLargest>(*buffer)};
    }
    const auto* spectral = film.Cast<pbrt::SpectralFilm>();
    return {of<SpectralFilmSpace>(*spectral), of<SpectralFilmLargest>(*spectral)};
}

std::unique_ptr<pbrt::RayIntegrator> withDepth(const pbrt::RayIntegrator& integrator, int maximumDepth) {
    if (auto copy = copyWithDepth<pbrt::PathIntegrator, PathDepth>(integrator, maximumDepth)) return copy;
    if (auto copy = copyWithDepth<pbrt::SimplePathIntegrator, SimplePathDepth>(integrator, maximumDepth)) return copy;
    if (auto copy = copyWithDepth<pbrt::VolPathIntegrator, VolPathDepth>(integrator, maximumDepth)) return copy;
    if (auto copy = copyWithDepth<pbrt::SimpleVolPathIntegrator, SimpleVolPathDepth>(integrator, maximumDepth))
        return copy;
    return copyWithDepth<pbrt::RandomWalkIntegrator, RandomWalkDepth>(integrator, maximumDepth);
}

}  // namespace emca::pbrt4::inside
