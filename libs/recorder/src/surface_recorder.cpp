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
    for (const auto& cursor : cursors_) cursor->flush();
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
    state_->hasPositions = true;
    at.cursor_ = state_;
    at.values_ = state_->append(mesh, face, p.x, p.y, p.z, detail::kSurfacePosition);
    at.serial_ = state_->serial;
    at.place_ = {face, mesh, {p.x, p.y, p.z}, detail::kSurfacePosition};
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
