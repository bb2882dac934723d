#include "emca/recorder/cursor.h"

#include <cstring>
#include <new>

#include "cursor_impl.h"

namespace emca::detail {
namespace {

CursorImpl& impl(Cursor& cursor) { return static_cast<CursorImpl&>(cursor); }

/// Whether a user column's number is too large for a tag.
bool isWide(std::uint32_t column) { return column >= LogTag::end - LogTag::firstUser; }

template <typename T>
std::span<const std::byte> bytesOf(const T& value) {
    return {reinterpret_cast<const std::byte*>(&value), sizeof value};
}

}  // namespace

CursorImpl::CursorImpl(RecordingShared& shared)
    : shared_(shared), pool_(shared.budget), log_(shared.budget), table_(64, kNone) {
    wanted_ = shared.choice.core;
    wantsUserData_ = shared.choice.wantsUserData();
}

bool CursorImpl::reserve(std::size_t bytes) {
    if (static_cast<std::size_t>(end_ - next_) >= bytes) return true;
    if (!log_.grow(bytes, next_, end_)) {
        ++stats_.droppedByBudget;
        return false;
    }
    if (vertex_ != kNone) limit_ = end_;
    return true;
}

// Paths

void Cursor::setPixel(Pixel pixel) {
    CursorImpl& c = impl(*this);
    c.pixel_ = pixel;
    c.hasPixel_ = true;
}

void Cursor::clearPixel() { impl(*this).hasPixel_ = false; }

void Cursor::setPathIndex(std::int64_t sample, std::int32_t part) {
    CursorImpl& c = impl(*this);
    if (c.inPath_) {
        const PathRow& current = c.paths_[c.path_];
        if (current.sample == sample && current.part == part && current.hasPixel == c.hasPixel_ &&
            (!c.hasPixel_ || current.pixel == c.pixel_))
            return;
        endPath();
    }
    const Index path = c.paths_.size();
    PathRow* place = c.paths_.append(c.pool_);
    c.starved_ = !place;
    if (!place) return void(++c.stats_.droppedByBudget);
    PathRow& row = *new (place) PathRow;
    row.pixel = c.pixel_;
    row.hasPixel = c.hasPixel_;
    row.byHandle = c.byHandle_;
    row.sample = sample;
    row.part = part;
    row.begin = c.logEnd();
    c.path_ = path;
    c.inPath_ = true;
    c.visited_.clear();
    c.deepest_[0] = c.deepest_[1] = CursorImpl::kNoDepth;
    c.ordered_ = true;
    if (c.shared_.options.observer) c.shared_.options.observer->beginPath(row.pixel, sample);
}

void Cursor::endPath() {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return;
    c.finishVertex();
    PathRow& row = c.paths_[c.path_];
    row.vertices = static_cast<Index>(c.visited_.size());
    row.ordered = c.ordered_;
    if (c.shared_.options.observer) c.shared_.options.observer->endPath(row.pixel, row.sample);
    if (!row.byHandle && !c.keeps(row)) c.forgetPath();
    c.inPath_ = false;
    c.path_ = CursorImpl::kNone;
}

/// A pixel's samples come one after the other, so the last pixel that was asked for nearly always decides.
bool CursorImpl::keeps(const PathRow& path) {
    if (path.hasPixel && path.pixel == keptPixel_) return true;
    const bool kept = shared_.keeps(path);
    if (kept && path.hasPixel && !path.keptBySplat) keptPixel_ = path.pixel;
    return kept;
}

/// Takes back everything of the current path, which added nothing to what was asked for.
void CursorImpl::forgetPath() {
    const LogPosition begin = paths_[path_].begin;
    ++stats_.pathsNotKept;
    // A column's two counts may wrap around; their sum does not.
    readRecords(begin, logEnd(), [&](std::uint32_t tag, const std::byte*) {
        --(tag < LogTag::firstUser ? coreCounts_[tag] : columns_[tag - LogTag::firstUser].count);
    });
    log_.rewind(begin, next_, end_);
    paths_.shrink(path_);
}

void Cursor::setPathOrigin(Vec3f origin) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    if (!c.shared_.choice.wantsCore(Core::origin)) return;
    PathRow& row = c.paths_[c.path_];
    row.origin = origin;
    row.flags |= PathFlag::hasOrigin;
}

void Cursor::setFinalEstimate(Color estimate) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    if (!c.shared_.choice.wantsCore(Core::estimate)) return;
    PathRow& row = c.paths_[c.path_];
    row.estimate = estimate;
    row.flags |= PathFlag::hasEstimate;
}

void Cursor::addSplat(Pixel pixel, Color value) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    PathRow& row = c.paths_[c.path_];
    if (c.shared_.options.pixels.empty() || c.shared_.asksFor(pixel)) {
        if (!row.hasPixel && !row.keptBySplat) row.pixel = pixel;  // a light path is named after its first asked pixel
        row.keptBySplat = true;
    }
    if (!c.wants(LogTag::splat) || !c.reserve(sizeof(std::uint16_t) + sizeof(Splat))) return;
    ++c.coreCounts_[LogTag::splat];
    c.put(LogTag::splat, Splat{pixel, value});
}

