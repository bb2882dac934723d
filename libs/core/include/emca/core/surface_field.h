#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "emca/core/shared_array.h"

namespace emca {

/// What the values that were added at one place are made into.
enum class LayerKind : std::uint8_t {
    mean = 0,       ///< one float: mean of the values; NaN where there is no data
    meanColor = 1,  ///< three floats, linear RGB: mean of the colours; NaN where there is no data
    sum = 2,        ///< one float: sum of the values on the face; 0 where nothing was added
    density = 3,    ///< one float: sum of the values per world-space area; 0 where nothing was added, NaN without area
};

/// "mean", "mean color", "sum", "density".
const char* name(LayerKind kind);
/// Values per face: 3 for meanColor, else 1.
constexpr std::uint32_t channelCount(LayerKind kind) { return kind == LayerKind::meanColor ? 3 : 1; }

/// How a layer introduces itself, to a person and in requests.
struct LayerDescription {
    std::string name;         ///< unique among the layers of a renderer, e.g. "intersection density"; not empty
    LayerKind kind = LayerKind::mean;
    std::string unit;         ///< for the colour bar, e.g. "W/(sr m^2)"; empty if it has none
    std::string description;  ///< one sentence: which events add which value
    friend bool operator==(const LayerDescription&, const LayerDescription&) = default;
};

/// How the triangles of one mesh are divided. Compact: only the decisions, one bit each; whoever has the mesh rebuilds
/// the refined triangles with refine().
///
/// Bits are read from the lowest of each byte. For each base face in order, its tree in pre-order: 1 = divided into four,
/// followed by those four; 0 = not divided. The four of a triangle (v0, v1, v2) with edge midpoints m01, m12, m20:
/// (v0, m01, m20), (m01, v1, m12), (m20, m12, v2), (m12, m20, m01). At kMaxSurfaceLevel there is no bit: nothing
/// divides there. Unused bits of the last byte are 0.
struct SurfaceSubdivision {
    std::vector<std::uint8_t> bits;  ///< empty: no face of the mesh is divided
    friend bool operator==(const SurfaceSubdivision&, const SurfaceSubdivision&) = default;
};

constexpr std::uint32_t kMaxSurfaceLevel = 16;                ///< levels below a base face
constexpr std::uint32_t kMaxRefinedFaces = 1u << 27;          ///< of one mesh; refine() refuses more

/// A mesh after its subdivision. Faces are in the order of the value arrays: base faces in order, each in pre-order.
struct RefinedMesh {
    std::vector<Vec3f> positions;          ///< those of the base mesh first, then midpoints, shared between faces
    std::vector<Triangle> triangles;       ///< same orientation as their base faces
    std::vector<std::uint32_t> baseFace;   ///< per refined face: the triangle of the base mesh that it is a part of
    std::vector<std::array<std::uint32_t, 2>> midpointOf;  ///< per position after those of the base mesh: its edge
};

/// Rebuilds the refined triangles. Neighbours of equal level share vertices if their base faces do.
/// Errors: protocolViolation (bits that end early, are left over, or describe more than kMaxRefinedFaces);
/// invalidArgument (a triangle of the mesh uses a vertex that it does not have).
/// Source: Ruppert et al., "EMCA", VMV 2021, section 4.1.
Result<RefinedMesh> refine(const Mesh& mesh, const SurfaceSubdivision& subdivision);

/// Number of refined faces of a mesh with so many triangles. Errors as refine().
Result<std::uint32_t> refinedFaceCount(std::size_t baseFaces, const SurfaceSubdivision& subdivision);

/// Finds the refined face at a place of a base face: for the value under the cursor. Keeps 16 bytes per base face.
class SurfaceLocator {
  public:
    /// Errors as refine().
    static Result<SurfaceLocator> make(std::size_t baseFaces, const SurfaceSubdivision& subdivision);

    /// \param face  triangle of the base mesh
    /// \param u, v  barycentric coordinates: weights of its second and third vertex
    /// \return      index among the refined faces of the mesh; nothing if `face` does not exist or u, v are not finite
    ///              (coordinates outside the triangle are moved to its nearest border)
    std::optional<std::uint32_t> refinedFace(std::uint32_t face, float u, float v) const;
    std::uint32_t refinedFaceCount() const { return count_; }

  private:
    struct Start { std::uint64_t bit; std::uint32_t face; };
    std::vector<std::uint8_t> bits_;
    std::vector<Start> starts_;  ///< per base face; empty if nothing is divided
    std::uint32_t baseFaces_ = 0, count_ = 0;
};

/// Barycentric coordinates (weights of the second and third vertex) of the point of a triangle nearest to `p` along its
/// normal, not clamped. Nothing if the triangle has no area or anything is not finite.
std::optional<Vec2f> barycentrics(const Mesh& mesh, std::uint32_t face, Vec3f p);

/// The part of a field that belongs to one mesh.
struct SurfaceMesh {
    SurfaceSubdivision subdivision;
    std::uint64_t firstFace = 0;  ///< where its refined faces begin in the value arrays, counted in faces
    std::uint32_t faceCount = 0;  ///< refined faces; 0 if no sample landed on the mesh: it has no values at all
    friend bool operator==(const SurfaceMesh&, const SurfaceMesh&) = default;
};

/// One layer's values.
struct SurfaceLayerData {
    LayerDescription description;
    SharedArray<float> values;   ///< channelCount(kind) per refined face, faces of all meshes in order; see LayerKind
    std::uint64_t samples = 0;   ///< values added; an exact count
    double total = 0;            ///< sum of all values added (meanColor: sum of luminances), also those on faces without area
};

/// What is to be said about a collection besides its values.
struct SurfaceCounts {
    std::uint64_t points = 0;           ///< places located on a surface; exact for any number of threads
    std::uint64_t coarse = 0;           ///< of these: kept in a bin shared by neighbouring faces, as the budget was used up
    std::uint64_t invalid = 0;          ///< not kept: no such mesh or face, or a value or place that is not finite
    std::uint64_t refusedDivisions = 0; ///< faces that would be finer with a larger budget
    std::uint64_t bytesUsed = 0, budgetBytes = 0;
    friend bool operator==(const SurfaceCounts&, const SurfaceCounts&) = default;
};

/// 3D data collected on surfaces: any number of layers on one subdivision of the scene's meshes. Plain data; what came
/// from outside goes through validate() before it is used.
struct SurfaceField {
    std::vector<SurfaceMesh> meshes;       ///< one per mesh of the scene, in its order
    std::vector<SurfaceLayerData> layers;
    SharedArray<float> points;             ///< per refined face: places located there, with its part of what was located
                                           ///< before it was divided; 0: the value is filled in from neighbours
    SurfaceCounts counts;

    std::uint64_t faceCount() const { return meshes.empty() ? 0 : meshes.back().firstFace + meshes.back().faceCount; }
    /// The layer of this name, or null.
    const SurfaceLayerData* find(std::string_view layer) const;
    /// Value of one channel on a refined face of a mesh: NaN (mean) or 0 (sum, density) where there is none.
    float value(const SurfaceLayerData& layer, std::size_t mesh, std::uint32_t refinedFace, std::uint32_t channel = 0) const;
};

/// Every rule of a SurfaceField: one entry per mesh, offsets that follow each other, subdivisions that fit their meshes,
/// arrays of the right length, unique names. Errors: protocolViolation, with the rule that is broken.
Result<void> validate(const SurfaceField& field, std::span<const Mesh> meshes);
/// The same for meshes of which only the numbers of triangles are known.
Result<void> validate(const SurfaceField& field, std::span<const std::uint32_t> triangleCounts);

}  // namespace emca
