#include "assemble.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

namespace emca::detail {
namespace {

constexpr Index kGone = 0xffffffffu;

/// Where a thread's local paths and vertices went.
struct Moved {
    std::vector<Index> paths, vertices;
    std::vector<std::uint32_t> strings;
};

/// Values of one column of the result while they arrive: owners first, then put into order once.
template <typename T>
struct Gathered {
    std::vector<Index> owners;
    std::vector<T> values;

    void add(Index owner, const T& value) {
        owners.push_back(owner);
        values.push_back(value);
    }

    /// Order by owner; values of one owner stay in the order of their arrival.
    void order() {
        if (std::is_sorted(owners.begin(), owners.end())) return;
        std::vector<Index> permutation(owners.size());
        std::iota(permutation.begin(), permutation.end(), 0u);
        std::stable_sort(permutation.begin(), permutation.end(), [&](Index a, Index b) { return owners[a] < owners[b]; });
        apply(permutation, owners);
        apply(permutation, values);
    }

  private:
    template <typename V>
    static void apply(const std::vector<Index>& permutation, std::vector<V>& values) {
        std::vector<V> ordered;
        ordered.reserve(values.size());
        for (const Index i : permutation) ordered.push_back(values[i]);
        values = std::move(ordered);
    }
};

template <typename T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

bool isDense(const std::vector<Index>& owners, std::size_t ownerCount) {
    if (owners.size() != ownerCount) return false;
    for (std::size_t i = 0; i < owners.size(); ++i)
        if (owners[i] != i) return false;
    return true;
}

}  // namespace

/// One pass from threads' columns to the result's.
class Assembler {
  public:
    Assembler(const RecordingShared& shared, std::span<CursorImpl* const> cursors) : shared_(shared), cursors_(cursors), moved_(cursors.size()) {}

    Result<PathSet> run(RecordingStats& stats) {
        std::size_t vertices = 0;
        for (const CursorImpl* cursor : cursors_) vertices += cursor->vertices_.size();
        if (vertices > 0x7fffffff)
            return Error{ErrorCode::tooLarge, "This recording has more than 2^31 vertices; ask for fewer samples or pixels."};
        orderPaths();
        placePathsAndVertices();
        mergeStrings();
        coreColumns();
        userColumns();
        out_.strings = std::move(strings_);
        addUp(stats);
        return PathSet::make(std::move(out_));
    }

  private:
    struct Place {
        Index cursor, path;
    };
    const PathRow& row(Place p) const { return cursors_[p.cursor]->paths_[p.path]; }
    IndexRange localVertices(Place p) const {
        const auto& c = *cursors_[p.cursor];
        const bool last = p.path + 1 == c.paths_.size();
        return {c.paths_[p.path].firstVertex, last ? c.vertices_.size() : c.paths_[p.path + 1].firstVertex};
    }

    void orderPaths() {
        for (Index c = 0; c < cursors_.size(); ++c) {
            moved_[c].paths.assign(cursors_[c]->paths_.size(), kGone);
            moved_[c].vertices.assign(cursors_[c]->vertices_.size(), kGone);
            for (Index p = 0; p < cursors_[c]->paths_.size(); ++p) places_.push_back({c, p});
        }
        const auto id = [&](Place p) { return std::tie(row(p).pixel, row(p).sample, row(p).part); };
        const auto less = [&](Place a, Place b) { return id(a) < id(b); };
        if (!std::is_sorted(places_.begin(), places_.end(), less)) std::stable_sort(places_.begin(), places_.end(), less);
    }