// Vertices

void CursorImpl::openVertex(Index vertex) {
    vertex_ = vertex;
    vertexFlags_ = visited_[vertex].flags;
    limit_ = end_;
    if (shared_.options.observer) shared_.options.observer->beginVertex(visited_[vertex].depth);
}

void CursorImpl::finishVertex() {
    if (vertex_ == kNone) return;
    if (shared_.options.observer) shared_.options.observer->endVertex(visited_[vertex_].depth);
    visited_[vertex_].flags = vertexFlags_;
    vertex_ = kNone;
    limit_ = nullptr;
}

void CursorImpl::startVertex(std::int32_t depth, Subpath subpath) {
    finishVertex();
    starved_ = !reserve(sizeof(std::uint16_t) + sizeof depth);
    if (starved_) return;
    const bool light = subpath == Subpath::light;
    put(light ? LogTag::lightVertex : LogTag::cameraVertex, depth);
    visited_.push_back({depth, light ? std::uint8_t(VertexFlag::light) : std::uint8_t(0)});
    std::int64_t& deepest = deepest_[light];
    if (depth > deepest) deepest = depth;
    openVertex(static_cast<Index>(visited_.size() - 1));
}

void Cursor::setDepthIndex(std::int32_t depth, Subpath subpath) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    const std::uint8_t light = subpath == Subpath::light ? VertexFlag::light : 0;
    if (depth > c.deepest_[light != 0]) {
        // In the result, the light's vertices come after the camera's.
        if (!light && c.deepest_[1] != CursorImpl::kNoDepth) c.ordered_ = false;
        return c.startVertex(depth, subpath);
    }
    for (auto v = static_cast<Index>(c.visited_.size()); v-- > 0;) {
        if (c.visited_[v].depth != depth || (c.visited_[v].flags & VertexFlag::light) != light) continue;
        if (v == c.vertex_) return;
        c.finishVertex();
        c.starved_ = !c.reserve(sizeof(std::uint16_t) + sizeof v);
        if (c.starved_) return;
        c.put(LogTag::revisit, v);
        return c.openVertex(v);
    }
    c.ordered_ = false;
    c.startVertex(depth, subpath);
}

void Cursor::setEnvironmentPosition(Vec3f position) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    if ((vertexFlags_ & VertexFlag::hasPosition) && !(vertexFlags_ & VertexFlag::environment)) {
        const Subpath subpath = (vertexFlags_ & VertexFlag::light) ? Subpath::light : Subpath::camera;
        setDepthIndex(c.visited_[c.vertex_].depth + 1, subpath);
        if (c.vertex_ == CursorImpl::kNone) return;
    }
    if (!(vertexFlags_ & VertexFlag::environment) && c.reserve(sizeof(std::uint16_t))) {
        const std::uint16_t tag = LogTag::environment;
        std::memcpy(next_, &tag, sizeof tag);
        next_ += sizeof tag;
        vertexFlags_ |= VertexFlag::environment;
    }
    setPosition(position);
}

bool Cursor::makeRoom(std::uint16_t tag, std::size_t bytes) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) {
        c.dropWithoutVertex();
        return false;
    }
    if (!c.wants(tag) || !c.reserve(sizeof tag + bytes)) return false;
    ++coreCounts_[tag];
    return true;
}

void Cursor::recordEvent(Event event, Lobe lobe, std::string_view label) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    add(LogTag::event, EventValue{label.empty() ? kNoString : c.strings_.add(label, c.shared_.budget), event, lobe});
}

void Cursor::recordContribution(Color value, std::string_view technique, float misWeight, LightEnd end) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    const std::uint32_t string = c.strings_.add(technique, c.shared_.budget);
    if (string == kNoString) return void(++c.stats_.droppedByBudget);
    add(LogTag::contribution, Contribution{value, misWeight, string, end, {}});
}

// User data

std::uint32_t CursorImpl::countOf(std::uint32_t column) const {
    const UserColumn& c = columns_[column];
    const std::uint64_t id = columnId(c.hash, c.scope, c.type);
    const FastColumn& fast = fastColumns_[id >> kFastShift];
    return c.count + (fast.id == id ? fast.count : 0);
}

std::uint32_t CursorImpl::findColumn(const KeyParts& key, Scope scope, ValueType type) {
    const std::size_t mask = table_.size() - 1;
    for (std::size_t slot = columnId(key.hash, scope, type) >> 32 & mask;; slot = (slot + 1) & mask) {
        const std::uint32_t index = table_[slot];
        if (index == kNone) return addColumn(key, scope, type);
        const UserColumn& found = columns_[index];
        if (found.hash == key.hash && found.type == type && found.scope == scope) return index;
    }
}

