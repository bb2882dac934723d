#include "emca/core/path_set.h"

#include <algorithm>
#include <cstring>
#include <tuple>

namespace emca {
namespace {

/// First and last position of `owner` in a sorted list of owners.
IndexRange rangeOf(const SharedArray<Index>& owners, Index owner) {
    const auto [first, last] = std::equal_range(owners.begin(), owners.end(), owner);
    return {static_cast<Index>(first - owners.begin()), static_cast<Index>(last - owners.begin())};
}

}  // namespace

IndexRange Column::valuesOf(Index owner) const {
    if (count == 0) return {};
    if (dense()) return owner < count ? IndexRange{owner, owner + 1} : IndexRange{};
    return rangeOf(owners, owner);
}

std::optional<Vec3f> PathSet::origin(Index path) const {
    if (!(columns_.pathFlags[path] & PathFlag::hasOrigin)) return std::nullopt;
    return columns_.origins[path];
}

std::optional<Color> PathSet::estimate(Index path) const {
    if (!(columns_.pathFlags[path] & PathFlag::hasEstimate)) return std::nullopt;
    return columns_.estimates[path];
}

std::int32_t PathSet::depth(Index path) const {
    const IndexRange range = vertices(path);
    std::int32_t deepest = 0;
    for (Index v = range.first; v < range.last; ++v)
        if (columns_.vertexFlags[v] & (VertexFlag::hasPosition | VertexFlag::environment))
            deepest = std::max(deepest, columns_.depths[v]);
    return deepest;
}

IndexRange PathSet::splats(Index path) const { return rangeOf(columns_.splatOwners, path); }

Index PathSet::pathOf(Index vertex) const {
    const auto it = std::upper_bound(columns_.firstVertex.begin(), columns_.firstVertex.end(), vertex);
    return static_cast<Index>(it - columns_.firstVertex.begin()) - 1;
}

std::optional<Vec3f> PathSet::position(Index vertex) const {
    if (!flag(vertex, VertexFlag::hasPosition)) return std::nullopt;
    return columns_.positions[vertex];
}

std::optional<Color> PathSet::vertexEstimate(Index vertex) const {
    if (!flag(vertex, VertexFlag::hasEstimate)) return std::nullopt;
    return columns_.vertexEstimates[vertex];
}

std::optional<Color> PathSet::emission(Index vertex) const {
    if (!flag(vertex, VertexFlag::hasEmission)) return std::nullopt;
    return columns_.emissions[vertex];
}

std::optional<PathSet::Surface> PathSet::surface(Index vertex) const {
    if (!flag(vertex, VertexFlag::hasSurface)) return std::nullopt;
    return Surface{columns_.meshes[vertex], columns_.faces[vertex]};
}

std::optional<PathSet::Scattering> PathSet::scattering(Index vertex) const {
    if (!flag(vertex, VertexFlag::hasEvent)) return std::nullopt;
    return Scattering{static_cast<Event>(columns_.events[vertex]), static_cast<Lobe>(columns_.lobes[vertex]),
                      text(columns_.labels[vertex])};
}

IndexRange PathSet::nextEvents(Index vertex) const { return rangeOf(columns_.nextEventOwners, vertex); }
IndexRange PathSet::contributions(Index vertex) const { return rangeOf(columns_.contributionOwners, vertex); }

std::vector<const Column*> PathSet::find(Scope scope, std::string_view name) const {
    std::vector<const Column*> found;
    for (const Column& column : columns_.columns)
        if (column.scope == scope && column.name == name) found.push_back(&column);
    return found;
}

Value PathSet::value(const Column& column, Index i) const {
    const auto at = [&]<typename T>(T) { return column.values<T>()[i]; };
    switch (column.type) {
        case ValueType::boolean: return at(std::uint8_t{}) != 0;
        case ValueType::integer: return at(std::int64_t{});
        case ValueType::integer2: return at(Vec2i{});
        case ValueType::integer3: return at(Vec3i{});
        case ValueType::float1: return at(float{});
        case ValueType::float2: return at(Vec2f{});
        case ValueType::float3: return at(Vec3f{});
        case ValueType::double1: return at(double{});
        case ValueType::double2: return at(Vec2d{});
        case ValueType::double3: return at(Vec3d{});
        case ValueType::color: return at(Color{});
        case ValueType::colorA: return at(ColorA{});
        case ValueType::text: return std::string(text(at(std::uint32_t{})));
        case ValueType::spectrum: {
            const auto entries = column.values<float>();
            return std::vector<float>(entries.begin() + column.spectrumOffsets[i],
                                      entries.begin() + column.spectrumOffsets[i + 1]);
        }
    }
    return false;
}

std::optional<Value> PathSet::last(const Column& column, Index owner) const {
    const IndexRange range = column.valuesOf(owner);
    if (range.empty()) return std::nullopt;
    return value(column, range.last - 1);
}

std::optional<Index> PathSet::findPath(Pixel pixel, std::int64_t sample, std::int32_t part) const {
    Index low = 0, high = pathCount();
    const auto wanted = std::tie(pixel, sample, part);
    while (low < high) {
        const Index middle = low + (high - low) / 2;
        if (std::tie(columns_.pixels[middle], columns_.samples[middle], columns_.parts[middle]) < wanted)
            low = middle + 1;
        else
            high = middle;
    }
    if (low == pathCount() || std::tie(columns_.pixels[low], columns_.samples[low], columns_.parts[low]) != wanted)
        return std::nullopt;
    return low;
}

std::optional<Index> PathSet::findVertex(Index path, std::int32_t depth, Subpath subpath) const {
    const IndexRange range = vertices(path);
    for (Index v = range.first; v < range.last; ++v)
        if (columns_.depths[v] == depth && this->subpath(v) == subpath) return v;
    return std::nullopt;
}

}  // namespace emca
