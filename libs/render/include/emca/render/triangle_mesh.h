#pragma once

#include <string>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"
#include "emca/render/transform.h"

namespace emca::render {

/// Triangles as a renderer wants them. Space: what the function that made it says.
struct TriangleMesh {
    std::vector<Vec3f> positions;     ///< all finite
    std::vector<Vec3f> normals;       ///< unit, one per position; empty if the faces are flat
    std::vector<Vec2f> uvs;           ///< one per position, all finite; empty if there are none
    std::vector<Triangle> triangles;  ///< counter-clockwise seen from the front
};

/// A mesh, and what had to be left out of it to use the rest. Each warning is one whole sentence.
struct LoadedMesh {
    TriangleMesh mesh;
    std::vector<std::string> warnings;
};

/// Moves a mesh into another space. A map that mirrors reverses the triangles, so that the front stays the front.
void apply(const Transform& map, TriangleMesh& mesh);

/// Makes the other side of every face its front: reverses triangles and normals.
void flip(TriangleMesh& mesh);

/// Gives a mesh smooth normals: at each vertex the mean of the normals of its faces, weighted by their angles there.
/// Source: Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal Facets", JGT 1998.
void computeNormals(TriangleMesh& mesh);

/// Reverses those triangles whose normal points away from the vertex normals, which say better where the front is.
void alignWithNormals(TriangleMesh& mesh);

/// The square [-1, 1]^2 in the plane z = 0, front towards +z, uv = (x + 1, y + 1) / 2. Object space.
TriangleMesh makeRectangle();
/// The cube [-1, 1]^3 with flat faces, each with uvs from (0, 0) to (1, 1). Object space.
TriangleMesh makeCube();
/// The unit disk in the plane z = 0, front towards +z; u is the radius, v the angle / 2 pi. Object space.
TriangleMesh makeDisk();
/// The unit sphere around the origin with about 2,000 triangles; u is the azimuth / 2 pi, v the angle from +z / pi.
/// Object space. No triangle is degenerate: those at the poles are single ones.
TriangleMesh makeSphere();

/// makeSphere() and makeDisk() put to their place: first scaled by `radius` and moved to `center`, then `toWorld`.
TriangleMesh tessellateSphere(Vec3f center, float radius, const Transform& toWorld);
TriangleMesh tessellateDisk(const Transform& toWorld);

}  // namespace emca::render