    void placePathsAndVertices() {
        std::vector<Pixel> pixels;
        std::vector<std::int64_t> samples;
        std::vector<std::int32_t> parts;
        std::vector<std::uint8_t> flags;
        std::vector<Vec3f> origins;
        std::vector<Color> estimates;
        std::vector<Index> firstVertex{0};
        for (std::size_t begin = 0, end = 0; begin < places_.size(); begin = end) {
            const PathRow& first = row(places_[begin]);
            bool kept = false;
            for (end = begin; end < places_.size(); ++end) {
                const PathRow& r = row(places_[end]);
                if (std::tie(r.pixel, r.sample, r.part) != std::tie(first.pixel, first.sample, first.part)) break;
                kept = kept || shared_.keeps(r);
            }
            if (!kept) {
                ++notKept_;
                continue;
            }
            const auto path = static_cast<Index>(pixels.size());
            pixels.push_back(first.pixel);
            samples.push_back(first.sample);
            parts.push_back(first.part);
            flags.push_back(0);
            origins.emplace_back();
            estimates.emplace_back();
            for (std::size_t i = begin; i < end; ++i) {
                const PathRow& r = row(places_[i]);
                moved_[places_[i].cursor].paths[places_[i].path] = path;
                flags.back() |= r.flags;
                if (r.flags & PathFlag::hasOrigin) origins.back() = r.origin;
                if (r.flags & PathFlag::hasEstimate) estimates.back() = r.estimate;
            }
            placeVertices(std::span(places_).subspan(begin, end - begin));
            firstVertex.push_back(static_cast<Index>(depths_.size()));
        }
        // What no path has is left out as a whole.
        std::uint8_t used = 0;
        for (const std::uint8_t f : flags) used |= f;
        if (!(used & PathFlag::hasOrigin)) origins.clear();
        if (!(used & PathFlag::hasEstimate)) estimates.clear();
        out_.pixels = std::move(pixels);
        out_.samples = std::move(samples);
        out_.parts = std::move(parts);
        out_.pathFlags = std::move(flags);
        out_.origins = std::move(origins);
        out_.estimates = std::move(estimates);
        out_.firstVertex = std::move(firstVertex);
    }

    /// Vertices of one path, which several threads may have recorded in any order.
    void placeVertices(std::span<const Place> parts) {
        scratch_.clear();
        for (const Place& part : parts) {
            const IndexRange range = localVertices(part);
            for (Index v = range.first; v < range.last; ++v) scratch_.push_back({part.cursor, v});
        }
        const auto key = [&](const Place& p) {
            const VertexRow& v = cursors_[p.cursor]->vertices_[p.path];
            return std::tuple(v.flags & VertexFlag::light, v.depth);
        };
        const auto less = [&](const Place& a, const Place& b) { return key(a) < key(b); };
        if (!std::is_sorted(scratch_.begin(), scratch_.end(), less)) std::stable_sort(scratch_.begin(), scratch_.end(), less);
        for (std::size_t i = 0; i < scratch_.size(); ++i) {
            const VertexRow& v = cursors_[scratch_[i].cursor]->vertices_[scratch_[i].path];
            if (i == 0 || key(scratch_[i - 1]) != key(scratch_[i])) {
                depths_.push_back(v.depth);
                vertexFlags_.push_back(0);
                positions_.emplace_back();
            }
            vertexFlags_.back() |= v.flags;
            if (v.flags & VertexFlag::hasPosition) positions_.back() = v.position;
            moved_[scratch_[i].cursor].vertices[scratch_[i].path] = static_cast<Index>(depths_.size() - 1);
        }
    }

    void mergeStrings() {
        std::unordered_map<std::string_view, std::uint32_t> known;
        for (std::size_t c = 0; c < cursors_.size(); ++c)
            for (const std::string& text : cursors_[c]->strings_.strings())
                moved_[c].strings.push_back(string(known, text));
    }

    std::uint32_t string(std::unordered_map<std::string_view, std::uint32_t>& known, std::string_view text) {
        const auto [it, added] = known.try_emplace(text, static_cast<std::uint32_t>(strings_.size()));
        if (added) strings_.emplace_back(text);
        return it->second;
    }

    /// Reads one core column of all threads: visit(final vertex or path, value, cursor index).
    template <typename T, typename Visit>
    void each(PageColumn CursorImpl::*column, bool ofPaths, Visit&& visit) {
        for (Index c = 0; c < cursors_.size(); ++c) {
            const std::vector<Index>& map = ofPaths ? moved_[c].paths : moved_[c].vertices;
            (cursors_[c]->*column).forEach([&](Index owner, const std::byte* bytes) {
                if (map[owner] != kGone) visit(map[owner], load<T>(bytes), c);
            });
        }
    }

