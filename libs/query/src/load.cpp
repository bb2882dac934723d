// From recorded columns to values of a chunk.
#include <algorithm>

#include "check.h"
#include "evaluator.h"

namespace emca::query::detail {

namespace {

Values numbersOf(std::size_t size, Type type = Type::number, int components = 1) {
    Values values;
    values.type = type;
    values.components = components;
    values.size = size;
    for (int c = 0; c < components; ++c) values.numbers[static_cast<std::size_t>(c)] = Buffer<double>(size);
    return values;
}

/// `number(i)` for each i in `range`, counted from its begin.
template <typename Number>
Values each(IndexRange range, Number number) {
    Values values = numbersOf(range.size());
    double* out = values.numbers[0].data();
    for (Index i = range.first; i < range.last; ++i) out[i - range.first] = static_cast<double>(number(i));
    return values;
}

template <typename Truths>
Values eachTruth(IndexRange range, Truths truths) {
    Values values;
    values.type = Type::boolean;
    values.size = range.size();
    values.truth = Buffer<std::uint8_t>(values.size);
    for (Index i = range.first; i < range.last; ++i) values.truth[i - range.first] = truths(i) ? kTrue : kFalse;
    return values;
}

void setKnown(Values& values, const SharedArray<std::uint8_t>& flags, IndexRange range, std::uint8_t bit) {
    values.known = Buffer<std::uint8_t>(range.size());
    for (Index i = range.first; i < range.last; ++i) values.known[i - range.first] = (flags[i] & bit) != 0;
}

Values unknown(std::size_t size, Type type, int components) {
    Values values = type == Type::number || type == Type::color || type == Type::vector ? numbersOf(size, type, components) : Values{};
    values.type = type;
    values.size = size;
    if (type == Type::boolean) values.truth = Buffer<std::uint8_t>(size, kUnknown);
    else values.known = Buffer<std::uint8_t>(size, std::uint8_t{0});
    if (type == Type::text) values.texts = Buffer<std::uint32_t>(size, Texts::kNone);
    for (auto& numbers : values.numbers) std::fill_n(numbers.data(), numbers.size(), 0.0);
    return values;
}

void put(Values& values, std::size_t at, Color c) {
    values.numbers[0][at] = static_cast<double>(c.r);
    values.numbers[1][at] = static_cast<double>(c.g);
    values.numbers[2][at] = static_cast<double>(c.b);
}
void put(Values& values, std::size_t at, Vec3f p) { put(values, at, Color(p.x, p.y, p.z)); }

/// `value(i)`, a colour or a vector, for each i in `range`.
template <typename Value>
Values eachTriple(Type type, IndexRange range, Value value) {
    Values values = numbersOf(range.size(), type, 3);
    for (Index i = range.first; i < range.last; ++i) put(values, i - range.first, value(i));
    return values;
}

template <typename T>
Values triples(Type type, const SharedArray<T>& column, const SharedArray<std::uint8_t>& flags, IndexRange range, std::uint8_t bit) {
    if (column.empty()) return unknown(range.size(), type, 3);
    Values values = eachTriple(type, range, [&](Index i) { return column[i]; });
    setKnown(values, flags, range, bit);
    return values;
}

Values colors(const SharedArray<Color>& column, const SharedArray<std::uint8_t>& flags, IndexRange range, std::uint8_t bit) {
    return triples(Type::color, column, flags, range, bit);
}
Values points(const SharedArray<Vec3f>& column, const SharedArray<std::uint8_t>& flags, IndexRange range, std::uint8_t bit) {
    return triples(Type::vector, column, flags, range, bit);
}

Values luminances(const SharedArray<Color>& column, const SharedArray<std::uint8_t>& flags, IndexRange range, std::uint8_t bit) {
    if (column.empty()) return unknown(range.size(), Type::number, 1);
    Values values = each(range, [&](Index i) { return luminance(column[i]); });
    setKnown(values, flags, range, bit);
    return values;
}

Values surfaceNumbers(const SharedArray<std::int32_t>& column, const SharedArray<std::uint8_t>& flags, IndexRange range) {
    if (column.empty()) return unknown(range.size(), Type::number, 1);
    Values values = each(range, [&](Index i) { return column[i]; });
    setKnown(values, flags, range, VertexFlag::hasSurface);
    return values;
}

Values depths(const PathSet& paths, IndexRange range) {
    const PathColumns& c = paths.columns();
    Values values = numbersOf(range.size());
    for (Index p = range.first; p < range.last; ++p) {
        std::int32_t deepest = 0;
        for (Index v = c.firstVertex[p]; v < c.firstVertex[p + 1]; ++v)
            if ((c.vertexFlags[v] & VertexFlag::hasPosition) != 0) deepest = std::max(deepest, c.depths[v]);
        values.numbers[0][p - range.first] = deepest;
    }
    return values;
}

/// Lengths of the segments that lead to vertices.
Values segments(const PathSet& paths, IndexRange vertices) {
    Values values = unknown(vertices.size(), Type::number, 1);
    const PathColumns& c = paths.columns();
    if (c.positions.empty() || vertices.empty()) return values;
    const auto hasPosition = [&](Index v) { return (c.vertexFlags[v] & VertexFlag::hasPosition) != 0; };
    Index path = paths.pathOf(vertices.first);
    for (Index v = vertices.first; v < vertices.last; ++v) {
        while (c.firstVertex[path + 1] <= v) ++path;
        if (v == c.firstVertex[path] || paths.subpath(v) != paths.subpath(v - 1) || !hasPosition(v) || !hasPosition(v - 1)) continue;
        const Vec3f a = c.positions[v - 1], b = c.positions[v];
        values.numbers[0][v - vertices.first] = length(Vec3d{b.x, b.y, b.z} - Vec3d{a.x, a.y, a.z});
        values.known[v - vertices.first] = 1;
    }
    return values;
}

/// How many values each of some owners has.
Values countsOf(const std::vector<Index>& firsts) {
    return each({0, static_cast<Index>(firsts.size() - 1)}, [&](Index i) { return firsts[i + 1] - firsts[i]; });
}

/// Copies values of one user column to their owners; of several of one owner the last one stays.
class Filler {
  public:
    Filler(Values& values, const Column& column, IndexRange owners) : values_(values), column_(column), owners_(owners) {}

