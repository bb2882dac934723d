#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/mesh.h"
#include "emca/core/result.h"
#include "emca/core/surface_field.h"
#include "emca/core/surface_tree.h"

namespace emca {

namespace detail {
struct SurfaceCursorState;
struct SurfaceCursorImpl;

/// A point on a face of a mesh, as it was located.
struct SurfacePlace {
    std::uint32_t face = 0, mesh = 0;
    float coordinates[3]{};   ///< weights of the second and third vertex and 0, or a position
    std::uint32_t flags = 0;  ///< kSurfacePosition
};
constexpr std::uint32_t kSurfaceNotCounted = 1;  ///< values of a point that is counted elsewhere
constexpr std::uint32_t kSurfacePosition = 2;
constexpr std::uint32_t kSurfacePlaceWords = 5;  ///< of a record in a log: face, mesh, coordinates
}

constexpr std::size_t kMaxSurfaceLayers = 4096;  ///< of one recorder

/// The geometry of one mesh, as the renderer holds it: world space, scene units. Must outlive the recorder.
struct SurfaceMeshView {
    std::span<const Vec3f> positions;
    std::span<const Triangle> triangles;
};

struct SurfaceOptions {
    std::size_t budgetBytes = 256u << 20;     ///< for everything a recorder allocates; beyond it, data becomes coarser
    /// Points on a face before it divides into four; at least 1. "Several hundred" (Ruppert et al., section 4.1): a density
    /// is then right within some six per cent on each face.
    std::uint32_t samplesPerDivision = 512;
    /// No face divides whose children would have less area than a square with this edge, in scene units. Negative: 1/8192
    /// of the diagonal of the scene.
    float minimumEdge = -1;
    std::uint32_t maximumLevel = 12;          ///< divisions below a face of the scene, at most kMaxSurfaceLevel
};

/// A place on a surface. A small value; belongs to the thread that located it, and must not be used after finish().
class SurfacePoint {
  public:
    /// No place: values added there are ignored.
    SurfacePoint() = default;

  private:
    friend class SurfaceLayer;
    friend class SurfaceCursor;
    friend struct detail::SurfaceCursorState;
    detail::SurfaceCursorState* cursor_ = nullptr;
    std::uint32_t* values_ = nullptr;  ///< where values go while the half of the log that it is part of is still there
    std::uint32_t serial_ = 0;         ///< of that half
    detail::SurfacePlace place_;       ///< for values that come later than that
};

/// Handle to a layer of a recorder, a plain value. The default one belongs to no layer and ignores what is added, so that
/// a renderer may ask for nothing and keep its calls.
class SurfaceLayer {
  public:
    SurfaceLayer() = default;
    explicit operator bool() const { return recorder_ != nullptr; }

    /// Adds one sample at a place. Every call is a sample of its own, also at the same place. NaN and infinity are
    /// counted as invalid and not added. A colour given to a scalar layer adds its luminance, a number given to a colour
    /// layer adds grey. Cost: a few stores into memory of this thread, if it follows locate() within about a hundred
    /// points; else about as much as locate().
    void add(const SurfacePoint& at, float value) const;
    void add(const SurfacePoint& at, Color value) const;
    /// Adds 1: for densities of events.
    void add(const SurfacePoint& at) const { add(at, 1.f); }

  private:
    friend class SurfaceRecorder;
    friend struct detail::SurfaceCursorState;
    const void* recorder_ = nullptr;
    std::uint16_t index_ = 0;     ///< place in the list of layers
    std::uint16_t maskWord_ = 0;  ///< of a record's values: the word that says which are there, and the bit in it
    std::uint16_t value_ = 0;     ///< of a record's values: the first word of this one
    std::uint8_t bit_ = 0, channels_ = 1;
};

/// One thread's way into a recorder. Never shared between threads.
class SurfaceCursor {
  public:
    /// A point on triangle `face` of mesh `mesh`, counted once; the count of points is what drives the subdivision. Call
    /// once per point, then add to any number of layers. A point of an intersection, of a light that was sampled, of
    /// anything: (mesh, face, position).
    ///
    /// \param position  world space, taken to the nearest point of the triangle. Not finite, or no such mesh or face:
    ///                  counted as invalid, and the returned place ignores what is added. A triangle without area keeps
    ///                  its points at its first vertex.
    SurfacePoint locate(std::uint32_t mesh, std::uint32_t face, Vec3f position);
    /// The same with barycentric coordinates, weights of the second and third vertex: faster, as no vertex is read.
    SurfacePoint locate(std::uint32_t mesh, std::uint32_t face, Vec2f barycentrics) {
        SurfacePoint at;
        locate(mesh, face, barycentrics, at);
        return at;
    }
    /// The same, into a point that is there, member by member: a point that is copied as a whole right after it was made
    /// waits for the narrow stores that made it, as long as all the rest takes.
    void locate(std::uint32_t mesh, std::uint32_t face, Vec2f barycentrics, SurfacePoint& at);