    void coreColumns() {
        const std::size_t m = depths_.size();
        dense<Color>(&CursorImpl::estimates_, VertexFlag::hasEstimate, m, out_.vertexEstimates);
        dense<Color>(&CursorImpl::emissions_, VertexFlag::hasEmission, m, out_.emissions);
        std::vector<std::int32_t> meshes, faces;
        each<SurfaceValue>(&CursorImpl::surfaces_, false, [&](Index v, const SurfaceValue& s, Index) {
            if (meshes.empty()) meshes.assign(m, -1), faces.assign(m, -1);
            meshes[v] = s.mesh;
            faces[v] = s.face;
            vertexFlags_[v] |= VertexFlag::hasSurface;
        });
        std::vector<std::uint8_t> events, lobes;
        std::vector<std::uint32_t> labels;
        each<EventValue>(&CursorImpl::events_, false, [&](Index v, const EventValue& e, Index c) {
            if (events.empty()) events.assign(m, 0), lobes.assign(m, 0), labels.assign(m, kNoString);
            events[v] = static_cast<std::uint8_t>(e.event);
            lobes[v] = static_cast<std::uint8_t>(e.lobe);
            labels[v] = e.label == kNoString ? kNoString : moved_[c].strings[e.label];
            vertexFlags_[v] |= VertexFlag::hasEvent;
        });
        Gathered<NextEvent> nextEvents;
        each<NextEvent>(&CursorImpl::nextEvents_, false, [&](Index v, const NextEvent& e, Index) { nextEvents.add(v, e); });
        Gathered<Contribution> contributions;
        each<Contribution>(&CursorImpl::contributions_, false, [&](Index v, Contribution e, Index c) {
            e.technique = moved_[c].strings[e.technique];
            contributions.add(v, e);
        });
        Gathered<Splat> splats;
        each<Splat>(&CursorImpl::splats_, true, [&](Index p, const Splat& s, Index) { splats.add(p, s); });
        sparse(nextEvents, out_.nextEventOwners, out_.nextEvents);
        sparse(contributions, out_.contributionOwners, out_.contributions);
        sparse(splats, out_.splatOwners, out_.splats);
        out_.meshes = std::move(meshes);
        out_.faces = std::move(faces);
        out_.events = std::move(events);
        out_.lobes = std::move(lobes);
        out_.labels = std::move(labels);
        out_.depths = std::move(depths_);
        out_.vertexFlags = std::move(vertexFlags_);
        out_.positions = std::move(positions_);
    }

    template <typename T>
    void dense(PageColumn CursorImpl::*column, std::uint8_t flag, std::size_t size, SharedArray<T>& out) {
        std::vector<T> values;
        each<T>(column, false, [&](Index v, const T& value, Index) {
            if (values.empty()) values.resize(size);
            values[v] = value;
            vertexFlags_[v] |= flag;
        });
        out = std::move(values);
    }

    template <typename T>
    static void sparse(Gathered<T>& gathered, SharedArray<Index>& owners, SharedArray<T>& values) {
        gathered.order();
        owners = std::move(gathered.owners);
        values = std::move(gathered.values);
    }

    void userColumns() {
        std::map<std::tuple<Scope, std::string_view, ValueType>, std::vector<std::pair<Index, const KeyedColumn*>>> groups;
        for (Index c = 0; c < cursors_.size(); ++c)
            for (const auto& column : cursors_[c]->columns_)
                if (column->wanted && column->values.size() > 0) groups[{column->scope, column->name, column->type}].push_back({c, column.get()});
        for (const auto& [id, sources] : groups) userColumn(std::get<0>(id), std::get<2>(id), sources);
    }

    struct Slot {
        const std::byte* value;
        Index source, position;
    };

