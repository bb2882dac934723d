#include "assemble.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <unordered_map>

#include "result_memory.h"
#include "user_values.h"
#include "value_column.h"

namespace emca::detail {
namespace {

template <typename T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// What one thread recorded of a path in one go.
struct Piece {
    Index cursor, path;
};

/// What to do with a record of one thread: the tag says it for core quantities, the route for user columns.
struct Route {
    enum Kind : std::uint8_t {
        bytes1 = LogTag::firstUser, bytes4, bytes8, bytes12, bytes16, bytes24, text, spectrum, located,
    };
    std::uint8_t kind = 0;
    ValueType type = ValueType::boolean;
    Scope scope = Scope::vertex;
    UserValues* column = nullptr;
};

std::uint8_t routeKind(ValueType type) {
    if (type == ValueType::text) return Route::text;
    if (type == ValueType::spectrum) return Route::spectrum;
    switch (byteSize(type)) {
        case 1: return Route::bytes1;
        case 4: return Route::bytes4;
        case 8: return Route::bytes8;
        case 12: return Route::bytes12;
        case 16: return Route::bytes16;
        default: return Route::bytes24;
    }
}

/// Dense arrays over all vertices; nullptr where nobody recorded the quantity. In a struct of its own, so that a copy
/// of it stays in registers while values are written.
struct VertexArrays {
    std::int32_t* depths = nullptr;
    std::uint8_t* flags = nullptr;
    Vec3f* positions = nullptr;
    Color* estimates = nullptr;
    Color* emissions = nullptr;
    std::int32_t* meshes = nullptr;
    std::int32_t* faces = nullptr;
    std::uint8_t* events = nullptr;
    std::uint8_t* lobes = nullptr;
    std::uint32_t* labels = nullptr;
};

}  // namespace

/// One pass over the threads' logs, path by path in the order of the result.
class Assembler {
  public:
    Assembler(const RecordingShared& shared, std::span<CursorImpl* const> cursors)
        : shared_(shared), cursors_(cursors), memory_(shared.budget.taken()) {}

    Result<PathSet> run(RecordingStats& stats) {
        std::size_t vertices = 0;
        for (const CursorImpl* cursor : cursors_)
            for (Index p = 0; p < cursor->paths_.size(); ++p) vertices += cursor->paths_[p].vertices;
        if (vertices > 0x7fffffff)
            return Error{ErrorCode::tooLarge,
                         "This recording has more than 2^31 vertices; ask for fewer samples or pixels."};
        orderPaths();
        mergeStrings();
        countValues();
        prepare();
        for (Index p = 0; p < paths_.size(); ++p) fillPath(p);
        finishCore();
        for (UserValues& user : userValues_)
            out_.columns.push_back(user.finish(user.scope() == Scope::path ? paths_.size() : vertexCount_));
        out_.strings = std::move(strings_);
        addUp(stats);
        return PathSet::make(std::move(out_));
    }

  private:
    const PathRow& row(Piece p) const { return cursors_[p.cursor]->paths_[p.path]; }
    LogPosition endOf(Piece p) const {
        const CursorImpl& c = *cursors_[p.cursor];
        return p.path + 1 == c.paths_.size() ? c.logEnd() : c.paths_[p.path + 1].begin;
    }

    void orderPaths() {
        for (Index c = 0; c < cursors_.size(); ++c)
            for (Index p = 0; p < cursors_[c]->paths_.size(); ++p) pieces_.push_back({c, p});
        const auto id = [&](Piece p) { return std::tie(row(p).pixel, row(p).sample, row(p).part); };
        const auto less = [&](Piece a, Piece b) { return id(a) < id(b); };
        if (!std::is_sorted(pieces_.begin(), pieces_.end(), less))
            std::stable_sort(pieces_.begin(), pieces_.end(), less);
        for (Index begin = 0, end = 0; begin < pieces_.size(); begin = end) {
            bool kept = false;
            for (end = begin; end < pieces_.size() && (end == begin || id(pieces_[end]) == id(pieces_[begin])); ++end) {
                const PathRow& piece = row(pieces_[end]);
                kept = kept || !piece.byHandle || shared_.keeps(piece);  // the others were asked at their ends
            }
            if (kept)
                paths_.push_back({begin, end});
            else
                ++notKept_;
        }
    }

