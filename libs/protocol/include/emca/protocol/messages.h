#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/match_counts.h"
#include "emca/core/mesh.h"
#include "emca/core/path_set.h"
#include "emca/core/pixel.h"
#include "emca/core/replay.h"
#include "emca/core/result.h"
#include "emca/core/shared_array.h"
#include "emca/core/surface_field.h"

/// The messages of docs/protocol.md as values. Arrays of decoded messages look into the frame that they came in.
namespace emca::protocol {

struct Hello {
    std::string software;                            ///< product and version, for people
    std::uint16_t minimumVersion = 0, maximumVersion = 0;
    std::vector<std::string> capabilities;
    std::string token;                               ///< empty if none
};

struct Welcome {
    std::string software;
    std::uint16_t version = 0;                       ///< the highest that both sides speak
    std::vector<std::string> capabilities;
    std::uint32_t maximumRequestBytes = 0;
};

struct Refusal {
    Error error;
    std::uint16_t minimumVersion = 0, maximumVersion = 0;
};

struct Cancel {};
struct Progress {
    float fraction = 0;                              ///< in [0, 1]
    bool waiting = false;                            ///< not begun: other work comes first
};
struct Failure { Error error; };
struct Done {};

/// A layer of 3D data on surfaces.
struct Layer {
    LayerDescription description;
    std::uint64_t samples = 0;                       ///< where it has been collected: values added,
    double total = 0;                                ///< and their sum
    friend bool operator==(const Layer&, const Layer&) = default;
};

struct InfoRequest {};
struct Info {
    std::string renderer, scene, integrator, sampler;
    std::uint32_t width = 0, height = 0, samplesPerPixel = 0;
    std::uint64_t seed = 0;
    bool concurrent = false, deterministic = false;
    std::uint64_t triangles = 0, meshes = 0;
    std::uint32_t maximumSamplesPerPixel = 0, maximumPixelsPerTrace = 0;
    std::uint64_t maximumBudget = 0;
    std::vector<std::string> capabilities, tools;
    std::uint64_t latestRender = 0;                  ///< 0 if none
    std::vector<Layer> layers;                       ///< that the renderer can collect
    std::uint64_t surfaceRender = 0;                 ///< the newest render with layers that is kept; 0 if none
    std::vector<Layer> collected;                    ///< its layers
    std::uint64_t maximumSurfaceBudget = 0;
};

struct CameraRequest {};

struct SceneRequest { std::uint32_t maximumChunkBytes = 0; };   ///< 0: the server's choice
/// Some vertices or triangles of one mesh. Parts of a mesh come in order, vertices before triangles; the first one
/// brings its name, material and colours.
struct MeshPart {
    std::uint32_t mesh = 0;
    std::string name, material;
    Color diffuse{0.5f}, emission;
    std::uint32_t vertexCount = 0, triangleCount = 0;    ///< of the whole mesh
    std::uint32_t firstVertex = 0, firstTriangle = 0;    ///< of this part
    SharedArray<Vec3f> positions;
    SharedArray<Triangle> triangles;
};
struct SceneChunk {
    std::uint32_t meshCount = 0;
    std::uint64_t vertexCount = 0, triangleCount = 0;    ///< of the whole scene
    std::vector<MeshPart> parts;
    bool last = false;
};

/// Zero or empty: as the scene says.
struct Settings {
    std::uint32_t samplesPerPixel = 0;
    std::string integrator, sampler;
    std::uint64_t seed = 0;
    bool hasSeed = false;
    friend bool operator==(const Settings&, const Settings&) = default;
};
struct RenderRequest {
    Settings settings;
    bool preview = false;
    std::uint32_t maximumChunkBytes = 0;
    std::vector<std::string> layers;                 ///< to collect meanwhile, by name
    std::uint64_t surfaceBudget = 0;                 ///< bytes; 0: the server's default
};
struct PreviewTile {
    PixelRect rect;
    SharedArray<Color> colors;                       ///< row by row, as many as the rectangle has pixels
};
/// Announces a finished image; its ImageRows follow.
struct RenderResult {
    std::uint64_t id = 0;
    Settings settings;                               ///< complete
    double seconds = 0;
    std::uint32_t width = 0, height = 0;
    std::vector<Layer> layers;                       ///< that were collected; a SurfaceRequest fetches them
    SurfaceCounts surfaceCounts;
    std::uint64_t surfaceFaces = 0;                  ///< refined ones, that have values
};
struct ImageRows {
    std::uint32_t firstRow = 0, rowCount = 0;
    SharedArray<Color> colors;
    SharedArray<float> samples;                      ///< per pixel
    SharedArray<Color> variance;                     ///< per pixel; empty if the renderer does not know
    bool last = false;
};

enum class Against : std::uint8_t { latestMatching = 0, renderId = 1, givenColors = 2, nothing = 3 };
struct TraceRequest {
    std::vector<Pixel> pixels;                       ///< or
    PixelRect rect;                                  ///< if `pixels` is empty
    Settings settings;
    Against against = Against::latestMatching;
    std::uint64_t renderId = 0;
    SharedArray<Color> colors;
    std::vector<std::string> columns;
    std::string query;
    std::uint64_t budget = 0;
    bool locations = false;
    KeepMatches keep = KeepMatches::all;             ///< with a query
    std::uint32_t keepCount = 0;                     ///< with KeepMatches::brightest
};
struct TraceResult {
    std::vector<Pixel> pixels;
    std::vector<Replay> replays;
    Settings settings;                               ///< complete, as replayed
    std::uint64_t renderId = 0;                      ///< the image it was compared with; 0 if none
    RecordingStats stats;
    double renderSeconds = 0;
    PathSet paths;
    std::optional<MatchCounts> matches;              ///< where a query came with the request
};

/// Layers of a render that is kept.
struct SurfaceRequest {
    std::vector<std::string> layers;                 ///< by name; empty: all that were collected
    Settings settings;                               ///< without a render id: the newest render with these, 0 or empty: any
    std::uint64_t budget = 0;                        ///< reserved
    std::uint64_t renderId = 0;                      ///< 0: the newest that has layers
    std::uint32_t maximumChunkBytes = 0;
};
/// Announces the layers of a render; SurfaceChunks follow.
struct SurfaceResult {
    std::uint64_t renderId = 0;
    std::vector<Layer> layers;
    SurfaceCounts counts;
    std::uint32_t meshCount = 0;
    std::uint64_t faceCount = 0;                     ///< refined faces of all meshes
    std::uint64_t topologyBytes = 0;                 ///< of the subdivisions of all meshes
};
/// Some of the subdivision of one mesh (SurfaceSubdivision::bits). Meshes come in order, at least one part of each.
struct SurfaceMeshPart {
    std::uint32_t mesh = 0;
    std::uint32_t triangleCount = 0;                 ///< of the mesh as the scene has it
    std::uint32_t faceCount = 0;                     ///< refined; 0: the mesh has no values
    std::uint32_t byteCount = 0;                     ///< of the whole subdivision
    std::uint32_t firstByte = 0;                     ///< of this part
    SharedArray<std::uint8_t> bits;
};
/// Some values of array 0, the points per face, or array i + 1, the values of layer i.
struct SurfaceArrayPart {
    std::uint32_t array = 0;
    std::uint64_t first = 0;                         ///< counted in floats
    SharedArray<float> values;
};
/// All meshes come before the first array, arrays in order, each from its begin to its end.
struct SurfaceChunk {
    std::vector<SurfaceMeshPart> meshes;
    std::vector<SurfaceArrayPart> arrays;
    bool last = false;
};

struct ToolRequest {
    std::string tool;
    SharedArray<std::byte> data;
};
struct ToolResult { SharedArray<std::byte> data; };

struct QuitRequest {};

/// Of a kind that only later versions know: a server answers it with notSupported, a client ignores it. Cannot be sent.
struct Unknown { std::uint8_t kind = 0; };

using Body = std::variant<Hello, Welcome, Refusal, Cancel, Progress, Failure, Done, InfoRequest, Info, CameraRequest,
                          Camera, SceneRequest, SceneChunk, RenderRequest, PreviewTile, RenderResult, ImageRows,
                          TraceRequest, TraceResult, SurfaceRequest, ToolRequest, ToolResult, QuitRequest,
                          SurfaceResult, SurfaceChunk, Unknown>;

struct Message {
    std::uint64_t request = 0;                       ///< chosen by the client, not 0; the handshake has 0
    Body body;
};

}  // namespace emca::protocol