  private:
    friend class SurfaceRecorder;
    SurfaceCursor() = default;
    detail::SurfaceCursorState* state_ = nullptr;
};

/// Collects 3D data on surfaces while a renderer runs: named layers, all on one adaptive 1-to-4 subdivision of the meshes.
///
///     SurfaceRecorder recorder(meshes);                      // a std::vector<Mesh>, or views
///     const SurfaceLayer density = *recorder.addLayer({"intersection density", LayerKind::density, "1/m^2", "…"});
///     …                                                      // in every thread, per path or tile:
///     SurfaceCursor& surface = recorder.cursor();
///     const SurfacePoint at = surface.locate(mesh, face, position);
///     density.add(at);
///     …                                                      // when all threads are done:
///     SurfaceField field = recorder.finish();
///
/// Threads write what they add to logs of their own, in the order of the calls. A face belongs to one of many shards; a
/// full log is distributed to blocks, one per shard, a full block is handed to its shard, and whichever thread finds the
/// shard free applies all blocks waiting there, while the others go on. So no thread waits for another, nodes are updated
/// without atomic operations, and counts are exact. (Blocks are bounded: a thread all of whose blocks still wait at busy
/// shards works for other shards, or gives up its time slice.)
///
/// Memory: nothing before the first layer; a face's storage begins with its first point. Beyond the budget, faces do not
/// divide any more, and faces without storage share bins with their neighbours in the mesh (counted as coarse); no
/// sample is lost. Every thread that records at the same time beyond twice the machine's number may exceed the budget by
/// its blocks, at most 1/256 of it.
///
/// Deterministic: counts and, in single-threaded use, everything. With several threads sums are equal within rounding,
/// and the subdivision may differ. Source: Ruppert et al., "EMCA", VMV 2021, section 4.1.
class SurfaceRecorder {
  public:
    /// The meshes' vertices and triangles must outlive the recorder. Triangles with indices beyond their mesh's vertices
    /// count as without area.
    explicit SurfaceRecorder(std::span<const Mesh> meshes, SurfaceOptions options = {});
    explicit SurfaceRecorder(std::vector<SurfaceMeshView> meshes, SurfaceOptions options = {});
    ~SurfaceRecorder();
    SurfaceRecorder(const SurfaceRecorder&) = delete;
    SurfaceRecorder& operator=(const SurfaceRecorder&) = delete;

    /// Before any thread calls cursor(). Errors: invalidArgument (name empty or taken, called after cursor()), tooLarge
    /// (more than kMaxSurfaceLayers).
    Result<SurfaceLayer> addLayer(LayerDescription description);
    /// The layer of this name; where nobody asked for it, the default handle, which ignores what is added.
    SurfaceLayer find(std::string_view name) const;

    /// This thread's cursor: fetch it once per path or tile. Valid until the thread or the recorder ends.
    SurfaceCursor& cursor();

    /// For renderers that go over the image more than once: between two passes over all of it, with the part of all samples
    /// that has been taken, in (0, 1). Faces divide by the number of points that they will have at the end; and from the
    /// first call on, in these calls only. So what a face had before it was divided, and what decides how that is handed
    /// down, both come from whole passes, in whatever order a pass visits the image. No thread may be adding meanwhile, and
    /// points have to be located anew.
    void passDone(double part);

    /// All that was added so far, after post-processing. No thread may be adding meanwhile; recording may go on
    /// afterwards, with points located anew, and finish() be called again.
    ///
    /// Divided faces hand their data down by density (paper, section 4.1). Faces of a sampled mesh without data get that
    /// of their neighbours across edges (also where vertices are duplicated): mean layers all the way to the next data;
    /// densities only as far as missing samples can be chance, keeping the total. Meshes that were never sampled have no
    /// values. Throws nothing; memory for the result comes on top of the budget.
    SurfaceField finish();

    /// For renderers that collect 3D data in a way of their own: what finish() is to return, as it is, instead of what was
    /// added. It holds the layers of layers(), in that order.
    /// Errors: invalidArgument (other layers); protocolViolation (breaks a rule of validate()).
    Result<void> setField(SurfaceField field);