    /// In alphabetical order: the order in which threads met them would differ from one replay to the next.
    void mergeStrings() {
        std::map<std::string_view, std::uint32_t> known;
        for (const CursorImpl* cursor : cursors_)
            for (const std::string& text : cursor->strings_.strings()) known.try_emplace(text);
        for (auto& [text, index] : known) {
            index = static_cast<std::uint32_t>(strings_.size());
            strings_.emplace_back(text);
        }
        for (const CursorImpl* cursor : cursors_) {
            std::vector<std::uint32_t>& moved = movedStrings_.emplace_back();
            for (const std::string& text : cursor->strings_.strings()) moved.push_back(known.find(text)->second);
        }
    }

    /// Values by thread and tag. The threads counted them; but where paths are left out, their values are, too.
    void countValues() {
        for (const CursorImpl* cursor : cursors_) {
            std::vector<std::uint32_t>& counts = counts_.emplace_back(LogTag::firstUser + cursor->columns_.size());
            if (notKept_ > 0) continue;
            std::copy_n(cursor->coreCounts_, std::size_t(LogTag::firstUser), counts.begin());
            for (std::uint32_t i = 0; i < cursor->columns_.size(); ++i)
                counts[LogTag::firstUser + i] = cursor->countOf(i);
        }
        for (const IndexRange& path : paths_)
            for (Index i = path.first; i < path.last; ++i) {
                mostVertices_ += row(pieces_[i]).vertices;
                if (notKept_ == 0) continue;
                cursors_[pieces_[i].cursor]->readRecords(
                    row(pieces_[i]).begin, endOf(pieces_[i]),
                    [&](std::uint32_t tag, const std::byte*) { ++counts_[pieces_[i].cursor][tag]; });
            }
    }

    std::size_t coreCount(std::uint16_t tag) const {
        std::size_t count = 0;
        for (const auto& counts : counts_) count += counts[tag];
        return count;
    }

    /// Arrays for all that is there, and the way from each thread's records to them.
    void prepare() {
        preparePaths();
        const std::size_t m = mostVertices_;
        const auto ifAny = [&](std::uint16_t tag) { return coreCount(tag) > 0 ? m : 0; };
        depths_ = memory_.take<std::int32_t>(m);
        vertexFlags_ = memory_.take<std::uint8_t>(m, 0);
        positions_ = memory_.take<Vec3f>(ifAny(LogTag::position), {});
        estimates_ = memory_.take<Color>(ifAny(LogTag::estimate), {});
        emissions_ = memory_.take<Color>(ifAny(LogTag::emission), {});
        meshes_ = memory_.take<std::int32_t>(ifAny(LogTag::surface), -1);
        faces_ = memory_.take<std::int32_t>(ifAny(LogTag::surface), -1);
        events_ = memory_.take<std::uint8_t>(ifAny(LogTag::event), 0);
        lobes_ = memory_.take<std::uint8_t>(ifAny(LogTag::event), 0);
        labels_ = memory_.take<std::uint32_t>(ifAny(LogTag::event), kNoString);
        vertex_ = {depths_.data, vertexFlags_.data, positions_.data, estimates_.data, emissions_.data,
                   meshes_.data, faces_.data, events_.data, lobes_.data, labels_.data};
        nextEvents_ = {coreCount(LogTag::nextEvent), sizeof(NextEvent), false, memory_};
        contributions_ = {coreCount(LogTag::contribution), sizeof(Contribution), false, memory_};
        splats_ = {coreCount(LogTag::splat), sizeof(Splat), false, memory_};
        prepareUserColumns();
    }

    void preparePaths() {
        const std::size_t n = paths_.size();
        pixels_ = memory_.take<Pixel>(n);
        samples_ = memory_.take<std::int64_t>(n);
        parts_ = memory_.take<std::int32_t>(n);
        pathFlags_ = memory_.take<std::uint8_t>(n, 0);
        origins_ = memory_.take<Vec3f>(n, {});
        pathEstimates_ = memory_.take<Color>(n, {});
        firstVertex_ = memory_.take<Index>(n + 1, 0);
    }

