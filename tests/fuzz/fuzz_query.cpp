// Fuzzer for the query language: any text, parsed and evaluated on a few paths that have every kind of column, as a query
// and as a table, within limits.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "emca/query/query.h"
#include "emca/query/table.h"
#include "emca/recorder/handles.h"

namespace {

using namespace emca;

void addAll(const auto& to, int i) {
    const auto x = static_cast<float>(i);
    to.add("f", x / 4).add("d", i / 3.0).add("b", i % 2 == 0).add("t", i % 2 ? "glass" : "wood").add("s", std::vector<float>(static_cast<std::size_t>(i % 3), x));
    if (i % 3 != 0) to.add("i", std::int64_t{i}).add("v2", Vec2f{x, 1}).add("v3", Vec3f{x, 1, 2}).add("rgb", Color(x)).add("rgba", ColorA{x, 1, 2, 1});
    if (i % 4 == 0) to.add("two", x).add("two", "text").add("two", x + 1);
}

PathSet makePaths() {
    Recording recording;
    for (int p = 0; p < 12; ++p) {
        const PathHandle path = recording.path({static_cast<std::uint32_t>(p / 5), 0}, p);
        path.origin(Vec3f{});
        if (p % 4 == 3) continue;
        path.finalEstimate(Color(static_cast<float>(p))).splat({1, 1}, Color(1));
        addAll(path, p);
        for (int d = 0; d < p % 5; ++d) {
            const VertexHandle v = path.vertex(d, p == 6 ? Subpath::light : Subpath::camera);
            v.position(Vec3f{static_cast<float>(d), 0, 1}).estimate(Color(1)).emission(Color(static_cast<float>(d % 2))).surface(d, p);
            v.event(static_cast<Event>((p + d) % kEventCount), static_cast<Lobe>(d % kLobeCount), d % 2 ? "glass" : "");
            v.nextEvent(Vec3f{}, d % 2 == 0).contribution(Color(1), "light sampling", 0.5f).contribution(Color(2), "BSDF sampling", 1.f, LightEnd::hit);
            addAll(v, p + d);
        }
        if (p % 4 == 1) path.vertex(9).environment(Vec3f{});
    }
    return *recording.finish();
}

bool pointsInto(query::SourceRange where, std::string_view text) {
    // One past the end is where something is missing.
    return where.begin <= where.end && where.begin <= text.size() && where.end <= text.size() + 1 && !query::pointAt(text, where).empty();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const PathSet paths = makePaths();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    query::EvaluationLimits limits;
    limits.temporaryBytes = 16u << 20;
    query::QueryError where;
    if (const auto query = query::Query::parse(text, &where)) {
        const auto selected = query->select(paths, limits, &where);
        const auto values = query->evaluate(paths, limits, &where);
        if (selected && !values) std::abort();
        if (values && values->known.size() != paths.pathCount()) std::abort();
        if (query->columns().empty()) std::abort();
    } else if (!pointsInto(where.where, text)) {
        std::abort();
    }
    if (const auto table = query::Table::parse(text, &where)) {
        const auto rows = table->evaluate(paths, limits, &where);
        for (std::size_t i = 0; rows && i < rows->columns.size(); ++i)
            if (rows->columns[i].values.known.size() != rows->rowCount) std::abort();
    } else if (!pointsInto(where.where, text)) {
        std::abort();
    }
    return 0;
}
