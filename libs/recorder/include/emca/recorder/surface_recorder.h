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

/// A point on one of all faces of all meshes.
struct SurfacePlace {
    std::uint32_t face = 0;        ///< of all meshes
    std::uint32_t path = 0;        ///< surfacePath(); where only the position is known, the mesh
    float position[3]{};
    bool isPosition = false;
};
}

constexpr std::size_t kMaxSurfaceLayers = 4096;  ///< of one recorder

/// The geometry of one mesh, as the renderer holds it: world space, scene units. Must outlive the recorder.
struct SurfaceMeshView {
    std::span<const Vec3f> positions;
    std::span<const Triangle> triangles;
};

struct SurfaceOptions {
    std::size_t budgetBytes = 256u << 20;     ///< for everything a recorder allocates; beyond it, data becomes coarser
    std::uint32_t samplesPerDivision = 256;   ///< points on a face before it divides into four; at least 1
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
    std::uint32_t* record_ = nullptr;   ///< where values go while the block it is part of is still open
    std::uint32_t serial_ = 0, shard_ = 0;
    detail::SurfacePlace place_;        ///< for values that come later than that
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
    std::uint16_t maskWord_ = 0;  ///< of a record: the word that says which values are there, and the bit in it
    std::uint16_t value_ = 0;     ///< of a record: the first word of the value
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
    SurfacePoint locate(std::uint32_t mesh, std::uint32_t face, Vec2f barycentrics);

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
/// Threads write what they add to blocks of their own. A face belongs to one of many shards; a full block is handed to
/// its shard, and whichever thread finds the shard free applies all blocks waiting there, while the others go on. So no
/// thread waits for another, nodes are updated without atomic operations, and counts are exact. (Blocks are bounded: a
/// thread all of whose blocks still wait at busy shards works for other shards, or gives up its time slice.)
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

/// What the inline parts of SurfaceCursor and SurfaceLayer need of a thread's cursor.
struct SurfaceCursorState {
    /// Where the next record of a shard goes.
    struct Open {
        std::uint32_t* next = nullptr;
        std::uint32_t* end = nullptr;
        std::uint32_t serial = 1;  ///< number of the block
    };
    static constexpr std::uint32_t kNoFace = ~0u;

    Open* open = nullptr;                      ///< per shard
    const std::uint64_t* faceStarts = nullptr; ///< per mesh, and the end
    std::uint32_t meshCount = 0;
    std::uint32_t recordWords = 0, shardShift = 0, shardMask = 0;
    const std::uint16_t* maskWords = nullptr;  ///< of a record; the first is behind the place
    std::uint32_t maskWordCount = 0;
    SurfaceCursorImpl* impl = nullptr;         ///< all the rest

    /// The global face; kNoFace, and counted as invalid, if there is no such place. Faces beyond 2^32 - 1 do not take part.
    std::uint32_t check(std::uint32_t mesh, std::uint32_t face, bool finite) {
        if (mesh < meshCount && finite) [[likely]] {
            const std::uint64_t global = faceStarts[mesh] + face;
            if (global < faceStarts[mesh + 1] && global < kNoFace) [[likely]] return static_cast<std::uint32_t>(global);
        }
        countInvalid();
        return kNoFace;
    }
    std::uint32_t shardOf(std::uint32_t face) const {
        const std::uint32_t run = static_cast<std::uint32_t>(std::uint64_t(face) >> shardShift);
        return (run ^ run >> 7 ^ run >> 13) & shardMask;
    }
    /// Room for `records` records, one after the other, with no values yet in the last; place and flags are for the
    /// caller to write.
    std::uint32_t* append(std::uint32_t shard, std::uint32_t records = 1) {
        Open& to = open[shard];
        const std::uint32_t words = records * recordWords;
        if (to.end - to.next < static_cast<std::ptrdiff_t>(words)) [[unlikely]] replaceBlock(shard);
        std::uint32_t* record = to.next;
        to.next += words;
        // Values are read only where a mask says so. The first mask holds the flags.
        for (std::uint32_t i = 1; i < maskWordCount; ++i) (to.next - recordWords)[maskWords[i]] = 0;
        return record;
    }
    void replaceBlock(std::uint32_t shard);
    void countInvalid();
    /// Adds a value whose block is gone, or whose place in the record is taken, or which is not finite.
    static void addLate(const SurfacePoint& at, const SurfaceLayer& layer, Color value);
};

}  // namespace detail

inline SurfacePoint SurfaceCursor::locate(std::uint32_t mesh, std::uint32_t face, Vec2f barycentrics) {
    SurfacePoint at;
    if (state_ == nullptr) return at;
    const std::uint32_t global =
        state_->check(mesh, face, detail::finiteBits(barycentrics.x) && detail::finiteBits(barycentrics.y));
    if (global == detail::SurfaceCursorState::kNoFace) [[unlikely]] return at;
    std::uint32_t u = 0, v = 0;
    detail::toFixed(barycentrics.x, barycentrics.y, u, v);
    at.cursor_ = state_;
    at.shard_ = state_->shardOf(global);
    at.record_ = state_->append(at.shard_);
    at.serial_ = state_->open[at.shard_].serial;
    at.place_.face = at.record_[0] = global;
    at.place_.path = at.record_[1] = detail::surfacePath(u, v);
    at.record_[2] = 0;
    return at;
}

inline void SurfaceLayer::add(const SurfacePoint& at, float value) const {
    if (!recorder_ || !at.cursor_) return;
    if (at.cursor_->open[at.shard_].serial == at.serial_ && channels_ == 1 && detail::finiteBits(value) &&
        !(at.record_[maskWord_] >> bit_ & 1)) [[likely]] {
        at.record_[maskWord_] |= 1u << bit_;
        at.record_[value_] = std::bit_cast<std::uint32_t>(value);
        return;
    }
    detail::SurfaceCursorState::addLate(at, *this, Color(value));
}

inline void SurfaceLayer::add(const SurfacePoint& at, Color value) const {
    if (!recorder_ || !at.cursor_) return;
    if (channels_ == 1) return add(at, luminance(value));
    if (at.cursor_->open[at.shard_].serial == at.serial_ && detail::finiteBits(value.r) && detail::finiteBits(value.g) &&
        detail::finiteBits(value.b) && !(at.record_[maskWord_] >> bit_ & 1)) [[likely]] {
        at.record_[maskWord_] |= 1u << bit_;
        at.record_[value_] = std::bit_cast<std::uint32_t>(value.r);
        at.record_[value_ + 1] = std::bit_cast<std::uint32_t>(value.g);
        at.record_[value_ + 2] = std::bit_cast<std::uint32_t>(value.b);
        return;
    }
    detail::SurfaceCursorState::addLate(at, *this, value);
}

}  // namespace emca
