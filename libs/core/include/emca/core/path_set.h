#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/event.h"
#include "emca/core/pixel.h"
#include "emca/core/result.h"
#include "emca/core/shared_array.h"
#include "emca/core/value.h"
#include "emca/core/vector.h"

namespace emca {

/// Index of a vertex or of a path inside one PathSet.
using Index = std::uint32_t;

/// Whether a column's values belong to paths or to vertices.
enum class Scope : std::uint8_t { path = 0, vertex = 1 };

/// First and past-the-end position.
struct IndexRange {
    Index first = 0, last = 0;
    constexpr Index size() const { return last - first; }
    constexpr bool empty() const { return first == last; }
};

/// Values of one recorded key and one type. Value i belongs to path or vertex `owners[i]`; owners never decrease, the
/// values of one owner are in call order. A dense column (one value for every owner, in order) has no owners.
struct Column {
    std::string name;
    Scope scope = Scope::vertex;
    ValueType type = ValueType::float1;
    Index count = 0;                           ///< number of values
    SharedArray<Index> owners;                 ///< empty if dense
    SharedArray<std::byte> bytes;              ///< count * byteSize(type); spectra: all entries in order
    SharedArray<std::uint32_t> spectrumOffsets;///< spectra only: count + 1 positions in floats
    SharedArray<std::uint32_t> locations;      ///< source lines as indices into the string table; empty if not asked for

    bool dense() const { return owners.empty(); }
    Index owner(Index i) const { return dense() ? i : owners[i]; }
    /// Positions of the values of one owner.
    IndexRange valuesOf(Index owner) const;
    /// Typed values. T must be the stored type: std::uint8_t for bool, std::uint32_t (string index) for text, float
    /// for spectra, else the alternative of Value.
    template <typename T>
    std::span<const T> values() const {
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
};

/// A sparse column of a core quantity that may occur several times at a vertex.
/// Next-event estimation: one shadow test.
struct NextEvent {
    Vec3f position;               ///< sampled point on the light, world space
    std::uint32_t visible = 0;    ///< 1 if nothing was in between
};

/// Light that one technique added at a vertex (DESIGN: camera-weighted, MIS-weighted).
struct Contribution {
    Color value;
    float misWeight = 1;            ///< NaN if the renderer did not say
    std::uint32_t technique = 0;    ///< index into the string table
    LightEnd end = LightEnd::automatic;
    std::uint8_t reserved[3] = {};
};

/// Light that a path added to a pixel of the film, in the film's units.
struct Splat {
    Pixel pixel;
    Color value;
};

/// Bits of PathColumns::pathFlags.
struct PathFlag { enum : std::uint8_t { hasOrigin = 1, hasEstimate = 2 }; };

/// Bits of PathColumns::vertexFlags.
struct VertexFlag {
    enum : std::uint8_t {
        hasPosition = 1, environment = 2, hasEstimate = 4, hasEmission = 8, hasSurface = 16, hasEvent = 32, light = 64,
    };
};

/// Everything a PathSet holds. n paths, m vertices. Arrays marked optional may be empty as a whole; where the flag of
/// a path or vertex says that a value is absent, its entry is unspecified.
struct PathColumns {
    // n entries each, ordered by (pixel, sample, part)
    SharedArray<Pixel> pixels;
    SharedArray<std::int64_t> samples;
    SharedArray<std::int32_t> parts;
    SharedArray<std::uint8_t> pathFlags;
    SharedArray<Vec3f> origins;              ///< optional
    SharedArray<Color> estimates;            ///< optional; before division by samples per pixel
    SharedArray<Index> firstVertex;          ///< n + 1, begins with 0, ends with m
    // m entries each, those of a path ordered by (subpath, depth)
    SharedArray<std::int32_t> depths;
    SharedArray<std::uint8_t> vertexFlags;
    SharedArray<Vec3f> positions;            ///< optional; of environment vertices: where the viewer draws the hit
    SharedArray<Color> vertexEstimates;      ///< optional; camera-weighted running sum
    SharedArray<Color> emissions;            ///< optional; unweighted Le
    SharedArray<std::int32_t> meshes;        ///< optional
    SharedArray<std::int32_t> faces;         ///< optional
    SharedArray<std::uint8_t> events;        ///< optional; Event
    SharedArray<std::uint8_t> lobes;         ///< optional; Lobe
    SharedArray<std::uint32_t> labels;       ///< optional; string index of the event's label, kNoString if none
    // sparse, owners never decrease
    SharedArray<Index> nextEventOwners;      ///< vertex
    SharedArray<NextEvent> nextEvents;
    SharedArray<Index> contributionOwners;   ///< vertex
    SharedArray<Contribution> contributions;
    SharedArray<Index> splatOwners;          ///< path
    SharedArray<Splat> splats;
    // user data, ordered by (scope, name, type)
    std::vector<Column> columns;
    std::vector<std::string> strings;
};

inline constexpr std::uint32_t kNoString = 0xffffffffu;

/// What a recording had to leave out.
struct RecordingStats {
    std::uint64_t droppedWithoutPath = 0;    ///< values that came before any setPathIndex
    std::uint64_t droppedWithoutVertex = 0;  ///< vertex values that came before any setDepthIndex
    std::uint64_t droppedByBudget = 0;       ///< values beyond the budget in bytes
    std::uint64_t pathsNotKept = 0;          ///< paths that added nothing to the pixels asked for
    std::uint64_t bytes = 0;                 ///< in use by the recording at its end
    friend bool operator==(const RecordingStats&, const RecordingStats&) = default;
};

/// The recorded paths of one or more pixels: an immutable value whose copies share their columns.
/// All indices are checked once, by make(), so that reading needs no checks.
class PathSet {
  public:
    PathSet() = default;
    /// Checks sizes, orders and indices; data from a file or a network may be anything.
    /// Errors: invalidArgument, naming the column.
    static Result<PathSet> make(PathColumns columns);

