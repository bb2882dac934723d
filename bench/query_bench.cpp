// The query language: a million paths of eight vertices, one core. Rows of docs/performance.md, section Queries.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "emca/core/path_set.h"
#include "emca/query/query.h"

namespace {

using namespace emca;

constexpr Index kPaths = 1'000'000, kVertices = 8;

Column column(std::string name, std::vector<float> values, std::vector<Index> owners = {}) {
    Column out;
    out.name = std::move(name);
    out.count = static_cast<Index>(values.size());
    std::vector<std::byte> bytes(values.size() * sizeof(float));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    out.bytes = SharedArray<std::byte>(std::move(bytes));
    out.owners = SharedArray<Index>(std::move(owners));
    return out;
}

/// What a path tracer records: values as they come, one contribution at every second vertex, hits at the ends.
PathSet makePaths() {
    const Index m = kPaths * kVertices;
    std::mt19937 random(1);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    PathColumns c;
    std::vector<Pixel> pixels(kPaths);
    std::vector<std::int64_t> samples(kPaths);
    std::vector<Color> estimates(kPaths);
    std::vector<Index> first(kPaths + 1);
    for (Index p = 0; p < kPaths; ++p) {
        pixels[p] = {p / 1000 % 100, p / 100'000};
        samples[p] = p % 1000;
        estimates[p] = Color(unit() * 2);
        first[p + 1] = (p + 1) * kVertices;
    }
    std::vector<std::int32_t> depths(m);
    std::vector<std::uint8_t> flags(m, VertexFlag::hasPosition | VertexFlag::hasEvent | VertexFlag::hasSurface), events(m), lobes(m);
    std::vector<Vec3f> positions(m);
    std::vector<std::int32_t> meshes(m), faces(m);
    std::vector<float> pdf(m), roughness(m), sparsePdf, sparseRoughness;
    std::vector<Index> pdfOwners, roughnessOwners, contributionOwners;
    std::vector<Contribution> contributions;
    for (Index v = 0; v < m; ++v) {
        depths[v] = static_cast<std::int32_t>(v % kVertices) + 1;
        positions[v] = {unit(), unit(), unit()};
        meshes[v] = static_cast<std::int32_t>(random() % 20);
        faces[v] = static_cast<std::int32_t>(random() % 1000);
        const bool end = depths[v] == kVertices;
        events[v] = static_cast<std::uint8_t>(end ? Event::absorb : random() % 5 == 0 ? Event::transmit : Event::reflect);
        lobes[v] = static_cast<std::uint8_t>(end ? 0 : 1 + random() % 3);
        pdf[v] = unit() * 10;
        roughness[v] = random() % 4 == 0 ? 0.f : unit();
        if (random() % 4 != 0) { sparsePdf.push_back(pdf[v]); pdfOwners.push_back(v); }
        if (random() % 4 != 0) { sparseRoughness.push_back(roughness[v]); roughnessOwners.push_back(v); }
        if (!end && v % 2 == 0) { contributionOwners.push_back(v); contributions.push_back({Color(unit()), unit(), 0, LightEnd::connected, {}}); }
    }
    c.pixels = std::move(pixels);
    c.samples = std::move(samples);
    c.parts = std::vector<std::int32_t>(kPaths);
    c.pathFlags = std::vector<std::uint8_t>(kPaths, PathFlag::hasEstimate);
    c.estimates = std::move(estimates);
    c.firstVertex = std::move(first);
    c.depths = std::move(depths);
    c.vertexFlags = std::move(flags);
    c.positions = std::move(positions);
    c.meshes = std::move(meshes);
    c.faces = std::move(faces);
    c.events = std::move(events);
    c.lobes = std::move(lobes);
    c.labels = std::vector<std::uint32_t>(m, kNoString);
    c.contributionOwners = std::move(contributionOwners);
    c.contributions = std::move(contributions);
    c.strings = {"light sampling"};
    c.columns.push_back(column("pdf", std::move(pdf)));
    c.columns.push_back(column("roughness", std::move(roughness)));
    c.columns.push_back(column("sparse pdf", std::move(sparsePdf), std::move(pdfOwners)));
    c.columns.push_back(column("sparse roughness", std::move(sparseRoughness), std::move(roughnessOwners)));
    for (Column& user : c.columns) user.scope = Scope::vertex;
    auto paths = PathSet::make(std::move(c));
    if (!paths) std::fprintf(stderr, "%s\n", paths.error().message.c_str());
    return paths ? *paths : PathSet();
}

void select(benchmark::State& state, const char* text) {
    static const PathSet paths = makePaths();
    const auto query = query::Query::parse(text);
    if (!query || paths.empty()) return state.SkipWithError("no query, or no paths");
    std::size_t found = 0;
    for (auto _ : state) {
        const auto matches = query->select(paths);
        if (!matches) return state.SkipWithError(matches.error().message.c_str());
        benchmark::DoNotOptimize(found = matches->paths.size());
    }
    state.counters["found"] = static_cast<double>(found);
}

}  // namespace

BENCHMARK_CAPTURE(select, two_quantifiers_dense, "any(v.pdf < 1e-4) and none(v.roughness == 0 and v.depth > 2)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, two_quantifiers_sparse, "any(v.`sparse pdf` < 1e-4) and none(v.`sparse roughness` == 0 and v.depth > 2)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, two_quantifiers_both_decide, "any(v.pdf < 1) and none(v.roughness == 0 and v.depth > 2)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, core_quantities, "luminance > 1.9 and any(v.mesh == 3 and v.depth > 2) and none(v.lobe == 'glossy')")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, light_path, "lpe('C<RD>.*L')")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, contributions, "any(c.weight < 0.01 and c.luminance > 0.9)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, brighter_than_the_pixel, "luminance > 1.9 * mean(luminance)")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, arithmetic, "max(length(v.position) * 2 - v.depth) > 1.7")->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
