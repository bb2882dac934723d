#include "emca/recorder/surface_recorder.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <thread>

#include "emca/core/surface_tree.h"
#include "surface_store.h"

namespace emca {
namespace detail {

SurfaceCursorImpl::SurfaceCursorImpl(SurfaceStore& owner)
    : store(owner), serialNumbers(owner.shardCount(), 1), open(owner.shardCount()) {
    serials = serialNumbers.data();
    impl = this;
}

SurfaceCursorImpl::~SurfaceCursorImpl() {
    for (SurfaceBlock* block : blocks) ::operator delete(block);
}

void SurfaceCursorImpl::replaceBlock(std::uint32_t shard) {
    Open& to = open[shard];
    if (to.block != nullptr) {
        to.block->words = static_cast<std::uint32_t>(to.next - to.block->data());
        store.submit(to.block, shard);
        ++serialNumbers[shard];
    }
    to.block = newBlock();
    to.next = to.block->data();
    to.end = to.next + (store.blockBytes() - sizeof(SurfaceBlock)) / sizeof(std::uint32_t);
}

SurfaceBlock* SurfaceCursorImpl::newBlock() {
    for (;;) {
        if (freeBlocks == nullptr) freeBlocks = returned.exchange(nullptr, std::memory_order_acquire);
        if (freeBlocks != nullptr) {
            SurfaceBlock* block = freeBlocks;
            freeBlocks = block->next;
            return block;
        }
        if (blocks.size() < store.blocksPerCursor()) {
            void* memory = ::operator new(store.blockBytes());
            store.addUsed(store.blockBytes());
            auto* block = new (memory) SurfaceBlock{nullptr, this, 0};
            blocks.push_back(block);
            return block;
        }
        // As many blocks as are open at once wait at owners, which other threads are: a thread that outruns them works
        // for them, and only if there is nothing to take over gives them time.
        if (!store.help()) std::this_thread::yield();
    }
}

void SurfaceCursorState::addLate(const SurfacePoint& at, const SurfaceLayer& layer, Color value) {
    SurfaceCursorImpl& cursor = *at.cursor_->impl;
    if (!finiteBits(value.r) || !finiteBits(value.g) || !finiteBits(value.b)) return cursor.countInvalid();
    std::uint32_t* record = cursor.append(at.shard_);
    std::memcpy(record, &at.place_, sizeof at.place_);
    record[kPlaceWords] = at.flags_ | kNotCounted;
    record[layer.maskWord_] |= 1u << layer.bit_;
    record[layer.value_] = std::bit_cast<std::uint32_t>(value.r);
    if (layer.channels_ == 1) return;
    record[layer.value_ + 1] = std::bit_cast<std::uint32_t>(value.g);
    record[layer.value_ + 2] = std::bit_cast<std::uint32_t>(value.b);
}

SurfaceCursorImpl* SurfaceStore::acquire() {
    const std::lock_guard lock(cursorsMutex_);
    if (!isSetUp()) setUp();
    if (!idle_.empty()) {
        SurfaceCursorImpl* cursor = idle_.back();
        idle_.pop_back();
        return cursor;
    }
    return cursors_.emplace_back(std::make_unique<SurfaceCursorImpl>(*this)).get();
}

void SurfaceStore::release(SurfaceCursorImpl* cursor) {
    const std::lock_guard lock(cursorsMutex_);
    idle_.push_back(cursor);
}

void SurfaceStore::flush() {
    const std::lock_guard lock(cursorsMutex_);
    for (const auto& cursor : cursors_)
        for (std::uint32_t shard = 0; shard < shardCount_; ++shard) {
            SurfaceCursorImpl::Open& open = cursor->open[shard];
            if (open.block == nullptr) continue;
            open.block->words = static_cast<std::uint32_t>(open.next - open.block->data());
            submit(open.block, shard);
            open = {};
            ++cursor->serialNumbers[shard];
        }
}

namespace {

/// The cursors of this thread, most recent last; given back when the thread ends.
struct ThreadCursors {
    struct Entry {
        const void* recorder;
        std::weak_ptr<SurfaceStore> store;
        SurfaceCursorImpl* cursor;
        std::unique_ptr<SurfaceCursor> handle;
    };
    std::vector<Entry> entries;

    ~ThreadCursors() {
        for (Entry& entry : entries)
            if (const auto store = entry.store.lock()) store->release(entry.cursor);
    }
};

thread_local ThreadCursors threadCursors;

}  // namespace
}  // namespace detail

struct SurfaceRecorder::Impl {
    std::shared_ptr<detail::SurfaceStore> store;
};

SurfaceRecorder::SurfaceRecorder(std::vector<SurfaceMeshView> meshes, SurfaceOptions options)
    : impl_(std::make_unique<Impl>()) {
    impl_->store = std::make_shared<detail::SurfaceStore>(std::move(meshes), options);
}

namespace {

std::vector<SurfaceMeshView> views(std::span<const Mesh> meshes) {
    std::vector<SurfaceMeshView> out;
    for (const Mesh& mesh : meshes) out.push_back({mesh.positions, mesh.triangles});
    return out;
}

}  // namespace

SurfaceRecorder::SurfaceRecorder(std::span<const Mesh> meshes, SurfaceOptions options)
    : SurfaceRecorder(views(meshes), options) {}

SurfaceRecorder::~SurfaceRecorder() = default;

Result<SurfaceLayer> SurfaceRecorder::addLayer(LayerDescription description) {
    detail::SurfaceStore& store = *impl_->store;
    const auto refuse = [&](ErrorCode code, const char* why) {
        return Error{code, "Surface layer \"" + description.name + "\" cannot be added: " + why};
    };
    if (description.name.empty()) return refuse(ErrorCode::invalidArgument, "give it a name.");
    if (description.kind > LayerKind::density) return refuse(ErrorCode::invalidArgument, "its kind does not exist.");
    if (store.isSetUp())
        return refuse(ErrorCode::invalidArgument, "threads may already be recording; add all layers before cursor().");
    for (const LayerDescription& other : store.descriptions())
        if (other.name == description.name)
            return refuse(ErrorCode::invalidArgument, "there is one of this name; choose another.");
    if (store.descriptions().size() >= kMaxSurfaceLayers)
        return refuse(ErrorCode::tooLarge, "there are already as many as a recorder holds; use a second recorder.");
    const std::string name = description.name;
    store.addLayer(std::move(description));
    return find(name);
}

SurfaceLayer SurfaceRecorder::find(std::string_view name) const {
    const detail::SurfaceStore& store = *impl_->store;
    const auto& all = store.descriptions();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& layer) { return layer.name == name; });
    SurfaceLayer layer;
    if (found == all.end()) return layer;
    const auto index = static_cast<std::size_t>(found - all.begin());
    const detail::SurfaceLayerLayout& layout = store.layouts()[index];
    layer.recorder_ = &store;
    layer.index_ = static_cast<std::uint16_t>(index);
    layer.maskWord_ = layout.maskWord;
    layer.value_ = layout.valueWord;
    layer.bit_ = layout.bit;
    layer.channels_ = layout.channels;
    return layer;
}