    void prepareUserColumns() {
        struct Source {
            Index cursor;
            std::uint32_t column;
        };
        std::map<std::tuple<Scope, std::string_view, ValueType>, std::vector<Source>> groups;
        for (Index c = 0; c < cursors_.size(); ++c) {
            const std::vector<UserColumn>& columns = cursors_[c]->columns_;
            std::vector<Route>& routes = routes_.emplace_back(LogTag::firstUser + columns.size());
            for (std::uint8_t tag = 0; tag < LogTag::firstUser; ++tag) routes[tag].kind = tag;
            for (std::uint32_t i = 0; i < columns.size(); ++i)
                if (counts_[c][LogTag::firstUser + i] > 0)
                    groups[{columns[i].scope, columns[i].name, columns[i].type}].push_back({c, i});
        }
        userValues_.reserve(groups.size());
        for (const auto& [id, sources] : groups) {
            const auto& [scope, name, type] = id;
            std::size_t count = 0;
            for (const Source& s : sources) count += counts_[s.cursor][LogTag::firstUser + s.column];
            const std::size_t owners = scope == Scope::path ? paths_.size() : mostVertices_;
            userValues_.emplace_back(name, scope, type, count, owners, memory_);
            const std::uint8_t kind = shared_.options.locations ? std::uint8_t(Route::located) : routeKind(type);
            for (const Source& s : sources)
                routes_[s.cursor][LogTag::firstUser + s.column] = {kind, type, scope, &userValues_.back()};
        }
    }

    void fillPath(Index p) {
        const auto pieces = std::span(pieces_).subspan(paths_[p].first, paths_[p].size());
        const PathRow& first = row(pieces.front());
        pixels_.data[p] = first.pixel;
        samples_.data[p] = first.sample;
        parts_.data[p] = first.part;
        for (const Piece& piece : pieces) {
            const PathRow& r = row(piece);
            pathFlags_.data[p] |= r.flags;
            if (r.flags & PathFlag::hasOrigin) origins_.data[p] = r.origin;
            if (r.flags & PathFlag::hasEstimate) pathEstimates_.data[p] = r.estimate;
        }
        if (pieces.size() == 1 && first.ordered) {
            places_.resize(std::max<std::size_t>(places_.size(), first.vertices));
            std::iota(places_.begin(), places_.begin() + first.vertices, vertexCount_);
            vertexCount_ += first.vertices;
            fillVertices(pieces.front(), p, places_.data());
        } else {
            const std::vector<Index> begins = placeVertices(pieces);
            for (std::size_t i = 0; i < pieces.size(); ++i) fillVertices(pieces[i], p, places_.data() + begins[i]);
        }
        firstVertex_.data[p + 1] = vertexCount_;
    }

