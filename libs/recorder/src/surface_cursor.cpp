// What one thread says about points on surfaces, from its log to blocks of the shards.
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <new>
#include <thread>

#include "emca/core/surface_tree.h"
#include "surface_store.h"

namespace emca::detail {

namespace {

/// How many triangles are looked at together: each step is short, so as many as take as long as a miss of the cache.
constexpr std::size_t kPositions = 64;

/// Whether it is in [0, 1]; not for -0. By its bits, of which those of what is negative or not a number are larger.
constexpr bool inUnitInterval(float f) { return std::bit_cast<std::uint32_t>(f) <= std::bit_cast<std::uint32_t>(1.f); }

float number(std::uint32_t word) { return std::bit_cast<float>(word); }

}  // namespace

SurfaceCursorImpl::SurfaceCursorImpl(SurfaceStore& owner)
    : store_(owner), faceStarts_(owner.faceStarts().data()), meshCount_(static_cast<std::uint32_t>(owner.meshes().size())),
      open_(owner.shardCount()) {
    recordWords = kSurfacePlaceWords + owner.valueWords();
    maskWords = owner.maskWords().data();
    maskWordCount = static_cast<std::uint32_t>(owner.maskWords().size());
    impl = this;
}

SurfaceCursorImpl::~SurfaceCursorImpl() {
    for (SurfaceBlock* block : blocks_) ::operator delete(block);
}

void SurfaceCursorState::turn() { impl->turn(); }

void SurfaceCursorImpl::turn() {
    if (log_ == nullptr) {
        halfWords_ = std::size_t(store_.logRecords()) * recordWords;
        log_ = std::make_unique<std::uint32_t[]>(store_.logBytes() / sizeof(std::uint32_t));
        store_.addUsed(store_.logBytes());
    }
    const bool full = next != nullptr;
    ++serial;
    next = half(serial);
    end = next + halfWords_;
    if (otherHalf_) distribute(next, end);
    otherHalf_ = full;
}

void SurfaceCursorImpl::flush() {
    if (otherHalf_) distribute(half(serial + 1), half(serial + 1) + halfWords_);
    if (next != nullptr) distribute(half(serial), next);
    for (std::uint32_t shard = 0; shard < open_.size(); ++shard) closeBlock(shard);
    otherHalf_ = false;
    next = end = nullptr;
    serial += 2;
}

/// A face of all faces; kNoFace where there is no such face.
inline std::uint32_t SurfaceCursorImpl::globalFace(std::uint32_t mesh, std::uint32_t face) const {
    if (mesh >= meshCount_) [[unlikely]] return kNoFace;
    const std::uint64_t global = faceStarts_[mesh] + face;
    return global < faceStarts_[mesh + 1] && global < kNoFace ? static_cast<std::uint32_t>(global) : kNoFace;
}

bool SurfaceCursorImpl::isPlace(const SurfacePlace& at) const {
    return globalFace(at.mesh, at.face) != kNoFace && std::ranges::all_of(at.coordinates, finiteBits);
}

/// From positions to barycentric coordinates, which take their place. In three steps, for many at once: what is prefetched
/// in one is there in the next.
void SurfaceCursorImpl::findBarycentrics(std::uint32_t* record, const std::uint32_t* last) const {
    struct Pending {
        std::uint32_t* record;
        const SurfaceMeshView* mesh;
        const Triangle* triangle;
        Vec3f position;
    } pending[kPositions];
    while (record < last) {
        std::size_t count = 0;
        for (; record < last && count < kPositions; record += recordWords) {
            if (!(record[kSurfacePlaceWords] & kSurfacePosition)) continue;
            const SurfacePlace at{record[0], record[1], {number(record[2]), number(record[3]), number(record[4])}};
            if (!isPlace(at)) {
                record[2] = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::quiet_NaN());
                continue;
            }
            const SurfaceMeshView& mesh = store_.meshes()[at.mesh];
            pending[count] = {record, &mesh, &mesh.triangles[at.face], {at.coordinates[0], at.coordinates[1], at.coordinates[2]}};
            __builtin_prefetch(pending[count++].triangle);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto first = reinterpret_cast<std::uintptr_t>(pending[i].mesh->positions.data());
            // Only a hint: an index beyond the vertices does no harm here.
            for (const std::uint32_t vertex : *pending[i].triangle)
                __builtin_prefetch(reinterpret_cast<const void*>(first + vertex * sizeof(Vec3f)));
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Vec2f weights = SurfaceStore::barycentrics(*pending[i].mesh, *pending[i].triangle, pending[i].position);
            pending[i].record[2] = std::bit_cast<std::uint32_t>(weights.x);
            pending[i].record[3] = std::bit_cast<std::uint32_t>(weights.y);
        }
    }
}

