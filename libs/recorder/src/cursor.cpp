#include "emca/recorder/cursor.h"

#include <algorithm>
#include <cstring>

#include "cursor_impl.h"

namespace emca::detail {
namespace {

CursorImpl& impl(Cursor& cursor) { return static_cast<CursorImpl&>(cursor); }

/// How a stored type lies in a column.
template <typename T>
constexpr ValueType typeFor() {
    if constexpr (std::is_same_v<T, bool>) return ValueType::boolean;
    else if constexpr (std::is_same_v<T, std::int64_t>) return ValueType::integer;
    else if constexpr (std::is_same_v<T, Vec2i>) return ValueType::integer2;
    else if constexpr (std::is_same_v<T, Vec3i>) return ValueType::integer3;
    else if constexpr (std::is_same_v<T, float>) return ValueType::float1;
    else if constexpr (std::is_same_v<T, Vec2f>) return ValueType::float2;
    else if constexpr (std::is_same_v<T, Vec3f>) return ValueType::float3;
    else if constexpr (std::is_same_v<T, double>) return ValueType::double1;
    else if constexpr (std::is_same_v<T, Vec2d>) return ValueType::double2;
    else if constexpr (std::is_same_v<T, Vec3d>) return ValueType::double3;
    else if constexpr (std::is_same_v<T, Color>) return ValueType::color;
    else if constexpr (std::is_same_v<T, ColorA>) return ValueType::colorA;
    else if constexpr (std::is_same_v<T, std::string_view>) return ValueType::text;
    else return ValueType::spectrum;
}

std::uint64_t slotHash(std::uint64_t keyHash, Scope scope, ValueType type) {
    return (keyHash ^ (static_cast<std::uint64_t>(type) << 1) ^ static_cast<std::uint64_t>(scope)) * 0x9e3779b97f4a7c15ull;
}

/// Text longer than this is cut: a value is for a person to read.
constexpr std::size_t kLongestText = 64 * 1024;

}  // namespace

std::uint32_t Interner::add(std::string_view text, Budget& budget) {
    Recent& recent = recent_[(reinterpret_cast<std::uintptr_t>(text.data()) >> 3) % std::size(recent_)];
    // The memory may hold another text by now, so the contents decide.
    if (recent.data == text.data() && recent.size == text.size() && strings_[recent.index] == text) return recent.index;
    const std::uint32_t index = find(text, budget);
    if (index != kNoString && text.size() <= kLongestText) recent = {text.data(), text.size(), index};
    return index;
}

std::uint32_t Interner::find(std::string_view text, Budget& budget) {
    text = text.substr(0, kLongestText);
    const std::uint64_t hash = std::hash<std::string_view>{}(text);
    if (strings_.size() * 2 >= slots_.size()) rehash(std::max<std::size_t>(64, slots_.size() * 2));
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
        const std::uint32_t index = slots_[slot];
        if (index == kNoString) {
            if (!budget.take(text.size() + sizeof(std::string) + 16)) return kNoString;
            slots_[slot] = static_cast<std::uint32_t>(strings_.size());
            strings_.emplace_back(text);
            hashes_.push_back(hash);
            return slots_[slot];
        }
        if (hashes_[index] == hash && strings_[index] == text) return index;
    }
}

void Interner::rehash(std::size_t slots) {
    slots_.assign(slots, kNoString);
    for (std::uint32_t i = 0; i < strings_.size(); ++i) {
        std::size_t slot = hashes_[i] & (slots - 1);
        while (slots_[slot] != kNoString) slot = (slot + 1) & (slots - 1);
        slots_[slot] = i;
    }
}

CursorImpl::CursorImpl(RecordingShared& shared) : shared_(shared), pool_(shared.budget), table_(64, kNone) {}

bool CursorImpl::charge(std::size_t bytes) {
    if (shared_.budget.take(bytes)) return true;
    ++stats_.droppedByBudget;
    return false;
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
    c.vertex_ = CursorImpl::kNone;
    const Index path = c.paths_.size();
    PathRow* place = c.paths_.append(c.pool_);
    c.starved_ = !place;
    if (!place) return void(++c.stats_.droppedByBudget);
    PathRow row;
    row.pixel = c.pixel_;
    row.hasPixel = c.hasPixel_;
    row.byHandle = c.byHandle_;
    row.sample = sample;
    row.part = part;
    row.firstVertex = c.vertices_.size();
    c.path_ = path;
    *place = row;
    c.inPath_ = true;
    c.anyVertex_[0] = c.anyVertex_[1] = false;
    if (c.shared_.options.observer) c.shared_.options.observer->beginPath(row.pixel, sample);
}

void Cursor::endPath() {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return;
    c.finishVertex();
    PathRow& row = c.paths_[c.path_];
    if (c.shared_.options.observer) c.shared_.options.observer->endPath(row.pixel, row.sample);
    if (!row.byHandle && !c.shared_.keeps(row)) c.forgetPath();
    c.inPath_ = false;
    c.path_ = CursorImpl::kNone;
}