    /// The vertices of one path, which several threads may have recorded in any order: fills places_, and returns where
    /// in it each piece begins.
    std::vector<Index> placeVertices(std::span<const Piece> pieces) {
        struct Found {
            bool light;
            std::int32_t depth;
            Index recorded;  ///< place among the vertices of all pieces
        };
        std::vector<Found> found;
        std::vector<Index> begins;
        for (const Piece& piece : pieces) {
            begins.push_back(static_cast<Index>(found.size()));
            const auto note = [&](std::uint32_t tag, const std::byte* value) {
                if (tag != LogTag::cameraVertex && tag != LogTag::lightVertex) return;
                const auto recorded = static_cast<Index>(found.size());
                found.push_back({tag == LogTag::lightVertex, load<std::int32_t>(value), recorded});
            };
            cursors_[piece.cursor]->readRecords(row(piece).begin, endOf(piece), note);
        }
        const auto key = [](const Found& f) { return std::tie(f.light, f.depth); };
        std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) { return key(a) < key(b); });
        places_.resize(std::max(places_.size(), found.size()));
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (i == 0 || key(found[i - 1]) != key(found[i])) ++vertexCount_;
            places_[found[i].recorded] = vertexCount_ - 1;
        }
        return begins;
    }

    void fillVertices(Piece piece, Index path, const Index* places) {
        Reached reached{places, {path, 0}, 0, 0};
        cursors_[piece.cursor]->log_.read(
            row(piece).begin, endOf(piece),
            [&](const std::byte* at, const std::byte* end) { fillFrom(at, end, piece.cursor, reached); });
    }

    /// Where the reading of a path is.
    struct Reached {
        const Index* places;   ///< in the result, of the vertices in the order in which they were begun
        Index owner[2];        ///< the path and the current vertex
        Index begun;           ///< vertices so far
        std::uint8_t flags;    ///< of the current vertex
    };

    void fillFrom(const std::byte* at, const std::byte* const end, Index cursor, Reached& reached);
    void addUserValue(const Route& route, Index owner, Index cursor, const std::byte*& at);

    void finishCore() {
        const std::size_t n = paths_.size(), m = vertexCount_;
        // What no path has is left out as a whole.
        std::uint8_t used = 0;
        for (std::size_t p = 0; p < n; ++p) used |= pathFlags_.data[p];
        out_.pixels = pixels_.share(n);
        out_.samples = samples_.share(n);
        out_.parts = parts_.share(n);
        out_.pathFlags = pathFlags_.share(n);
        if (used & PathFlag::hasOrigin) out_.origins = origins_.share(n);
        if (used & PathFlag::hasEstimate) out_.estimates = pathEstimates_.share(n);
        out_.firstVertex = firstVertex_.share(n + 1);
        out_.depths = depths_.share(m);
        out_.vertexFlags = vertexFlags_.share(m);
        const auto orNone = [&]<typename T>(const ResultArray<T>& array) { return array.share(array.data ? m : 0); };
        out_.positions = orNone(positions_);
        out_.vertexEstimates = orNone(estimates_);
        out_.emissions = orNone(emissions_);
        out_.meshes = orNone(meshes_);
        out_.faces = orNone(faces_);
        out_.events = orNone(events_);
        out_.lobes = orNone(lobes_);
        out_.labels = orNone(labels_);
        for (ValueColumn* column : {&nextEvents_, &contributions_, &splats_}) column->order();
        out_.nextEventOwners = nextEvents_.owners();
        out_.nextEvents = nextEvents_.share<NextEvent>();
        out_.contributionOwners = contributions_.owners();
        out_.contributions = contributions_.share<Contribution>();
        out_.splatOwners = splats_.owners();
        out_.splats = splats_.share<Splat>();
    }

    std::uint32_t locationText(SourceLine where) {
        const std::string text = std::string(where.file) + ":" + std::to_string(where.line);
        const auto [it, added] = knownLocations_.try_emplace(text, static_cast<std::uint32_t>(strings_.size()));
        if (added) strings_.push_back(text);
        return it->second;
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
    std::vector<Piece> pieces_;
    std::vector<IndexRange> paths_;  ///< pieces of each path of the result
    std::uint64_t notKept_ = 0;
    std::vector<std::vector<std::uint32_t>> counts_, movedStrings_;  ///< by thread
    std::vector<std::vector<Route>> routes_;                         ///< by thread, then by tag
    std::vector<std::string> strings_;
    std::unordered_map<std::string, std::uint32_t> knownLocations_;
    std::size_t mostVertices_ = 0;  ///< before the pieces of a path are joined
    Index vertexCount_ = 0;
    std::vector<Index> places_;

    ResultMemory memory_;
    ResultArray<Pixel> pixels_;
    ResultArray<std::int64_t> samples_;
    ResultArray<std::int32_t> parts_, depths_, meshes_, faces_;
    ResultArray<std::uint8_t> pathFlags_, vertexFlags_, events_, lobes_;
    ResultArray<Vec3f> origins_, positions_;
    ResultArray<Color> pathEstimates_, estimates_, emissions_;
    ResultArray<Index> firstVertex_;
    ResultArray<std::uint32_t> labels_;
    VertexArrays vertex_;
    ValueColumn nextEvents_{0, 0, false, memory_}, contributions_{0, 0, false, memory_}, splats_{0, 0, false, memory_};
    std::vector<UserValues> userValues_;  ///< does not grow once routes lead to it
    PathColumns out_;
};

/// Types of which there is seldom much, and source lines.
void Assembler::addUserValue(const Route& route, Index owner, Index cursor, const std::byte*& at) {
    UserValues& column = *route.column;
    switch (routeKind(route.type)) {
        case Route::bytes1: column.add<1>(owner, at); at += 1; break;
        case Route::bytes4: column.add<4>(owner, at); at += 4; break;
        case Route::bytes8: column.add<8>(owner, at); at += 8; break;
        case Route::bytes12: column.add<12>(owner, at); at += 12; break;
        case Route::bytes16: column.add<16>(owner, at); at += 16; break;
        case Route::bytes24: column.add<24>(owner, at); at += 24; break;
        case Route::text: {
            const std::uint32_t text = movedStrings_[cursor][load<std::uint32_t>(at)];
            column.add<4>(owner, reinterpret_cast<const std::byte*>(&text));
            at += 4;
            break;
        }
        default: {
            const auto entries = load<std::uint32_t>(at);
            at += sizeof entries;
            column.addSpectrum(owner, at, entries);
            at += entries * sizeof(float);
        }
    }
    if (route.kind == Route::located) {
        column.addLocation(locationText(load<SourceLine>(at)));
        at += sizeof(SourceLine);
    }
}