    /// Complete after finish(), else as far as blocks have been applied. `bytesUsed` is always current.
    SurfaceCounts counts() const;
    const std::vector<LayerDescription>& layers() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

namespace detail {

/// std::isfinite that also answers in renderers compiled with -ffast-math.
constexpr bool finiteBits(float f) { return (std::bit_cast<std::uint32_t>(f) & 0x7f800000u) != 0x7f800000u; }

/// What the inline parts of SurfaceCursor and SurfaceLayer need of a thread's cursor: its log, which has two halves. When
/// one is full, the other is distributed and written anew, so that values may come later than their points.
struct SurfaceCursorState {
    std::uint32_t* next = nullptr;             ///< the next record
    std::uint32_t* end = nullptr;              ///< of this half
    std::uint32_t serial = 0;                  ///< number of this half
    std::uint32_t recordWords = 0;
    const std::uint16_t* maskWords = nullptr;  ///< of a record's values; the first is its first word
    std::uint32_t maskWordCount = 0;
    bool hasPositions = false;                 ///< some record was ever located by its position
    SurfaceCursorImpl* impl = nullptr;         ///< all the rest

    /// A record of a place, with no values yet. Its words stand behind kSurfacePlaceWords.
    std::uint32_t* append(std::uint32_t mesh, std::uint32_t face, float x, float y, float z, std::uint32_t flags) {
        if (next == end) [[unlikely]] turn();
        std::uint32_t* const record = next;
        next += recordWords;
        record[0] = face;
        record[1] = mesh;
        record[2] = std::bit_cast<std::uint32_t>(x);
        record[3] = std::bit_cast<std::uint32_t>(y);
        record[4] = std::bit_cast<std::uint32_t>(z);
        // Values are read only where a mask says so. The first mask holds the flags.
        record[kSurfacePlaceWords] = flags;
        for (std::uint32_t i = 1; i < maskWordCount; ++i) record[kSurfacePlaceWords + maskWords[i]] = 0;
        return record + kSurfacePlaceWords;
    }
    /// Whether the values of a record are still to be distributed.
    bool holds(std::uint32_t itsSerial) const { return serial - itsSerial <= 1; }
    /// To the other half.
    void turn();
    /// Adds a value whose record is gone, or whose place in the record is taken, or which is not finite.
    static void addLate(const SurfacePoint& at, const SurfaceLayer& layer, Color value);
};

}  // namespace detail

inline void SurfaceCursor::locate(std::uint32_t mesh, std::uint32_t face, Vec2f barycentrics, SurfacePoint& at) {
    at.cursor_ = state_;
    if (state_ == nullptr) return;
    at.values_ = state_->append(mesh, face, barycentrics.x, barycentrics.y, 0.f, 0);
    at.serial_ = state_->serial;
    at.place_.face = face;
    at.place_.mesh = mesh;
    at.place_.coordinates[0] = barycentrics.x;
    at.place_.coordinates[1] = barycentrics.y;
    at.place_.coordinates[2] = 0;
    at.place_.flags = 0;
}

inline void SurfaceLayer::add(const SurfacePoint& at, float value) const {
    if (!recorder_ || !at.cursor_) return;
    if (at.cursor_->holds(at.serial_) && channels_ == 1 && detail::finiteBits(value) &&
        !(at.values_[maskWord_] >> bit_ & 1)) [[likely]] {
        at.values_[maskWord_] |= 1u << bit_;
        at.values_[value_] = std::bit_cast<std::uint32_t>(value);
        return;
    }
    detail::SurfaceCursorState::addLate(at, *this, Color(value));
}

inline void SurfaceLayer::add(const SurfacePoint& at, Color value) const {
    if (!recorder_ || !at.cursor_) return;
    if (channels_ == 1) return add(at, luminance(value));
    if (at.cursor_->holds(at.serial_) && detail::finiteBits(value.r) && detail::finiteBits(value.g) &&
        detail::finiteBits(value.b) && !(at.values_[maskWord_] >> bit_ & 1)) [[likely]] {
        at.values_[maskWord_] |= 1u << bit_;
        at.values_[value_] = std::bit_cast<std::uint32_t>(value.r);
        at.values_[value_ + 1] = std::bit_cast<std::uint32_t>(value.g);
        at.values_[value_ + 2] = std::bit_cast<std::uint32_t>(value.b);
        return;
    }
    detail::SurfaceCursorState::addLate(at, *this, value);
}

}  // namespace emca
