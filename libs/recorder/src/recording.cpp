#include "emca/recorder/recording.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <functional>
#include <mutex>
#include <thread>

#include "assemble.h"
#include "cursor_impl.h"
#include "emca/recorder/handles.h"
#include "emca/recorder/recorder.h"

namespace emca {
namespace detail {

constinit thread_local BasicPathRecorder<true> threadRecorder;

namespace {

struct CoreName {
    std::string_view name;
    std::uint32_t bit;
};
constexpr std::array kCoreNames{
    CoreName{"origin", Core::origin},
    CoreName{"estimate", Core::estimate},
    CoreName{"position", 1u << LogTag::position},
    CoreName{"nee", 1u << LogTag::nextEvent},
    CoreName{"intersection estimate", 1u << LogTag::estimate},
    CoreName{"emission", 1u << LogTag::emission},
    CoreName{"surface", 1u << LogTag::surface},
    CoreName{"event", 1u << LogTag::event},
    CoreName{"contribution", 1u << LogTag::contribution},
    CoreName{"splat", 1u << LogTag::splat},
};

}  // namespace

ColumnChoice::ColumnChoice(const std::vector<std::string>& names) : all(names.empty()) {
    if (all) return;
    core = 0;
    for (const std::string& name : names) {
        const auto it = std::find_if(kCoreNames.begin(), kCoreNames.end(), [&](const CoreName& c) { return c.name == name; });
        constexpr std::string_view kBegin = "data[\"", kEnd = "\"]";
        if (it != kCoreNames.end()) core |= it->bit;
        else if (name.starts_with(kBegin) && name.ends_with(kEnd)) keys.push_back(name.substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size()));
        else keys.push_back(name);
    }
    std::sort(keys.begin(), keys.end());
}

bool ColumnChoice::wantsKey(std::string_view key) const { return all || std::binary_search(keys.begin(), keys.end(), key); }

RecordingShared::RecordingShared(RecordingOptions o) : options(std::move(o)), choice(options.columns), budget(options.budgetBytes) {
    std::sort(options.pixels.begin(), options.pixels.end());
}

bool RecordingShared::asksFor(Pixel pixel) const {
    return std::binary_search(options.pixels.begin(), options.pixels.end(), pixel);
}

bool RecordingShared::keeps(const PathRow& path) const {
    if (path.keptBySplat) return true;
    return path.hasPixel && (options.pixels.empty() || asksFor(path.pixel));
}

}  // namespace detail

using detail::CursorImpl;

struct Recording::Impl {
    explicit Impl(RecordingOptions options) : shared(std::move(options)) {}

    detail::RecordingShared shared;
    std::mutex mutex;  // taken once per scope, never per value
    std::vector<std::unique_ptr<CursorImpl>> cursors;
    std::vector<CursorImpl*> idle;
    std::vector<std::pair<std::thread::id, CursorImpl*>> ofThreads;  // for handles
    RecordingStats stats;
    std::uint64_t id = 0;
};

namespace {
std::atomic<std::uint64_t> nextRecordingId{1};

/// This thread's last cursor for handles. The id, which no other recording ever has, says whether it is still alive.
struct HandleCache {
    std::uint64_t recording = 0;
    CursorImpl* cursor = nullptr;
};
constinit thread_local HandleCache handleCache;
}  // namespace

Recording::Recording(RecordingOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {
    impl_->id = nextRecordingId.fetch_add(1, std::memory_order_relaxed);
}
Recording::~Recording() = default;

const RecordingOptions& Recording::options() const { return impl_->shared.options; }

PathHandle Recording::path(Pixel pixel, std::int64_t sample, std::int32_t part) { return {*this, pixel, sample, part}; }

detail::Cursor* Recording::acquire() {
    const std::lock_guard lock(impl_->mutex);
    if (!impl_->idle.empty()) {
        CursorImpl* cursor = impl_->idle.back();
        impl_->idle.pop_back();
        return cursor;
    }
    impl_->cursors.push_back(std::make_unique<CursorImpl>(impl_->shared));
    return impl_->cursors.back().get();
}

void Recording::release(detail::Cursor* cursor) {
    auto* own = static_cast<CursorImpl*>(cursor);
    own->endScope();
    const std::lock_guard lock(impl_->mutex);
    impl_->idle.push_back(own);
}

detail::Cursor& Recording::ofThisThread() {
    if (handleCache.recording == impl_->id) return *handleCache.cursor;
    const std::lock_guard lock(impl_->mutex);
    for (const auto& [thread, cursor] : impl_->ofThreads)
        if (thread == std::this_thread::get_id()) {
            handleCache = {impl_->id, cursor};
            return *cursor;
        }
    impl_->cursors.push_back(std::make_unique<CursorImpl>(impl_->shared));
    CursorImpl* cursor = impl_->cursors.back().get();
    impl_->ofThreads.emplace_back(std::this_thread::get_id(), cursor);
    handleCache = {impl_->id, cursor};
    return *cursor;
}

Result<PathSet> Recording::finish() {
    for (const auto& [thread, cursor] : impl_->ofThreads) cursor->endScope();
    // Those of handles last, whichever thread came first: of a path that was recorded in both ways, the pieces are put
    // together in this order.
    const auto handles = [&](const CursorImpl* cursor) {
        return std::ranges::any_of(impl_->ofThreads, [cursor](const auto& one) { return one.second == cursor; });
    };
    std::vector<CursorImpl*> cursors;
    for (const auto& cursor : impl_->cursors) cursors.push_back(cursor.get());
    std::stable_partition(cursors.begin(), cursors.end(), std::not_fn(handles));
    return detail::assemble(impl_->shared, cursors, impl_->stats);
}

RecordingStats Recording::stats() const { return impl_->stats; }

RecordScope::RecordScope(Recording& recording, Pixel pixel)
    : recording_(recording), cursor_(recording.acquire()), previous_(detail::threadRecorder.cursor_) {
    cursor_->setPixel(pixel);
    detail::threadRecorder.cursor_ = cursor_;
}

RecordScope::RecordScope(Recording& recording)
    : recording_(recording), cursor_(recording.acquire()), previous_(detail::threadRecorder.cursor_) {
    cursor_->clearPixel();
    detail::threadRecorder.cursor_ = cursor_;
}

RecordScope::~RecordScope() {
    assert(detail::threadRecorder.cursor_ == cursor_ && "a RecordScope ends in the thread and the order in which it began");
    detail::threadRecorder.cursor_ = previous_;
    recording_.release(cursor_);
}

detail::Cursor& VertexHandle::at() const {
    auto& cursor = static_cast<CursorImpl&>(recording_->ofThisThread());
    cursor.select(pixel_, sample_, part_, depth_, subpath_);
    return cursor;
}

detail::Cursor& PathHandle::at() const {
    auto& cursor = static_cast<CursorImpl&>(recording_->ofThisThread());
    cursor.select(pixel_, sample_, part_);
    return cursor;
}

}  // namespace emca