void Assembler::fillFrom(const std::byte* at, const std::byte* const end, Index cursor, Reached& reached) {
    const VertexArrays vertex = vertex_;
    const Route* const routes = routes_[cursor].data();
    const std::uint32_t* const strings = movedStrings_[cursor].data();
    Index owner[2] = {reached.owner[0], reached.owner[1]}, begun = reached.begun;
    Index& v = owner[1];
    std::uint8_t flags = reached.flags;
    const auto leave = [&] {
        if (begun > 0) vertex.flags[v] |= flags;
    };
    while (at < end) {
        const auto tag = load<std::uint16_t>(at);
        at += sizeof tag;
        const Route* route = routes + tag;
        if (tag == LogTag::wide) [[unlikely]] {
            route = routes + LogTag::firstUser + load<std::uint32_t>(at);
            at += sizeof(std::uint32_t);
        }
        const auto to = [&] { return owner[static_cast<std::size_t>(route->scope)]; };
        switch (route->kind) {
            case LogTag::cameraVertex:
            case LogTag::lightVertex:
                leave();
                v = reached.places[begun++];
                vertex.depths[v] = load<std::int32_t>(at);
                flags = tag == LogTag::lightVertex ? std::uint8_t(VertexFlag::light) : std::uint8_t(0);
                at += sizeof(std::int32_t);
                break;
            case LogTag::revisit:
                leave();
                v = reached.places[load<Index>(at)];
                flags = 0;
                at += sizeof(Index);
                break;
            case LogTag::environment: flags |= VertexFlag::environment; break;
            case LogTag::position:
                vertex.positions[v] = load<Vec3f>(at);
                flags |= VertexFlag::hasPosition;
                at += sizeof(Vec3f);
                break;
            case LogTag::estimate:
                vertex.estimates[v] = load<Color>(at);
                flags |= VertexFlag::hasEstimate;
                at += sizeof(Color);
                break;
            case LogTag::emission:
                vertex.emissions[v] = load<Color>(at);
                flags |= VertexFlag::hasEmission;
                at += sizeof(Color);
                break;
            case LogTag::surface: {
                const auto surface = load<SurfaceValue>(at);
                vertex.meshes[v] = surface.mesh;
                vertex.faces[v] = surface.face;
                flags |= VertexFlag::hasSurface;
                at += sizeof surface;
                break;
            }
            case LogTag::event: {
                const auto event = load<EventValue>(at);
                vertex.events[v] = static_cast<std::uint8_t>(event.event);
                vertex.lobes[v] = static_cast<std::uint8_t>(event.lobe);
                vertex.labels[v] = event.label == kNoString ? kNoString : strings[event.label];
                flags |= VertexFlag::hasEvent;
                at += sizeof event;
                break;
            }
            case LogTag::nextEvent: nextEvents_.add<sizeof(NextEvent)>(v, at); at += sizeof(NextEvent); break;
            case LogTag::contribution: {
                auto contribution = load<Contribution>(at);
                contribution.technique = strings[contribution.technique];
                contributions_.add<sizeof(Contribution)>(v, reinterpret_cast<const std::byte*>(&contribution));
                at += sizeof contribution;
                break;
            }
            case LogTag::splat: splats_.add<sizeof(Splat)>(owner[0], at); at += sizeof(Splat); break;
            case Route::bytes4: route->column->add<4>(to(), at); at += 4; break;
            case Route::bytes8: route->column->add<8>(to(), at); at += 8; break;
            case Route::bytes12: route->column->add<12>(to(), at); at += 12; break;
            case Route::text:
                route->column->add<4>(to(), reinterpret_cast<const std::byte*>(&strings[load<std::uint32_t>(at)]));
                at += 4;
                break;
            default: addUserValue(*route, to(), cursor, at); break;
        }
    }
    leave();
    reached.owner[1] = v;
    reached.begun = begun;
    reached.flags = flags;
}

Result<PathSet> assemble(const RecordingShared& shared, std::span<CursorImpl* const> cursors, RecordingStats& stats) {
    return Assembler(shared, cursors).run(stats);
}

}  // namespace emca::detail