/// Appends records to the blocks of their shards.
void SurfaceCursorImpl::distribute(std::uint32_t* records, const std::uint32_t* last) {
    if (hasPositions) findBarycentrics(records, last);
    // One step after the other for all records: what is computed is independent of each other, and in the middle one the
    // compiler takes four at a time.
    std::uint32_t faces[kMaximumLogRecords], us[kMaximumLogRecords], vs[kMaximumLogRecords], paths[kMaximumLogRecords];
    std::size_t count = 0;
    for (const std::uint32_t* record = records; record < last; record += recordWords, ++count) {
        const float u = number(record[2]), v = number(record[3]);
        faces[count] = globalFace(record[1], record[0]);
        if (inUnitInterval(u) && inUnitInterval(v) && u + v < 1.f) [[likely]] {
            us[count] = static_cast<std::uint32_t>(static_cast<std::int32_t>(u * float(kOne)));
            vs[count] = static_cast<std::uint32_t>(static_cast<std::int32_t>(v * float(kOne)));
        } else if (finiteBits(u) && finiteBits(v)) {
            toFixed(u, v, us[count], vs[count]);
        } else {
            faces[count] = kNoFace;
            us[count] = vs[count] = 0;
        }
    }
    for (std::size_t i = 0; i < count; ++i) paths[i] = surfacePath(us[i], vs[i]);
    const std::uint32_t valueWords = recordWords - kSurfacePlaceWords;
    const SurfaceStore::Sharding sharding = store_.sharding();
    Open* const open = open_.data();
    const std::uint32_t* values = records + kSurfacePlaceWords;
    for (std::size_t i = 0; i < count; ++i, values += recordWords) {
        if (faces[i] == kNoFace) [[unlikely]] {
            if (!(values[0] & kSurfaceNotCounted)) bump(invalid, 1);
            continue;
        }
        const std::uint32_t shard = sharding.of(faces[i]);
        Open& to = open[shard];
        if (to.next >= to.full) [[unlikely]] replaceBlock(shard);
        std::uint32_t* const out = to.next;
        to.next = out + kPlaceWords + valueWords;
        out[0] = faces[i];
        out[1] = paths[i];
        for (std::uint32_t word = 0; word < valueWords; word += kCopyWords)
            std::memcpy(out + kPlaceWords + word, values + word, kCopyWords * sizeof(std::uint32_t));
    }
}

void SurfaceCursorImpl::closeBlock(std::uint32_t shard) {
    Open& from = open_[shard];
    if (from.block == nullptr) return;
    from.block->words = static_cast<std::uint32_t>(from.next - from.block->data());
    store_.submit(from.block, shard);
    from = {};
}

void SurfaceCursorImpl::replaceBlock(std::uint32_t shard) {
    closeBlock(shard);
    SurfaceBlock* block = newBlock();
    const std::size_t words = (store_.blockBytes() - sizeof(SurfaceBlock)) / sizeof(std::uint32_t) - kCopyWords;
    open_[shard] = {block->data(), block->data() + words - store_.recordWords() + 1, block};
}

SurfaceBlock* SurfaceCursorImpl::newBlock() {
    for (;;) {
        if (freeBlocks_ == nullptr) freeBlocks_ = returned.exchange(nullptr, std::memory_order_acquire);
        if (freeBlocks_ != nullptr) {
            SurfaceBlock* block = freeBlocks_;
            freeBlocks_ = block->next;
            return block;
        }
        if (blocks_.size() < store_.blocksPerCursor()) {
            void* memory = ::operator new(store_.blockBytes());
            store_.addUsed(store_.blockBytes());
            auto* block = new (memory) SurfaceBlock{nullptr, this, 0};
            blocks_.push_back(block);
            return block;
        }
        // As many blocks as are open at once wait at owners, which other threads are: a thread that outruns them works
        // for them, and only if there is nothing to take over gives them time.
        if (!store_.help()) std::this_thread::yield();
    }
}

void SurfaceCursorState::addLate(const SurfacePoint& at, const SurfaceLayer& layer, Color value) {
    SurfaceCursorImpl& cursor = *at.cursor_->impl;
    const SurfacePlace& place = at.place_;
    if (!finiteBits(value.r) || !finiteBits(value.g) || !finiteBits(value.b)) {
        if (cursor.isPlace(place)) bump(cursor.invalid, 1);
        return;
    }
    std::uint32_t* values = cursor.append(place.mesh, place.face, place.coordinates[0], place.coordinates[1],
                                          place.coordinates[2], place.flags | kSurfaceNotCounted);
    values[layer.maskWord_] |= 1u << layer.bit_;
    values[layer.value_] = std::bit_cast<std::uint32_t>(value.r);
    if (layer.channels_ == 1) return;
    values[layer.value_ + 1] = std::bit_cast<std::uint32_t>(value.g);
    values[layer.value_ + 2] = std::bit_cast<std::uint32_t>(value.b);
}

}  // namespace emca::detail