SurfaceCursor& SurfaceRecorder::cursor() {
    auto& entries = detail::threadCursors.entries;
    const detail::SurfaceStore* store = impl_->store.get();
    if (!entries.empty() && entries.back().recorder == store && !entries.back().store.expired())
        return *entries.back().handle;
    // An address may have been used again, so only what is alive counts.
    std::erase_if(entries, [](const auto& entry) { return entry.store.expired(); });
    const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.recorder == store; });
    if (found != entries.end()) {
        std::rotate(found, found + 1, entries.end());
        return *entries.back().handle;
    }
    auto handle = std::unique_ptr<SurfaceCursor>(new SurfaceCursor);
    if (store->descriptions().empty()) {
        static SurfaceCursor nothingAskedFor;
        return nothingAskedFor;
    }
    detail::SurfaceCursorImpl* cursor = impl_->store->acquire();
    handle->state_ = cursor;
    entries.push_back({store, impl_->store, cursor, std::move(handle)});
    return *entries.back().handle;
}

/// The global face, or ~0 (and counted) if there is no such place. Faces beyond 2^32 - 1 do not take part.
inline std::uint32_t SurfaceCursor::check(std::uint32_t mesh, std::uint32_t face, bool finite) const {
    detail::SurfaceCursorImpl& cursor = *state_->impl;
    const std::vector<std::uint64_t>& starts = cursor.store.faceStarts();
    if (mesh + std::size_t(1) < starts.size() && finite) [[likely]] {
        const std::uint64_t global = starts[mesh] + face;
        if (global < starts[mesh + 1] && global < kNoFace) [[likely]] return static_cast<std::uint32_t>(global);
    }
    cursor.countInvalid();
    return kNoFace;
}

/// Writes record and point word by word from registers: what was just stored in words is slow to load as a whole.
inline SurfacePoint SurfaceCursor::record(std::uint32_t mesh, std::uint32_t face, std::uint32_t a, std::uint32_t b,
                                          std::uint32_t c, std::uint32_t flags) {
    detail::SurfaceCursorImpl& cursor = *state_->impl;
    const std::uint32_t shard = cursor.store.shardOf(face);
    std::uint32_t* record = cursor.append(shard);
    static_assert(detail::kPlaceWords == 5);
    record[0] = face;
    record[1] = mesh;
    record[2] = a;
    record[3] = b;
    record[4] = c;
    record[detail::kPlaceWords] = flags;
    SurfacePoint at;
    at.cursor_ = state_;
    at.record_ = record;
    at.serial_ = cursor.serialNumbers[shard];
    at.shard_ = shard;
    at.place_ = {face, mesh, {a, b, c}};
    at.flags_ = flags;
    return at;
}

SurfacePoint SurfaceCursor::locate(std::uint32_t mesh, std::uint32_t face, Vec2f barycentrics) {
    if (state_ == nullptr) return {};
    const std::uint32_t global =
        check(mesh, face, detail::finiteBits(barycentrics.x) && detail::finiteBits(barycentrics.y));
    if (global == kNoFace) return {};
    std::uint32_t u = 0, v = 0;
    detail::toFixed(barycentrics.x, barycentrics.y, u, v);
    return record(mesh, global, u, v, 0, 0);
}

SurfacePoint SurfaceCursor::locate(std::uint32_t mesh, std::uint32_t face, Vec3f p) {
    if (state_ == nullptr) return {};
    const std::uint32_t global =
        check(mesh, face, detail::finiteBits(p.x) && detail::finiteBits(p.y) && detail::finiteBits(p.z));
    if (global == kNoFace) return {};
    return record(mesh, global, std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                  std::bit_cast<std::uint32_t>(p.z), detail::kIsPosition);
}

void SurfaceRecorder::passDone(double part) {
    if (impl_->store->isSetUp()) impl_->store->divideAll(part);
}

SurfaceField SurfaceRecorder::finish() {
    detail::SurfaceStore& store = *impl_->store;
    if (store.isSetUp()) store.flush();
    return detail::makeField(store);
}

SurfaceCounts SurfaceRecorder::counts() const { return impl_->store->counts(); }
const std::vector<LayerDescription>& SurfaceRecorder::layers() const { return impl_->store->descriptions(); }

}  // namespace emca
