#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>
#include <unordered_map>

#include "emca/core/path_set.h"

namespace emca {
namespace {

struct Source {
    Index set, path;
};

/// Strings of several sets in one table.
class StringTable {
  public:
    std::uint32_t add(const std::string& text) {
        const auto [it, added] = indices_.try_emplace(text, static_cast<std::uint32_t>(strings.size()));
        if (added) strings.push_back(text);
        return it->second;
    }
    std::vector<std::string> strings;

  private:
    std::unordered_map<std::string, std::uint32_t> indices_;
};

using StringMaps = std::vector<std::vector<std::uint32_t>>;  // [set][string] -> merged string

std::uint32_t mapped(const StringMaps& maps, Index set, std::uint32_t string) {
    return string < maps[set].size() ? maps[set][string] : kNoString;
}

/// Copies one user column of all sets, path by path.
class ColumnMerger {
  public:
    ColumnMerger(const Column& like) {
        out_.name = like.name;
        out_.scope = like.scope;
        out_.type = like.type;
        offsets_.push_back(0);
    }

    /// Values whose owners are in [first, first + size) of `column`, to owners from `to`.
    void append(const Column& column, Index first, Index size, Index to, const std::vector<std::uint32_t>& strings) {
        const Index last = first + size;
        Index begin, end;
        if (column.count == 0) return;
        if (column.dense()) {
            begin = first;
            end = last;
        } else {
            begin = static_cast<Index>(std::lower_bound(column.owners.begin(), column.owners.end(), first) - column.owners.begin());
            end = static_cast<Index>(std::lower_bound(column.owners.begin(), column.owners.end(), last) - column.owners.begin());
        }
        hasLocations_ = hasLocations_ || !column.locations.empty();
        for (Index i = begin; i < end; ++i) {
            owners_.push_back(column.owner(i) - first + to);
            locations_.push_back(column.locations.empty() || column.locations[i] >= strings.size() ? kNoString : strings[column.locations[i]]);
        }
        if (column.type == ValueType::spectrum) {
            const auto from = column.spectrumOffsets[begin];
            for (Index i = begin; i < end; ++i)
                offsets_.push_back(offsets_.back() + column.spectrumOffsets[i + 1] - column.spectrumOffsets[i]);
            appendBytes(column.bytes.data() + std::size_t(from) * 4, std::size_t(column.spectrumOffsets[end] - from) * 4);
        } else if (column.type == ValueType::text) {
            for (Index i = begin; i < end; ++i) {
                const std::uint32_t string = strings[column.values<std::uint32_t>()[i]];
                appendBytes(reinterpret_cast<const std::byte*>(&string), 4);
            }
        } else {
            const std::size_t size1 = byteSize(column.type);
            appendBytes(column.bytes.data() + begin * size1, (end - begin) * size1);
        }
    }

    Column finish(std::size_t ownerCount) {
        out_.count = static_cast<Index>(owners_.size());
        bool dense = owners_.size() == ownerCount;
        for (std::size_t i = 0; dense && i < owners_.size(); ++i) dense = owners_[i] == i;
        if (!dense) out_.owners = std::move(owners_);
        out_.bytes = std::move(bytes_);
        if (out_.type == ValueType::spectrum) out_.spectrumOffsets = std::move(offsets_);
        if (hasLocations_) out_.locations = std::move(locations_);
        return std::move(out_);
    }