    template <typename T>
    void numbers(int stored, int wanted) {
        const T* from = reinterpret_cast<const T*>(column_.bytes.data());
        each([&](std::size_t to, Index i) {
            for (int c = 0; c < std::min(stored, wanted); ++c) {
                values_.numbers[static_cast<std::size_t>(c)][to] = static_cast<double>(from[std::size_t(i) * std::size_t(stored) + std::size_t(c)]);
            }
            values_.known[to] = 1;
        });
    }
    void truths() {
        each([&](std::size_t to, Index i) { values_.truth[to] = column_.values<std::uint8_t>()[i] != 0 ? kTrue : kFalse; });
    }
    void texts(const Texts& texts) {
        each([&](std::size_t to, Index i) {
            values_.texts[to] = texts.ofString(column_.values<std::uint32_t>()[i]);
            values_.known[to] = values_.texts[to] != Texts::kNone;
        });
    }
    void places() {
        values_.spectra = &column_;
        each([&](std::size_t to, Index i) {
            values_.texts[to] = i;
            values_.known[to] = 1;
        });
    }

  private:
    template <typename Copy>
    void each(Copy copy) {
        if (column_.dense()) {
            for (Index owner = owners_.first; owner < owners_.last && owner < column_.count; ++owner) copy(owner - owners_.first, owner);
            return;
        }
        const auto begin = std::lower_bound(column_.owners.begin(), column_.owners.end(), owners_.first) - column_.owners.begin();
        for (auto i = static_cast<Index>(begin); i < column_.count && column_.owners[i] < owners_.last; ++i) copy(column_.owners[i] - owners_.first, i);
    }