std::uint32_t CursorImpl::addColumn(const KeyParts& key, Scope scope, ValueType type) {
    const auto index = static_cast<std::uint32_t>(columns_.size());
    const bool wanted = shared_.choice.wantsKey(key.text);
    columns_.push_back({key.hash, scope, type, wanted, std::string(key.text)});
    const auto enter = [&](std::uint32_t i) {
        const std::size_t mask = table_.size() - 1;
        std::size_t slot = columnId(columns_[i].hash, columns_[i].scope, columns_[i].type) >> 32 & mask;
        while (table_[slot] != kNone) slot = (slot + 1) & mask;
        table_[slot] = i;
    };
    if (columns_.size() * 2 > table_.size()) {
        table_.assign(table_.size() * 2, kNone);
        for (std::uint32_t i = 0; i < index; ++i) enter(i);
    }
    enter(index);
    const std::uint64_t id = columnId(key.hash, scope, type);
    FastColumn& fast = fastColumns_[id >> kFastShift];
    // Source lines are written only on the slow way.
    if (fast.id == 0 && !isWide(index) && !shared_.options.locations)
        fast = {id, 0, wanted ? static_cast<std::uint16_t>(LogTag::firstUser + index) : std::uint16_t(LogTag::ignored)};
    return index;
}

template <typename T>
void CursorImpl::append(const KeyParts& key, Scope scope, const T& value) {
    constexpr ValueType kType = storedType<T>();
    const std::uint64_t id = columnId(key.hash, scope, kType);
    FastColumn& fast = fastColumns_[id >> kFastShift];
    std::uint32_t column = fast.tag - LogTag::firstUser;
    std::uint32_t* count = &fast.count;
    if (fast.id == id) {
        if (fast.tag == LogTag::ignored) return;
    } else {
        column = findColumn(key, scope, kType);
        if (!columns_[column].wanted) return;
        count = &columns_[column].count;
    }
    const auto write = [&](const auto&... parts) {
        const bool wide = isWide(column), located = shared_.options.locations;
        const std::uint16_t tag =
            wide ? std::uint16_t(LogTag::wide) : static_cast<std::uint16_t>(LogTag::firstUser + column);
        const SourceLine& where = key.where;
        if (!reserve((sizeof tag + ... + parts.size()) + (wide ? sizeof column : 0) + (located ? sizeof where : 0)))
            return;
        const auto put = [&](std::span<const std::byte> bytes) {
            if (!bytes.empty()) std::memcpy(next_, bytes.data(), bytes.size());
            next_ += bytes.size();
        };
        put(bytesOf(tag));
        if (wide) put(bytesOf(column));
        (put(parts), ...);
        if (located) [[unlikely]]
            put(bytesOf(where));
        ++*count;
    };
    if constexpr (kType == ValueType::text) {
        const std::uint32_t string = strings_.add(value, shared_.budget);
        if (string == kNoString) return void(++stats_.droppedByBudget);
        write(bytesOf(string));
    } else if constexpr (kType == ValueType::spectrum) {
        if (value.size_bytes() >= RecordLog::kLongestRecord) return void(++stats_.droppedByBudget);
        const auto entries = static_cast<std::uint32_t>(value.size());
        write(bytesOf(entries), std::as_bytes(value));
    } else {
        static_assert(sizeof value == byteSize(kType));
        write(bytesOf(value));
    }
}

template <typename T>
void Cursor::addPathData(Key key, T value) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    c.append({key.text(), key.hash(), key.where()}, Scope::path, value);
}

/// What addVertexData() could not do: a text or a spectrum, a column that is new or whose place is taken, no vertex, or
/// no room.
template <typename T>
void Cursor::addVertexDataSlowly(std::string_view key, std::uint64_t hash, SourceLine where, T value) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    c.append({key, hash, where}, Scope::vertex, value);
}

#define EMCA_STORED_TYPE(T)                       \
    template void Cursor::addPathData<T>(Key, T); \
    template void Cursor::addVertexDataSlowly<T>(std::string_view, std::uint64_t, SourceLine, T)
EMCA_STORED_TYPE(bool);
EMCA_STORED_TYPE(std::int64_t);
EMCA_STORED_TYPE(Vec2i);
EMCA_STORED_TYPE(Vec3i);
EMCA_STORED_TYPE(float);
EMCA_STORED_TYPE(Vec2f);
EMCA_STORED_TYPE(Vec3f);
EMCA_STORED_TYPE(double);
EMCA_STORED_TYPE(Vec2d);
EMCA_STORED_TYPE(Vec3d);
EMCA_STORED_TYPE(Color);
EMCA_STORED_TYPE(ColorA);
EMCA_STORED_TYPE(std::string_view);
EMCA_STORED_TYPE(std::span<const float>);
#undef EMCA_STORED_TYPE

void CursorImpl::select(Pixel pixel, std::int64_t sample, std::int32_t part) {
    byHandle_ = true;
    setPixel(pixel);
    setPathIndex(sample, part);
}

void CursorImpl::select(Pixel pixel, std::int64_t sample, std::int32_t part, std::int32_t depth, Subpath subpath) {
    select(pixel, sample, part);
    if (inPath_) setDepthIndex(depth, subpath);
}

}  // namespace emca::detail