  private:
    void appendBytes(const std::byte* data, std::size_t size) { bytes_.insert(bytes_.end(), data, data + size); }
    Column out_;
    std::vector<Index> owners_;
    std::vector<std::byte> bytes_;
    std::vector<std::uint32_t> offsets_, locations_;
    bool hasLocations_ = false;
};

template <typename T>
void appendSlice(std::vector<T>& to, const SharedArray<T>& from, IndexRange range) {
    if (from.empty())
        to.resize(to.size() + range.size());
    else
        to.insert(to.end(), from.begin() + range.first, from.begin() + range.last);
}

template <typename T>
void appendSparse(std::vector<Index>& owners, std::vector<T>& values, const SharedArray<Index>& fromOwners,
                  const SharedArray<T>& from, IndexRange range, Index to) {
    const auto begin = std::lower_bound(fromOwners.begin(), fromOwners.end(), range.first) - fromOwners.begin();
    const auto end = std::lower_bound(fromOwners.begin(), fromOwners.end(), range.last) - fromOwners.begin();
    for (auto i = begin; i < end; ++i) {
        owners.push_back(fromOwners[static_cast<std::size_t>(i)] - range.first + to);
        values.push_back(from[static_cast<std::size_t>(i)]);
    }
}

std::vector<Source> orderedSources(std::span<const PathSet> sets) {
    std::vector<Source> sources;
    for (Index s = 0; s < sets.size(); ++s)
        for (Index p = 0; p < sets[s].pathCount(); ++p) sources.push_back({s, p});
    const auto id = [&](Source a) { return std::tuple(sets[a.set].pixel(a.path), sets[a.set].sample(a.path), sets[a.set].part(a.path)); };
    std::stable_sort(sources.begin(), sources.end(), [&](Source a, Source b) { return id(a) < id(b); });
    std::vector<Source> kept;
    for (const Source& source : sources) {
        if (!kept.empty() && id(kept.back()) == id(source)) kept.pop_back();
        kept.push_back(source);
    }
    return kept;
}

/// Copies the paths named, in their order, into one set of columns.
PathColumns gathered(std::span<const PathSet> sets, const std::vector<Source>& sources) {
    StringTable strings;
    StringMaps maps(sets.size());
    for (Index s = 0; s < sets.size(); ++s)
        for (const std::string& text : sets[s].columns().strings) maps[s].push_back(strings.add(text));

    std::map<std::tuple<Scope, std::string, ValueType>, ColumnMerger> mergers;
    for (const PathSet& set : sets)
        for (const Column& column : set.userColumns()) mergers.try_emplace({column.scope, column.name, column.type}, column);

    std::vector<Pixel> pixels;
    std::vector<std::int64_t> samples;
    std::vector<std::int32_t> parts, depths, meshes, faces;
    std::vector<std::uint8_t> pathFlags, vertexFlags, events, lobes;
    std::vector<Vec3f> origins, positions;
    std::vector<Color> estimates, vertexEstimates, emissions;
    std::vector<Index> firstVertex{0}, nextEventOwners, contributionOwners, splatOwners;
    std::vector<NextEvent> nextEvents;
    std::vector<Contribution> contributions;
    std::vector<Splat> splats;
    std::vector<std::uint32_t> labels;

    for (const auto [s, p] : sources) {
        const PathColumns& c = sets[s].columns();
        const IndexRange path{p, p + 1}, vertices = sets[s].vertices(p);
        const auto toPath = static_cast<Index>(pixels.size()), toVertex = static_cast<Index>(depths.size());
        appendSlice(pixels, c.pixels, path);
        appendSlice(samples, c.samples, path);
        appendSlice(parts, c.parts, path);
        appendSlice(pathFlags, c.pathFlags, path);
        appendSlice(origins, c.origins, path);
        appendSlice(estimates, c.estimates, path);
        appendSlice(depths, c.depths, vertices);
        appendSlice(vertexFlags, c.vertexFlags, vertices);
        appendSlice(positions, c.positions, vertices);
        appendSlice(vertexEstimates, c.vertexEstimates, vertices);
        appendSlice(emissions, c.emissions, vertices);
        appendSlice(meshes, c.meshes, vertices);
        appendSlice(faces, c.faces, vertices);
        appendSlice(events, c.events, vertices);
        appendSlice(lobes, c.lobes, vertices);
        for (Index v = vertices.first; v < vertices.last; ++v)
            labels.push_back(c.labels.empty() ? kNoString : mapped(maps, s, c.labels[v]));
        firstVertex.push_back(static_cast<Index>(depths.size()));
        appendSparse(nextEventOwners, nextEvents, c.nextEventOwners, c.nextEvents, vertices, toVertex);
        const std::size_t firstContribution = contributions.size();
        appendSparse(contributionOwners, contributions, c.contributionOwners, c.contributions, vertices, toVertex);
        for (std::size_t i = firstContribution; i < contributions.size(); ++i)
            contributions[i].technique = mapped(maps, s, contributions[i].technique);
        appendSparse(splatOwners, splats, c.splatOwners, c.splats, path, toPath);
        for (const Column& column : c.columns) {
            ColumnMerger& merger = mergers.at({column.scope, column.name, column.type});
            if (column.scope == Scope::path)
                merger.append(column, p, 1, toPath, maps[s]);
            else
                merger.append(column, vertices.first, vertices.size(), toVertex, maps[s]);
        }
    }

    PathColumns out;
    out.columns.reserve(mergers.size());
    for (auto& [id, merger] : mergers) out.columns.push_back(merger.finish(std::get<0>(id) == Scope::path ? pixels.size() : depths.size()));
    out.pixels = std::move(pixels);
    out.samples = std::move(samples);
    out.parts = std::move(parts);
    out.pathFlags = std::move(pathFlags);
    out.origins = std::move(origins);
    out.estimates = std::move(estimates);
    out.firstVertex = std::move(firstVertex);
    out.depths = std::move(depths);
    out.vertexFlags = std::move(vertexFlags);
    out.positions = std::move(positions);
    out.vertexEstimates = std::move(vertexEstimates);
    out.emissions = std::move(emissions);
    out.meshes = std::move(meshes);
    out.faces = std::move(faces);
    out.events = std::move(events);
    out.lobes = std::move(lobes);
    out.labels = std::move(labels);
    out.nextEventOwners = std::move(nextEventOwners);
    out.nextEvents = std::move(nextEvents);
    out.contributionOwners = std::move(contributionOwners);
    out.contributions = std::move(contributions);
    out.splatOwners = std::move(splatOwners);
    out.splats = std::move(splats);
    out.strings = std::move(strings.strings);
    return out;
}

}  // namespace

PathSet PathSet::merged(std::span<const PathSet> sets) {
    if (sets.empty()) return {};
    if (sets.size() == 1) return sets[0];
    PathSet set;
    set.columns_ = gathered(sets, orderedSources(sets));
    return set;
}

PathSet PathSet::subset(std::span<const Index> paths) const {
    std::vector<Source> sources;
    sources.reserve(paths.size());
    for (const Index path : paths) sources.push_back({0, path});
    PathSet set;
    set.columns_ = gathered({this, 1}, sources);
    return set;
}

}  // namespace emca
