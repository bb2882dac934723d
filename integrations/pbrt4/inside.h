#pragma once

#include <memory>
#include <span>

#include "pbrt_headers.h"

/// What pbrt's objects hold and do not show: its meshes, its shapes' sizes, what its aggregates are made of. Read only.
/// An explicit instantiation may name private members ([temp.spec.general]); inside.cpp uses that and nothing else
/// does.
namespace emca::pbrt4::inside {

/// A primitive with a shape of its own.
struct Leaf {
    pbrt::Shape shape;
    pbrt::Material material;
    pbrt::Light areaLight;  ///< null if it emits nothing
};
bool isLeaf(const pbrt::Primitive& primitive);
Leaf leaf(const pbrt::Primitive& primitive);  ///< only if isLeaf()

/// A primitive that places another one: an instance, or a shape that moves.
bool isInstance(const pbrt::Primitive& primitive);
pbrt::Primitive placed(const pbrt::Primitive& instance);                       ///< what it places
pbrt::Transform transform(const pbrt::Primitive& instance, pbrt::Float time);  ///< from there to where it is used

/// Of a BVH or a kd-tree; empty for every other primitive.
std::span<const pbrt::Primitive> parts(const pbrt::Primitive& aggregate);

struct TriangleOf {
    const pbrt::TriangleMesh* mesh;
    int triangle;
};
TriangleOf triangle(const pbrt::Triangle& triangle);

struct PatchOf {
    const pbrt::BilinearPatchMesh* mesh;
    int patch;
};
PatchOf patch(const pbrt::BilinearPatch& patch);

/// A sphere, disk or cylinder in its own space. Those that a shape does not have are 0.
struct Quadric {
    pbrt::Float radius = 0, innerRadius = 0, zMin = 0, zMax = 0, phiMax = 0;
    pbrt::Float thetaAtZMin = 0, thetaAtZMax = 0;  ///< spheres: angle from the z axis
    const pbrt::Transform* renderFromObject = nullptr;
    bool reverseOrientation = false;
};
Quadric quadric(const pbrt::Sphere& sphere);
Quadric quadric(const pbrt::Disk& disk);  ///< its height is zMin and zMax
Quadric quadric(const pbrt::Cylinder& cylinder);

const pbrt::CurveCommon* curve(const pbrt::Curve& segment);

/// What a film does with a sample besides summing it up.
struct FilmSettings {
    const pbrt::RGBColorSpace* colorSpace;
    pbrt::Float largestComponent;  ///< beyond, samples are scaled down
};
FilmSettings settings(const pbrt::Film& film);

/// A copy of an integrator of pbrt's with another maximum depth; null if it has none. A second one made by its
/// constructor would write to the lights, which may be in use.
std::unique_ptr<pbrt::RayIntegrator> withDepth(const pbrt::RayIntegrator& integrator, int maximumDepth);

}  // namespace emca::pbrt4::inside
