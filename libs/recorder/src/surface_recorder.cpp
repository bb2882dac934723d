#include "emca/recorder/surface_recorder.h"

#include <algorithm>
#include <bit>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "emca/core/surface_tree.h"
#include "surface_store.h"

namespace emca {
namespace detail {

SurfaceCursorImpl::SurfaceCursorImpl(SurfaceStore& owner)
    : SurfaceCursorState(owner.cursorState()), store(owner), openRecords(owner.shardCount()),
      openBlocks(owner.shardCount(), nullptr) {
    open = openRecords.data();
    impl = this;
}

SurfaceCursorImpl::~SurfaceCursorImpl() {
    for (SurfaceBlock* block : blocks) ::operator delete(block);
}

void SurfaceCursorState::replaceBlock(std::uint32_t shard) { impl->replaceBlock(shard); }

void SurfaceCursorState::countInvalid() { bump(impl->invalid, 1); }

void SurfaceCursorImpl::closeBlock(std::uint32_t shard) {
    SurfaceBlock* block = std::exchange(openBlocks[shard], nullptr);
    if (block == nullptr) return;
    Open& from = openRecords[shard];
    block->words = static_cast<std::uint32_t>(from.next - block->data());
    store.submit(block, shard);
    from = {nullptr, nullptr, from.serial + 1};
}

void SurfaceCursorImpl::replaceBlock(std::uint32_t shard) {
    closeBlock(shard);
    SurfaceBlock* block = openBlocks[shard] = newBlock();
    block->hasPositions = false;
    openRecords[shard].next = block->data();
    openRecords[shard].end = block->data() + (store.blockBytes() - sizeof(SurfaceBlock)) / sizeof(std::uint32_t);
}

/// A record for a place, with no values and no flags yet.
std::uint32_t* SurfaceCursorImpl::appendPlace(const SurfacePlace& place, std::uint32_t shard) {
    std::uint32_t* record = append(shard, place.isPosition ? 2 : 1);
    if (place.isPosition) {
        openBlocks[shard]->hasPositions = true;
        record[0] = kNoFace;
        for (int i = 0; i < 3; ++i) record[1 + i] = std::bit_cast<std::uint32_t>(place.position[i]);
        record += recordWords;
    }
    record[0] = place.face;
    record[1] = place.path;
    record[kPlaceWords] = 0;
    return record;
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
            auto* block = new (memory) SurfaceBlock{nullptr, this, 0, false};
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
    std::uint32_t* record = cursor.appendPlace(at.place_, at.shard_);
    record[kPlaceWords] = kNotCounted;
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
        for (std::uint32_t shard = 0; shard < shardCount_; ++shard) cursor->closeBlock(shard);
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
    std::vector<std::uint32_t> triangleCounts;
    std::optional<SurfaceField> field;  ///< the renderer's own, if it set one
};

SurfaceRecorder::SurfaceRecorder(std::vector<SurfaceMeshView> meshes, SurfaceOptions options)
    : impl_(std::make_unique<Impl>()) {
    for (const SurfaceMeshView& mesh : meshes) impl_->triangleCounts.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
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

SurfacePoint SurfaceCursor::locate(std::uint32_t mesh, std::uint32_t face, Vec3f p) {
    SurfacePoint at;
    if (state_ == nullptr) return at;
    const std::uint32_t global =
        state_->check(mesh, face, detail::finiteBits(p.x) && detail::finiteBits(p.y) && detail::finiteBits(p.z));
    if (global == detail::kNoFace) return at;
    at.cursor_ = state_;
    at.shard_ = state_->shardOf(global);
    at.place_ = {global, mesh, {p.x, p.y, p.z}, true};
    at.record_ = state_->impl->appendPlace(at.place_, at.shard_);
    at.serial_ = state_->open[at.shard_].serial;
    return at;
}

void SurfaceRecorder::passDone(double part) {
    if (impl_->store->isSetUp()) impl_->store->divideAll(part);
}

Result<void> SurfaceRecorder::setField(SurfaceField field) {
    const auto& asked = layers();
    const auto same = [](const SurfaceLayerData& has, const LayerDescription& layer) { return has.description == layer; };
    if (!std::equal(field.layers.begin(), field.layers.end(), asked.begin(), asked.end(), same)) {
        return Error{ErrorCode::invalidArgument, "The field that was set has " + std::to_string(field.layers.size()) +
                                                     " layers other than the " + std::to_string(asked.size()) + " of the recorder: use those of layers(), in that order."};
    }
    if (auto valid = validate(field, impl_->triangleCounts); !valid) return valid;
    impl_->field = std::move(field);
    return {};
}

SurfaceField SurfaceRecorder::finish() {
    if (impl_->field) return *impl_->field;
    detail::SurfaceStore& store = *impl_->store;
    if (store.isSetUp()) store.flush();
    return detail::makeField(store);
}

SurfaceCounts SurfaceRecorder::counts() const { return impl_->store->counts(); }
const std::vector<LayerDescription>& SurfaceRecorder::layers() const { return impl_->store->descriptions(); }

}  // namespace emca
