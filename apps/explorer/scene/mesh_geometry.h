#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/mesh.h"

namespace emca::explorer {

struct Edge { Vec3f from, to; };

/// Triangles ready to be drawn: one buffer for many meshes.
struct ShadedTriangles {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;                         ///< unit; smooth across edges flatter than the crease angle
    std::vector<std::array<std::uint8_t, 3>> colors;    ///< sRGB, subdued
    std::vector<Triangle> triangles;
};

/// All meshes of a scene in as few buffers as possible.
struct MeshGeometry {
    ShadedTriangles surfaces;      ///< what reflects
    ShadedTriangles emitters;      ///< what shines
    std::vector<Edge> edges;       ///< creases and borders of surfaces: they carry the form through translucency
    std::vector<Edge> emitterEdges;
    BoundingBox box;               ///< of everything
    /// Where the scene happens: without lights far outside, as a small sun is, that would make all else tiny.
    BoundingBox core;
    std::uint64_t skippedTriangles = 0;  ///< with an index beyond the positions, or a position that is not finite
};

/// \param base    colour of clay that the meshes' own diffuse colours are mixed into, sRGB
/// \param cancel  checked now and then; then the result is incomplete and to be thrown away
/// Any thread. Any input: faulty triangles are left out and counted.
MeshGeometry makeMeshGeometry(std::span<const Mesh> meshes, std::array<std::uint8_t, 3> base,
                              const std::atomic<bool>* cancel = nullptr);

/// Distance to the first surface along a ray (unit direction), by brute force: once per scene, not per frame.
std::optional<float> firstHit(std::span<const Mesh> meshes, Vec3f origin, Vec3f direction);

inline constexpr float kCreaseDegrees = 35;        ///< edges sharper than this are creases
inline constexpr std::size_t kMaximumEdges = 40000;///< of those, the longest ones are kept

/// Clay in the mesh's own hue: linear Rec. 709 reflectance to sRGB, its colour halved in strength, its lightness kept
/// between that of dark and light clay.
std::array<std::uint8_t, 3> clayColor(Color diffuse, std::array<std::uint8_t, 3> base);

}  // namespace emca::explorer