    Values& values_;
    const Column& column_;
    IndexRange owners_;
};

void fill(Values& values, const Column& column, IndexRange owners, Texts* texts) {
    Filler filler(values, column, owners);
    const int wanted = values.components;
    switch (column.type) {
        case ValueType::boolean: return filler.truths();
        case ValueType::integer: case ValueType::integer2: case ValueType::integer3:
            return filler.numbers<std::int64_t>(componentCount(column.type), wanted);
        case ValueType::float1: case ValueType::float2: case ValueType::float3: case ValueType::color: case ValueType::colorA:
            return filler.numbers<float>(componentCount(column.type), wanted);
        case ValueType::double1: case ValueType::double2: case ValueType::double3:
            return filler.numbers<double>(componentCount(column.type), wanted);
        case ValueType::text: return filler.texts(*texts);
        case ValueType::spectrum: return filler.places();
    }
}

}  // namespace

std::vector<const Column*> columnsOfType(const PathSet& paths, const Node& node) {
    std::vector<const Column*> columns = paths.find(node.scope == Domain::path ? Scope::path : Scope::vertex, node.text);
    std::erase_if(columns, [&](const Column* column) {
        const UserType type = userTypeOf(column->type);
        return column->count == 0 || type.type != node.type || type.components != node.components;
    });
    return columns;
}

Values Evaluator::user(const Node& node, Chunk& chunk) {
    const IndexRange owners = chunk.range(node.scope);
    Values values = unknown(owners.size(), node.type, node.components);
    if (node.type == Type::spectrum) values.texts = Buffer<std::uint32_t>(values.size, 0u);
    const auto [it, isNew] = columns_.try_emplace(&node);
    if (isNew) it->second = columnsOfType(paths_, node);
    for (const Column* column : it->second) fill(values, *column, owners, node.type == Type::text ? &allTexts() : nullptr);
    return values;
}

Values Evaluator::core(const Node& node, Chunk& chunk) {
    const PathColumns& c = paths_.columns();
    const IndexRange range = chunk.range(node.scope), vertices = chunk.range(Domain::vertex);
    switch (node.core) {
        case Core::pixel: {
            Values values = numbersOf(range.size(), Type::vector, 2);
            for (Index i = range.first; i < range.last; ++i) {
                values.numbers[0][i - range.first] = c.pixels[i].x;
                values.numbers[1][i - range.first] = c.pixels[i].y;
            }
            return values;
        }
        case Core::sample: return each(range, [&](Index i) { return c.samples[i]; });
        case Core::part: return each(range, [&](Index i) { return c.parts[i]; });
        case Core::origin: return points(c.origins, c.pathFlags, range, PathFlag::hasOrigin);
        case Core::estimate: return colors(c.estimates, c.pathFlags, range, PathFlag::hasEstimate);
        case Core::luminance: return luminances(c.estimates, c.pathFlags, range, PathFlag::hasEstimate);
        case Core::depth: return depths(paths_, range);
        case Core::vertices: return countsOf(chunk.firstOf(Domain::path, Domain::vertex));
        case Core::contributions: return countsOf(chunk.firstOf(Domain::path, Domain::contribution));
        case Core::splats: return each(range, [&](Index i) { return paths_.splats(i).size(); });
        case Core::vertexDepth: return each(range, [&](Index i) { return c.depths[i]; });
        case Core::vertexIndex: {
            const auto& owners = chunk.ownersOf(Domain::vertex, Domain::path);
            const auto& firsts = chunk.firstOf(Domain::path, Domain::vertex);
            return each({0, range.size()}, [&](Index i) { return i - firsts[owners[i]]; });
        }
        case Core::position: return points(c.positions, c.vertexFlags, range, VertexFlag::hasPosition);
        case Core::segment: return segments(paths_, range);
        case Core::vertexEstimate: return colors(c.vertexEstimates, c.vertexFlags, range, VertexFlag::hasEstimate);
        case Core::vertexLuminance: return luminances(c.vertexEstimates, c.vertexFlags, range, VertexFlag::hasEstimate);
        case Core::emission: return colors(c.emissions, c.vertexFlags, range, VertexFlag::hasEmission);
        case Core::mesh: return surfaceNumbers(c.meshes, c.vertexFlags, range);
        case Core::face: return surfaceNumbers(c.faces, c.vertexFlags, range);
        case Core::environment: return eachTruth(range, [&](Index i) { return paths_.isEnvironment(i); });
        case Core::isLast: {
            const auto& owners = chunk.ownersOf(Domain::vertex, Domain::path);
            const auto& firsts = chunk.firstOf(Domain::path, Domain::vertex);
            return eachTruth({0, range.size()}, [&](Index i) { return i + 1 == firsts[owners[i] + 1]; });
        }
        case Core::value: return eachTriple(Type::color, range, [&](Index i) { return c.contributions[i].value; });
        case Core::valueLuminance: return each(range, [&](Index i) { return luminance(c.contributions[i].value); });
        case Core::weight: {
            Values values = each(range, [&](Index i) { return c.contributions[i].misWeight; });
            values.known = Buffer<std::uint8_t>(range.size());  // NaN is how a recording says that there is none
            for (std::size_t i = 0; i < values.size; ++i) values.known[i] = values.numbers[0][i] == values.numbers[0][i];
            return values;
        }
        case Core::contributionDepth: case Core::nextEventDepth: {
            const auto& owners = chunk.ownersOf(node.scope, Domain::vertex);
            return each({0, range.size()}, [&](Index i) { return c.depths[vertices.first + owners[i]]; });
        }
        case Core::nextEventPosition: return eachTriple(Type::vector, range, [&](Index i) { return c.nextEvents[i].position; });
        case Core::visible: return eachTruth(range, [&](Index i) { return c.nextEvents[i].visible != 0; });
        case Core::event: case Core::lobe: case Core::label: case Core::subpath: case Core::technique: case Core::end: break;
    }
    return coreTexts(node, chunk);
}

Values Evaluator::coreTexts(const Node& node, Chunk& chunk) {
    const PathColumns& c = paths_.columns();
    const IndexRange range = chunk.range(node.scope);
    Values values = unknown(range.size(), Type::text, 0);
    Texts& texts = allTexts();
    const auto put = [&](Index i, std::uint32_t text) {
        values.texts[i - range.first] = text;
        values.known[i - range.first] = text != Texts::kNone;
    };
    const bool ofEvent = node.core == Core::event || node.core == Core::lobe || node.core == Core::label;
    if (ofEvent && c.events.empty()) return values;
    std::array<std::uint32_t, kEventCount> names{};
    for (std::uint8_t i = 0; i < kEventCount; ++i) {
        if (node.core == Core::event) names[i] = texts.add(name(static_cast<Event>(i)));
        if (node.core == Core::lobe && i < kLobeCount) names[i] = texts.add(name(static_cast<Lobe>(i)));
        if (node.core == Core::subpath && i < 2) names[i] = texts.add(name(static_cast<Subpath>(i)));
        if (node.core == Core::end && i < kLightEndCount) names[i] = texts.add(name(static_cast<LightEnd>(i)));
    }
    for (Index i = range.first; i < range.last; ++i) {
        if (ofEvent && (c.vertexFlags[i] & VertexFlag::hasEvent) == 0) continue;
        switch (node.core) {
            case Core::event: put(i, names[c.events[i]]); break;
            case Core::lobe: put(i, names[c.lobes.empty() ? 0 : c.lobes[i]]); break;
            case Core::label: if (!c.labels.empty()) put(i, texts.ofString(c.labels[i])); break;
            case Core::subpath: put(i, names[static_cast<std::size_t>(paths_.subpath(i))]); break;
            case Core::end: put(i, names[static_cast<std::size_t>(c.contributions[i].end)]); break;
            default: put(i, texts.ofString(c.contributions[i].technique)); break;
        }
    }
    return values;
}

}  // namespace emca::query::detail
