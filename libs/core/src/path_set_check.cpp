// The rules of a PathSet, checked at one place: what passes here can be read without further checks.
#include <algorithm>
#include <cstdint>
#include <tuple>

#include "emca/core/path_set.h"

namespace emca {
namespace {

Error bad(const std::string& what) { return {ErrorCode::invalidArgument, "These recorded paths are damaged: " + what + "."}; }

template <typename T>
bool aligned(const SharedArray<T>& array) {
    return reinterpret_cast<std::uintptr_t>(array.data()) % alignof(T) == 0;
}

/// A column of its own length, or absent as a whole and not referred to by any flag.
template <typename T>
Result<void> checkColumn(const char* name, const SharedArray<T>& array, std::size_t size, bool needed) {
    if (!aligned(array)) return bad(std::string("column \"") + name + "\" is not aligned");
    if (array.size() == size || (array.empty() && !needed)) return {};
    return bad(std::string("column \"") + name + "\" has " + std::to_string(array.size()) + " entries instead of " +
               std::to_string(size));
}

Result<void> checkOwners(const std::string& name, const SharedArray<Index>& owners, std::size_t values, std::size_t limit) {
    if (!aligned(owners)) return bad("owners of \"" + name + "\" are not aligned");
    if (owners.size() != values)
        return bad("column \"" + name + "\" has " + std::to_string(values) + " values for " +
                   std::to_string(owners.size()) + " owners");
    Index previous = 0;
    for (const Index owner : owners) {
        if (owner < previous || owner >= limit) return bad("an owner of \"" + name + "\" is out of order or out of range");
        previous = owner;
    }
    return {};
}

Result<void> checkStrings(const std::string& name, std::span<const std::uint32_t> indices, std::size_t count, bool mayMiss) {
    // Without a way out of the loop, several are looked at together. kNoString + 1 is 0.
    const std::uint32_t shift = mayMiss ? 1 : 0;
    const std::size_t limit = count + shift;
    std::uint32_t most = 0;
    for (const std::uint32_t index : indices) most = std::max(most, index + shift);
    if (!indices.empty() && most >= limit) return bad("\"" + name + "\" refers to a string that is not there");
    return {};
}

/// Numbers that stand for one of `count` names, of every vertex, also where a flag says that there is none.
Result<void> checkNames(const char* name, const SharedArray<std::uint8_t>& numbers, std::uint8_t count) {
    std::uint8_t most = 0;
    for (const std::uint8_t number : numbers) most = std::max(most, number);
    if (most < count || numbers.empty()) return {};
    return bad(std::string("column \"") + name + "\" holds " + std::to_string(most) + ", but the last known one is " +
               std::to_string(count - 1));
}

Result<void> checkPaths(const PathColumns& c) {
    const std::size_t n = c.pixels.size(), m = c.depths.size();
    std::uint8_t used = 0;
    for (const std::uint8_t flags : c.pathFlags) used |= flags;
    for (const auto& result :
         {checkColumn("pixel", c.pixels, n, true), checkColumn("sample", c.samples, n, true),
          checkColumn("part", c.parts, n, true), checkColumn("path flags", c.pathFlags, n, true),
          checkColumn("origin", c.origins, n, used & PathFlag::hasOrigin),
          checkColumn("final estimate", c.estimates, n, used & PathFlag::hasEstimate),
          checkColumn("first vertex", c.firstVertex, n + 1, n > 0 || m > 0)})
        if (!result) return result.error();
    for (std::size_t i = 1; i < n; ++i)
        if (std::tie(c.pixels[i - 1], c.samples[i - 1], c.parts[i - 1]) >= std::tie(c.pixels[i], c.samples[i], c.parts[i]))
            return bad("paths are not ordered by pixel, sample and part");
    if (c.firstVertex.empty()) return {};
    if (c.firstVertex[0] != 0 || c.firstVertex[n] != m) return bad("the vertices do not belong to the paths");
    for (std::size_t i = 0; i < n; ++i)
        if (c.firstVertex[i] > c.firstVertex[i + 1]) return bad("the vertices of the paths overlap");
    return {};
}

Result<void> checkVertices(const PathColumns& c) {
    const std::size_t m = c.depths.size();
    std::uint8_t used = 0;
    for (const std::uint8_t flags : c.vertexFlags) used |= flags;
    const bool surface = used & VertexFlag::hasSurface, event = used & VertexFlag::hasEvent;
    for (const auto& result :
         {checkColumn("depth", c.depths, m, true), checkColumn("vertex flags", c.vertexFlags, m, true),
          checkColumn("position", c.positions, m, used & VertexFlag::hasPosition),
          checkColumn("estimate", c.vertexEstimates, m, used & VertexFlag::hasEstimate),
          checkColumn("emission", c.emissions, m, used & VertexFlag::hasEmission),
          checkColumn("mesh", c.meshes, m, surface), checkColumn("face", c.faces, m, surface),
          checkColumn("event", c.events, m, event), checkColumn("lobe", c.lobes, m, event),
          checkColumn("label", c.labels, m, event)})
        if (!result) return result.error();
    const auto key = [&](std::size_t v) { return std::tuple(c.vertexFlags[v] & VertexFlag::light, c.depths[v]); };
    for (std::size_t p = 0; p + 1 < c.firstVertex.size(); ++p)
        for (std::size_t v = c.firstVertex[p] + std::size_t(1); v < c.firstVertex[p + 1]; ++v)
            if (key(v - 1) >= key(v)) return bad("vertices of a path are not ordered by depth");
    if (auto r = checkNames("event", c.events, kEventCount); !r) return r;
    if (auto r = checkNames("lobe", c.lobes, kLobeCount); !r) return r;
    if (event)
        return checkStrings("label", c.labels.span(), c.strings.size(), true);
    return {};
}

Result<void> checkUserColumn(const PathColumns& c, const Column& column) {
    if (static_cast<std::size_t>(column.type) >= kValueTypeCount) return bad("column \"" + column.name + "\" has an unknown type");
    if (column.scope != Scope::path && column.scope != Scope::vertex) return bad("column \"" + column.name + "\" has an unknown scope");
    const std::size_t owners = column.scope == Scope::path ? c.pixels.size() : c.depths.size();
    if (column.dense()) {
        if (column.count != 0 && column.count != owners) return bad("column \"" + column.name + "\" is not dense, but has no owners");
    } else if (auto result = checkOwners(column.name, column.owners, column.count, owners); !result) {
        return result.error();
    }
    if (reinterpret_cast<std::uintptr_t>(column.bytes.data()) % 8 != 0 && !column.bytes.empty())
        return bad("column \"" + column.name + "\" is not aligned");
    if (column.type == ValueType::spectrum) {
        if (!aligned(column.spectrumOffsets) || column.spectrumOffsets.size() != std::size_t(column.count) + 1)
            return bad("spectra of \"" + column.name + "\" have no valid offsets");
        std::uint32_t previous = 0;
        for (const std::uint32_t offset : column.spectrumOffsets) {
            if (offset < previous) return bad("spectra of \"" + column.name + "\" overlap");
            previous = offset;
        }
        if (column.spectrumOffsets[0] != 0 || std::size_t(previous) * 4 != column.bytes.size())
            return bad("spectra of \"" + column.name + "\" do not fill their column");
    } else if (column.bytes.size() != std::size_t(column.count) * byteSize(column.type)) {
        return bad("column \"" + column.name + "\" has " + std::to_string(column.bytes.size()) + " bytes for " +
                   std::to_string(column.count) + " values of type " + name(column.type));
    }
    if (column.type == ValueType::text)
        if (auto result = checkStrings(column.name, column.values<std::uint32_t>(), c.strings.size(), false); !result) return result;
    if (!column.locations.empty()) {
        if (!aligned(column.locations) || column.locations.size() != column.count) return bad("source lines of \"" + column.name + "\" do not match its values");
        return checkStrings(column.name, column.locations.span(), c.strings.size(), true);
    }
    return {};
}

Result<void> checkSparse(const PathColumns& c) {
    const std::size_t n = c.pixels.size(), m = c.depths.size();
    if (!aligned(c.nextEvents) || !aligned(c.contributions) || !aligned(c.splats)) return bad("a sparse column is not aligned");
    if (auto r = checkOwners("nee", c.nextEventOwners, c.nextEvents.size(), m); !r) return r;
    if (auto r = checkOwners("contribution", c.contributionOwners, c.contributions.size(), m); !r) return r;
    if (auto r = checkOwners("splat", c.splatOwners, c.splats.size(), n); !r) return r;
    for (const Contribution& contribution : c.contributions) {
        if (contribution.technique >= c.strings.size()) return bad("a contribution names a technique that is not there");
        if (static_cast<std::uint8_t>(contribution.end) >= kLightEndCount) return bad("a contribution met its light in an unknown way");
    }
    return {};
}

}  // namespace

Result<PathSet> PathSet::make(PathColumns columns) {
    constexpr std::size_t kMost = 0x7fffffff;
    if (columns.pixels.size() > kMost || columns.depths.size() > kMost) return bad("there are more than 2^31 paths or vertices");
    if (auto r = checkPaths(columns); !r) return r.error();
    if (auto r = checkVertices(columns); !r) return r.error();
    if (auto r = checkSparse(columns); !r) return r.error();
    const Column* previous = nullptr;
    for (const Column& column : columns.columns) {
        if (auto r = checkUserColumn(columns, column); !r) return r.error();
        if (previous && std::tie(previous->scope, previous->name, previous->type) >= std::tie(column.scope, column.name, column.type))
            return bad("user columns are not ordered by scope, name and type");
        previous = &column;
    }
    PathSet set;
    set.columns_ = std::move(columns);
    return set;
}

}  // namespace emca