    Index pathCount() const { return static_cast<Index>(columns_.pixels.size()); }
    Index vertexCount() const { return static_cast<Index>(columns_.depths.size()); }
    bool empty() const { return pathCount() == 0; }
    const PathColumns& columns() const { return columns_; }

    // Paths, 0 <= path < pathCount().
    Pixel pixel(Index path) const { return columns_.pixels[path]; }
    std::int64_t sample(Index path) const { return columns_.samples[path]; }
    std::int32_t part(Index path) const { return columns_.parts[path]; }
    std::optional<Vec3f> origin(Index path) const;
    std::optional<Color> estimate(Index path) const;
    IndexRange vertices(Index path) const { return {columns_.firstVertex[path], columns_.firstVertex[path + 1]}; }
    /// Largest depth index with a position, 0 if none; environment hits count.
    std::int32_t depth(Index path) const;
    IndexRange splats(Index path) const;

    // Vertices, 0 <= vertex < vertexCount().
    Index pathOf(Index vertex) const;
    std::int32_t depthIndex(Index vertex) const { return columns_.depths[vertex]; }
    Subpath subpath(Index vertex) const { return flag(vertex, VertexFlag::light) ? Subpath::light : Subpath::camera; }
    bool isEnvironment(Index vertex) const { return flag(vertex, VertexFlag::environment); }
    std::optional<Vec3f> position(Index vertex) const;
    std::optional<Color> vertexEstimate(Index vertex) const;
    std::optional<Color> emission(Index vertex) const;
    struct Surface { std::int32_t mesh = 0, face = 0; };
    std::optional<Surface> surface(Index vertex) const;
    struct Scattering { Event event = Event::none; Lobe lobe = Lobe::none; std::string_view label; };
    std::optional<Scattering> scattering(Index vertex) const;
    IndexRange nextEvents(Index vertex) const;
    IndexRange contributions(Index vertex) const;
    const NextEvent& nextEvent(Index i) const { return columns_.nextEvents[i]; }
    const Contribution& contribution(Index i) const { return columns_.contributions[i]; }

    // User data.
    std::span<const Column> userColumns() const { return columns_.columns; }
    /// The columns of one key: usually one, more where it arrived with several types.
    std::vector<const Column*> find(Scope scope, std::string_view name) const;
    /// Value i of a column.
    Value value(const Column& column, Index i) const;
    /// The value of a key at an owner where one is wanted: the last one recorded; nothing if there is none.
    std::optional<Value> last(const Column& column, Index owner) const;
    std::string_view text(std::uint32_t string) const {
        return string < columns_.strings.size() ? std::string_view(columns_.strings[string]) : std::string_view();
    }

    /// Position of a path, or nothing.
    std::optional<Index> findPath(Pixel pixel, std::int64_t sample, std::int32_t part = 0) const;
    /// Position of a vertex of a path, or nothing.
    std::optional<Index> findVertex(Index path, std::int32_t depth, Subpath subpath = Subpath::camera) const;

    /// Paths of several sets in one, ordered; where two hold the same path, that of the later set stays.
    static PathSet merged(std::span<const PathSet> sets);
    /// The paths at these positions, which ascend, as a set of their own.
    PathSet subset(std::span<const Index> paths) const;

  private:
    bool flag(Index vertex, std::uint8_t bit) const { return (columns_.vertexFlags[vertex] & bit) != 0; }
    PathColumns columns_;
};

}  // namespace emca