/// Takes back everything of the current path, which added nothing to what was asked for.
void CursorImpl::forgetPath() {
    const PathRow& row = paths_[path_];
    ++stats_.pathsNotKept;
    for (PageColumn* column : {&nextEvents_, &estimates_, &emissions_, &surfaces_, &events_, &contributions_})
        column->dropFrom(row.firstVertex);
    splats_.dropFrom(path_);
    for (auto& column : columns_) {
        column->values.dropFrom(column->scope == Scope::path ? path_ : row.firstVertex);
        if (!column->locations.empty()) column->locations.resize(column->values.size());
        if (column->type == ValueType::spectrum) {
            SpectrumSpan last{0, 0};
            if (const std::byte* value = column->values.last()) std::memcpy(&last, value, sizeof last);
            shared_.budget.giveBack((column->floats.size() - last.first - last.size) * sizeof(float));
            column->floats.resize(std::size_t(last.first) + last.size);
        }
    }
    vertices_.shrink(row.firstVertex);
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
    if (!c.shared_.choice.wantsCore(Core::splat)) return;
    if (std::byte* place = c.splats_.append(c.path_, c.path_, c.pool_)) {
        const Splat splat{pixel, value};
        std::memcpy(place, &splat, sizeof splat);
    } else {
        ++c.stats_.droppedByBudget;
    }
}

// Vertices

void CursorImpl::finishVertex() {
    if (vertex_ == kNone) return;
    if (shared_.options.observer) shared_.options.observer->endVertex(vertices_[vertex_].depth);
    vertex_ = kNone;
}

void CursorImpl::startVertex(std::int32_t depth, Subpath subpath) {
    finishVertex();
    const Index vertex = vertices_.size();
    VertexRow* place = vertices_.append(pool_);
    starved_ = !place;
    if (!place) return void(++stats_.droppedByBudget);
    vertex_ = vertex;
    *place = {depth, subpath == Subpath::light ? std::uint8_t(VertexFlag::light) : std::uint8_t(0), {}};
    const auto s = static_cast<std::size_t>(subpath);
    deepest_[s] = anyVertex_[s] ? std::max(deepest_[s], depth) : depth;
    anyVertex_[s] = true;
    if (shared_.options.observer) shared_.options.observer->beginVertex(depth);
}

void Cursor::setDepthIndex(std::int32_t depth, Subpath subpath) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    const auto s = static_cast<std::size_t>(subpath);
    if (!c.anyVertex_[s] || depth > c.deepest_[s]) return c.startVertex(depth, subpath);
    const std::uint8_t light = subpath == Subpath::light ? VertexFlag::light : 0;
    for (Index v = c.vertices_.size(); v-- > c.paths_[c.path_].firstVertex;) {
        if (c.vertices_[v].depth != depth || (c.vertices_[v].flags & VertexFlag::light) != light) continue;
        if (v == c.vertex_) return;
        c.finishVertex();
        c.vertex_ = v;
        if (c.shared_.options.observer) c.shared_.options.observer->beginVertex(depth);
        return;
    }
    c.startVertex(depth, subpath);
}

void Cursor::setPosition(Vec3f position) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    if (!c.shared_.choice.wantsCore(Core::position)) return;
    VertexRow& row = c.vertex();
    row.position = position;
    row.flags |= VertexFlag::hasPosition;
}

void Cursor::setEnvironmentPosition(Vec3f position) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    const std::uint8_t flags = c.vertex().flags;
    if ((flags & VertexFlag::hasPosition) && !(flags & VertexFlag::environment)) {
        const Subpath subpath = (flags & VertexFlag::light) ? Subpath::light : Subpath::camera;
        setDepthIndex(c.vertex().depth + 1, subpath);
        if (c.vertex_ == CursorImpl::kNone) return;
    }
    c.vertex().flags |= VertexFlag::environment;
    setPosition(position);
}

template <typename T>
void CursorImpl::appendCore(PageColumn& column, std::uint32_t bit, const T& value) {
    if (vertex_ == kNone) return dropWithoutVertex();
    if (!shared_.choice.wantsCore(bit)) return;
    if (std::byte* place = column.append(vertex_, paths_[path_].firstVertex, pool_))
        std::memcpy(place, &value, sizeof value);
    else
        ++stats_.droppedByBudget;
}

void Cursor::addNextEvent(Vec3f position, bool visible) {
    CursorImpl& c = impl(*this);
    c.appendCore(c.nextEvents_, Core::nextEvent, NextEvent{position, visible ? 1u : 0u});
}

void Cursor::setSurface(std::int32_t mesh, std::int32_t face) {
    CursorImpl& c = impl(*this);
    c.appendCore(c.surfaces_, Core::surface, SurfaceValue{mesh, face});
}

void Cursor::setEvent(Event event, Lobe lobe, std::string_view label) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    if (!c.shared_.choice.wantsCore(Core::event)) return;
    c.appendCore(c.events_, Core::event, EventValue{label.empty() ? kNoString : c.strings_.add(label, c.shared_.budget), event, lobe});
}