    void userColumn(Scope scope, ValueType type, const std::vector<std::pair<Index, const KeyedColumn*>>& sources) {
        Gathered<Slot> gathered;
        for (Index s = 0; s < sources.size(); ++s) {
            const Moved& moved = moved_[sources[s].first];
            const std::vector<Index>& map = scope == Scope::path ? moved.paths : moved.vertices;
            Index position = 0;
            sources[s].second->values.forEach([&](Index owner, const std::byte* value) {
                if (map[owner] != kGone) gathered.add(map[owner], {value, s, position});
                ++position;
            });
        }
        if (gathered.owners.empty()) return;
        gathered.order();
        Column column;
        column.name = sources.front().second->name;
        column.scope = scope;
        column.type = type;
        column.count = static_cast<Index>(gathered.owners.size());
        copyValues(gathered.values, sources, column);
        if (shared_.options.locations) column.locations = locations(gathered.values, sources);
        const std::size_t ownerCount = scope == Scope::path ? out_.pixels.size() : out_.depths.size();
        if (!isDense(gathered.owners, ownerCount)) column.owners = std::move(gathered.owners);
        out_.columns.push_back(std::move(column));
    }

    void copyValues(const std::vector<Slot>& slots, const std::vector<std::pair<Index, const KeyedColumn*>>& sources, Column& column) {
        if (column.type == ValueType::spectrum) {
            std::vector<std::uint32_t> offsets{0};
            std::vector<std::byte> bytes;
            for (const Slot& slot : slots) {
                const auto span = load<SpectrumSpan>(slot.value);
                const auto* floats = reinterpret_cast<const std::byte*>(sources[slot.source].second->floats.data() + span.first);
                bytes.insert(bytes.end(), floats, floats + std::size_t(span.size) * sizeof(float));
                offsets.push_back(offsets.back() + span.size);
            }
            column.bytes = std::move(bytes);
            column.spectrumOffsets = std::move(offsets);
            return;
        }
        const std::size_t size = byteSize(column.type);
        std::vector<std::byte> bytes(slots.size() * size);
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (column.type == ValueType::text) {
                const std::uint32_t text = moved_[sources[slots[i].source].first].strings[load<std::uint32_t>(slots[i].value)];
                std::memcpy(&bytes[i * size], &text, sizeof text);
            } else {
                std::memcpy(&bytes[i * size], slots[i].value, size);
            }
        }
        column.bytes = std::move(bytes);
    }

    std::vector<std::uint32_t> locations(const std::vector<Slot>& slots, const std::vector<std::pair<Index, const KeyedColumn*>>& sources) {
        std::vector<std::uint32_t> out;
        for (const Slot& slot : slots) {
            const std::source_location& where = sources[slot.source].second->locations[slot.position];
            const std::string text = std::string(where.file_name()) + ":" + std::to_string(where.line());
            const auto [it, added] = knownLocations_.try_emplace(text, static_cast<std::uint32_t>(strings_.size()));
            if (added) strings_.push_back(text);
            out.push_back(it->second);
        }
        return out;
    }

    void addUp(RecordingStats& stats) const {
        stats = {};
        for (const CursorImpl* cursor : cursors_) {
            stats.droppedWithoutPath += cursor->stats_.droppedWithoutPath;
            stats.droppedWithoutVertex += cursor->stats_.droppedWithoutVertex;
            stats.droppedByBudget += cursor->stats_.droppedByBudget;
            stats.pathsNotKept += cursor->stats_.pathsNotKept;
        }
        stats.pathsNotKept += notKept_;
        stats.bytes = shared_.budget.taken();
    }

    const RecordingShared& shared_;
    std::span<CursorImpl* const> cursors_;
    std::vector<Moved> moved_;
    std::vector<Place> places_, scratch_;
    std::vector<std::int32_t> depths_;
    std::vector<std::uint8_t> vertexFlags_;
    std::vector<Vec3f> positions_;
    std::vector<std::string> strings_;
    std::unordered_map<std::string, std::uint32_t> knownLocations_;
    std::uint64_t notKept_ = 0;
    PathColumns out_;
};

Result<PathSet> assemble(const RecordingShared& shared, std::span<CursorImpl* const> cursors, RecordingStats& stats) {
    return Assembler(shared, cursors).run(stats);
}

}  // namespace emca::detail