void Cursor::setEstimate(Color estimate) {
    CursorImpl& c = impl(*this);
    c.appendCore(c.estimates_, Core::vertexEstimate, estimate);
}

void Cursor::setEmission(Color emission) {
    CursorImpl& c = impl(*this);
    c.appendCore(c.emissions_, Core::emission, emission);
}

void Cursor::addContribution(Color value, std::string_view technique, float misWeight, LightEnd end) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    if (!c.shared_.choice.wantsCore(Core::contribution)) return;
    const std::uint32_t string = c.strings_.add(technique, c.shared_.budget);
    if (string == kNoString) return void(++c.stats_.droppedByBudget);
    c.appendCore(c.contributions_, Core::contribution, Contribution{value, misWeight, string, end, {}});
}

// User data

// Renderers record the same keys in the same order at every vertex, so that the column after the last one is mostly
// the right one.
KeyedColumn& CursorImpl::column(const Key& key, Scope scope, ValueType type, std::uint32_t bytes) {
    KeyedColumn* guess = lastColumn_ ? lastColumn_->next : nullptr;
    if (!guess || guess->hash != key.hash() || guess->type != type || guess->scope != scope) [[unlikely]] {
        guess = &findColumn(key, scope, type, bytes);
        if (lastColumn_) lastColumn_->next = guess;
    }
    lastColumn_ = guess;
    return *guess;
}

KeyedColumn& CursorImpl::findColumn(const Key& key, Scope scope, ValueType type, std::uint32_t bytes) {
    const std::uint64_t hash = slotHash(key.hash(), scope, type);
    std::size_t mask = table_.size() - 1;
    // The high bits: multiplication mixes upwards.
    for (std::size_t slot = (hash >> 40) & mask;; slot = (slot + 1) & mask) {
        const std::uint32_t index = table_[slot];
        if (index == kNone) break;
        KeyedColumn& found = *columns_[index];
        if (found.hash == key.hash() && found.type == type && found.scope == scope) return found;
    }
    columns_.push_back(std::make_unique<KeyedColumn>(key, scope, type, shared_.choice.wantsKey(key.text()), bytes));
    if (columns_.size() * 2 > table_.size()) {
        table_.assign(table_.size() * 2, kNone);
        mask = table_.size() - 1;
    } else {
        std::fill(table_.begin(), table_.end(), kNone);
    }
    for (std::uint32_t i = 0; i < columns_.size(); ++i) {
        std::size_t slot = (slotHash(columns_[i]->hash, columns_[i]->scope, columns_[i]->type) >> 40) & mask;
        while (table_[slot] != kNone) slot = (slot + 1) & mask;
        table_[slot] = i;
    }
    return *columns_.back();
}

template <typename T>
void CursorImpl::append(const Key& key, Scope scope, Index owner, Index base, const T& value) {
    constexpr ValueType kType = typeFor<T>();
    constexpr bool kSpectrum = kType == ValueType::spectrum;
    KeyedColumn& target = column(key, scope, kType, kSpectrum ? sizeof(SpectrumSpan) : std::uint32_t(byteSize(kType)));
    if (!target.wanted) return;
    [[maybe_unused]] std::uint32_t string = kNoString;
    if constexpr (kSpectrum) {
        if (!charge(value.size() * sizeof(float))) return;
    } else if constexpr (kType == ValueType::text) {
        string = strings_.add(value, shared_.budget);
        if (string == kNoString) return void(++stats_.droppedByBudget);
    }
    std::byte* place = target.values.append(owner, base, pool_);
    if (!place) return void(++stats_.droppedByBudget);
    if constexpr (kType == ValueType::boolean) {
        *place = std::byte(value ? 1 : 0);
    } else if constexpr (kType == ValueType::text) {
        std::memcpy(place, &string, sizeof string);
    } else if constexpr (kSpectrum) {
        const SpectrumSpan span{static_cast<std::uint32_t>(target.floats.size()), static_cast<std::uint32_t>(value.size())};
        target.floats.insert(target.floats.end(), value.begin(), value.end());
        std::memcpy(place, &span, sizeof span);
    } else {
        std::memcpy(place, &value, sizeof value);
    }
    if (shared_.options.locations) [[unlikely]]
        target.locations.push_back(key.where());
}

template <typename T>
void Cursor::addPathData(const Key& key, const T& value) {
    CursorImpl& c = impl(*this);
    if (!c.inPath_) return c.dropWithoutPath();
    c.append(key, Scope::path, c.path_, c.path_, value);
}

template <typename T>
void Cursor::addVertexData(const Key& key, const T& value) {
    CursorImpl& c = impl(*this);
    if (c.vertex_ == CursorImpl::kNone) return c.dropWithoutVertex();
    c.append(key, Scope::vertex, c.vertex_, c.paths_[c.path_].firstVertex, value);
}

#define EMCA_STORED_TYPE(T)                                            \
    template void Cursor::addPathData<T>(const Key&, const T&);        \
    template void Cursor::addVertexData<T>(const Key&, const T&)
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
