// What finish() makes of the samples: unbiased, flat where they are uniform, whole where they are missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "surface_for_tests.h"

namespace emca {
namespace {

using namespace test;

/// A square divided again and again at random places: triangles of wildly different size.
Mesh randomTriangles(unsigned seed, std::size_t count) {
    Mesh mesh = grid(1);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0.15f, 0.85f);
    while (mesh.triangles.size() < count) {
        const std::size_t i = random() % mesh.triangles.size();
        const Triangle t = mesh.triangles[i];
        float u = uniform(random), v = uniform(random);
        if (u + v > 0.9f) u *= 0.5f, v *= 0.5f;
        const auto m = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(mesh.positions[t[0]] * (1 - u - v) + mesh.positions[t[1]] * u + mesh.positions[t[2]] * v);
        mesh.triangles[i] = {t[0], t[1], m};
        mesh.triangles.push_back({t[1], t[2], m});
        mesh.triangles.push_back({t[2], t[0], m});
    }
    return mesh;
}

SurfaceField collect(const std::vector<Mesh>& meshes, int samples, unsigned seed, SurfaceOptions options,
                     const std::function<float(Vec3f)>& value) {
    Collection c(meshes, options);
    c.record(samples, seed, value);
    return c.recorder.finish();
}

/// A fine mesh with its refined faces.
struct Refined {
    RefinedMesh mesh;
    std::vector<double> areas;
    Refined(const Mesh& base, const SurfaceField& field) : mesh(*refine(base, field.meshes[0].subdivision)) {
        for (const Triangle& t : mesh.triangles) areas.push_back(area(mesh.positions, t));
    }
};

TEST(SurfaceFinish, MeanOfAKnownFunctionConvergesAtTheMonteCarloRate) {
    const std::vector<Mesh> meshes = {grid(1)};
    const auto error = [&](int samples) {  // root mean square over runs, of the mean over the surface of x
        double sum = 0;
        const int runs = 60;
        for (int run = 0; run < runs; ++run) {
            const SurfaceField field = collect(meshes, samples, unsigned(1000 + run), {.maximumLevel = 0},
                                               [](Vec3f p) { return p.x; });
            const double mean = 0.5 * double(field.layers[1].values[0] + field.layers[1].values[1]);
            sum += (mean - 0.5) * (mean - 0.5);
        }
        return std::sqrt(sum / runs);
    };
    // Two triangles, half of the samples each, variance of x on either 1/18: their mean has variance 1 / (18 n).
    const double expected = std::sqrt(1.0 / 18);
    for (const int n : {400, 6400, 25600}) EXPECT_NEAR(error(n) * std::sqrt(double(n)) / expected, 1.0, 0.25) << n;
}

TEST(SurfaceFinish, SubdivisionDoesNotBiasTheMeanOverTheSurface) {
    const std::vector<Mesh> meshes = {grid(1)};
    for (const int samples : {2000, 50000, 1000000}) {
        const SurfaceField field =
            collect(meshes, samples, 5, {.minimumEdge = 0}, [](Vec3f p) { return p.x * p.x + p.y; });
        const Refined refined(meshes[0], field);
        double mean = 0;
        for (std::size_t i = 0; i < refined.areas.size(); ++i) mean += refined.areas[i] * double(field.layers[1].values[i]);
        EXPECT_NEAR(mean, 1.0 / 3 + 0.5, 4 * 0.42 / std::sqrt(samples)) << samples;
    }
}

TEST(SurfaceFinish, MoreSamplesShowMoreDetail) {
    const std::vector<Mesh> meshes = {grid(1)};
    double last = 1;
    for (const int samples : {2000, 30000, 450000}) {
        const SurfaceField field = collect(meshes, samples, 5, {.minimumEdge = 0}, [](Vec3f p) { return p.x; });
        const Refined refined(meshes[0], field);
        double error = 0;
        for (std::size_t i = 0; i < refined.areas.size(); ++i) {
            const Triangle t = refined.mesh.triangles[i];
            float x = 0;
            for (const std::uint32_t v : t) x += refined.mesh.positions[v].x / 3;
            error += refined.areas[i] * std::pow(double(field.layers[1].values[i] - x), 2);
        }
        error = std::sqrt(error);
        EXPECT_LT(error, 0.45 * last) << samples;
        last = error;
    }
}

TEST(SurfaceFinish, UniformDensityIsFlatOnTrianglesOfAllSizes) {
    const std::vector<Mesh> meshes = {randomTriangles(3, 3000)};
    const int samples = 300000;
    const SurfaceField field = collect(meshes, samples, 8, {.samplesPerDivision = 64}, [](Vec3f) { return 1.f; });
    const Refined refined(meshes[0], field);
    // Samples of the base faces against their areas.
    std::vector<double> observed(3000 + 2, 0), expected(observed.size(), 0);
    for (std::size_t i = 0; i < refined.areas.size(); ++i) {
        observed[refined.mesh.baseFace[i]] += double(field.points[i]);
        expected[refined.mesh.baseFace[i]] += refined.areas[i] * samples;
    }
    double chi = 0, pooledObserved = 0, pooledExpected = 0;
    int cells = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        pooledObserved += observed[i];
        pooledExpected += expected[i];
        if (pooledExpected < 10) continue;
        chi += std::pow(pooledObserved - pooledExpected, 2) / pooledExpected;
        pooledObserved = pooledExpected = 0;
        ++cells;
    }
    EXPECT_GT(cells, 1000);
    EXPECT_NEAR(chi, cells, 4.5 * std::sqrt(2.0 * cells));
    // The map itself: nowhere far from the truth, although most triangles expect no sample at all.
    const auto& density = field.layers[0].values;
    EXPECT_NEAR(integral(field, field.layers[0], meshes), samples, 1e-4 * samples);
    double highest = 0, raw = 0, deviation = 0;
    for (std::size_t i = 0; i < refined.areas.size(); ++i) {
        if (!(refined.areas[i] > 0)) continue;
        raw = std::max(raw, double(field.points[i]) / (samples * refined.areas[i]));
        highest = std::max(highest, double(density[i]) / samples);
        deviation += refined.areas[i] * std::pow(double(density[i]) / samples - 1, 2);
    }
    EXPECT_GT(raw, 100);  // a single sample on a sliver, were it shown as it came
    EXPECT_LT(highest, 30);
    EXPECT_LT(std::sqrt(deviation), 0.4);
}

/// Mean density, relative to the truth, and number of refined faces by level below the base face.
std::map<int, std::pair<double, double>> byLevel(const Mesh& base, const SurfaceField& field, double truth) {
    const Refined refined(base, field);
    std::map<int, std::pair<double, double>> levels;
    for (std::size_t i = 0; i < refined.areas.size(); ++i) {
        const double whole = area(base.positions, base.triangles[refined.mesh.baseFace[i]]);
        auto& [sum, count] = levels[int(std::lround(std::log2(whole / refined.areas[i]) / 2))];
        sum += double(field.layers[0].values[i]) / truth;
        ++count;
    }
    for (auto& [level, entry] : levels) entry.first /= entry.second;
    return levels;
}

TEST(SurfaceFinish, NoStepsBetweenLevels) {
    const std::vector<Mesh> meshes = {grid(1)};
    // Numbers of samples at which some faces have just divided and others have not.
    for (const int samples : {30000, 60000, 90000, 150000, 300000, 500000}) {
        const SurfaceField field = collect(meshes, samples, 77, {.minimumEdge = 0}, [](Vec3f) { return 1.f; });
        const auto levels = byLevel(meshes[0], field, samples);
        for (const auto& [level, entry] : levels) {
            const auto [mean, count] = entry;
            // One face holds about 100 to 350 samples: 6 to 10 % of noise, and which faces divide is chosen by it.
            if (count < 16) continue;
            EXPECT_NEAR(mean, 1.0, 0.10) << "level " << level << " of " << samples << " samples";
        }
        double deviation = 0;
        for (const float v : field.layers[0].values) deviation += std::pow(double(v) / samples - 1, 2);
        EXPECT_LT(std::sqrt(deviation / double(field.layers[0].values.size())), 0.16) << samples;
    }
}

/// As an image is rendered tile by tile: what a face had before it was divided must not have come from one corner of it.
TEST(SurfaceFinish, APassMayVisitTheSurfaceInAnyOrder) {
    const std::vector<Mesh> meshes = {grid(1)};
    const int samples = 320000, parts = 32;
    double deviation[2];
    for (const bool told : {false, true}) {
        SurfaceRecorder recorder(meshes, {.samplesPerDivision = 256, .minimumEdge = 0});
        const SurfaceLayer density = *recorder.addLayer({"density", LayerKind::density, "", ""});
        UniformPoints points(meshes[0], 31);
        for (int first = 0, last = 1; first < parts; first = std::exchange(last, 4 * last < parts ? 2 * last : parts)) {
            std::vector<UniformPoint> pass;
            for (int i = 0; i < (last - first) * (samples / parts); ++i) pass.push_back(points.next());
            std::sort(pass.begin(), pass.end(), [&](const UniformPoint& a, const UniformPoint& b) {
                return position(meshes[0], a.face, a.uv).x < position(meshes[0], b.face, b.uv).x;
            });
            for (const UniformPoint& p : pass) density.add(recorder.cursor().locate(0, p.face, p.uv));
            if (told && last < parts) recorder.passDone(double(last) / parts);
        }
        const SurfaceField field = recorder.finish();
        EXPECT_EQ(field.layers[0].samples, std::uint64_t(samples));
        EXPECT_NEAR(integral(field, field.layers[0], meshes), samples, 1e-4 * samples);
        EXPECT_GT(field.faceCount(), 1000u);
        double squares = 0;
        for (const float v : field.layers[0].values) squares += std::pow(double(v) / samples - 1, 2);
        deviation[told] = std::sqrt(squares / double(field.faceCount()));
    }
    EXPECT_LT(deviation[1], 0.13);  // a face holds 80 to 340 samples
    EXPECT_GT(deviation[0], 2 * deviation[1]);
}

/// Points crowd around a corner, so that levels differ by much. A layer that begins after a pass has nothing from above: the
/// mean of a coordinate lies within the triangle that it is of.
void expectPointsInTheirTriangles(int pointsInAPass, std::size_t budget, std::size_t fewestTriangles) {
    SCOPED_TRACE(pointsInAPass);
    const std::vector<Mesh> meshes = {grid(1)};
    SurfaceRecorder recorder(meshes, {.budgetBytes = budget, .samplesPerDivision = 16, .minimumEdge = 0});
    const SurfaceLayer density = *recorder.addLayer({"density", LayerKind::density, "", ""});
    const SurfaceLayer across = *recorder.addLayer({"x", LayerKind::mean, "", ""});
    UniformPoints points(meshes[0], 8);
    const auto record = [&](int count, bool late) {
        for (int i = 0; i < count; ++i) {
            UniformPoint p = points.next();
            p.uv = p.uv * (p.uv.x + p.uv.y);
            const SurfacePoint at = recorder.cursor().locate(0, p.face, p.uv);
            density.add(at);
            if (late) across.add(at, position(meshes[0], p.face, p.uv).x);
        }
    };
    for (int pass = 0; pass < 3; ++pass) {
        record(pointsInAPass, false);
        recorder.passDone((pass + 1) / 8.0);
    }
    record(5 * pointsInAPass, true);
    EXPECT_LE(recorder.counts().bytesUsed, budget);
    const SurfaceField field = recorder.finish();
    EXPECT_EQ(field.layers[0].samples, 8u * std::uint64_t(pointsInAPass));
    EXPECT_EQ(field.layers[1].samples, 5u * std::uint64_t(pointsInAPass));
    const Refined refined(meshes[0], field);
    ASSERT_GT(refined.areas.size(), fewestTriangles);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < refined.areas.size(); ++i) {
        if (field.points[i] < 16) continue;  // perhaps all of them came before the layer
        float left = 1, right = 0;
        for (const std::uint32_t v : refined.mesh.triangles[i]) {
            left = std::min(left, refined.mesh.positions[v].x);
            right = std::max(right, refined.mesh.positions[v].x);
        }
        const float mean = field.layers[1].values[i];
        ASSERT_GE(mean, left - 1e-6f) << i;
        ASSERT_LE(mean, right + 1e-6f) << i;
        ++compared;
    }
    EXPECT_GT(compared, fewestTriangles / 6);
}

TEST(SurfaceFinish, AfterAPassPointsReachTheTrianglesThatHoldThem) {
    expectPointsInTheirTriangles(20000, 256u << 20, 3000);
    expectPointsInTheirTriangles(400000, 256u << 20, 60000);  // tables of many chunks, and new ones in the place of old ones
    expectPointsInTheirTriangles(400000, 4u << 20, 2000);     // and where there is hardly room for any
}

TEST(SurfaceFinish, AnEdgeInTheDensityStaysAnEdge) {
    // Samples only where x < 0.4: nothing of them may show far on the other side.
    const std::vector<Mesh> meshes = {grid(1)};
    SurfaceRecorder recorder(meshes, {.minimumEdge = 0});
    const SurfaceLayer density = *recorder.addLayer({"density", LayerKind::density, "", ""});
    UniformPoints points(meshes[0], 5);
    for (int i = 0; i < 500000; ++i) {
        const UniformPoint p = points.next();
        const Vec3f at = position(meshes[0], p.face, p.uv);
        if (at.x < 0.4f) density.add(recorder.cursor().locate(0, p.face, p.uv));
    }
    const SurfaceField field = recorder.finish();
    const Refined refined(meshes[0], field);
    double wrong = 0;
    for (std::size_t i = 0; i < refined.areas.size(); ++i) {
        float left = 1;
        for (const std::uint32_t v : refined.mesh.triangles[i]) left = std::min(left, refined.mesh.positions[v].x);
        if (left > 0.45f) wrong += refined.areas[i] * double(field.layers[0].values[i]);
    }
    EXPECT_LT(wrong / 200000, 0.01);
}

TEST(SurfaceFinish, ConditionalLayersFollowTheirOwnSamples) {
    // A layer that gets one value in ten points, and only where x > 0.5.
    const std::vector<Mesh> meshes = {grid(1)};
    SurfaceRecorder recorder(meshes, {.minimumEdge = 0});
    const SurfaceLayer events = *recorder.addLayer({"events", LayerKind::density, "", ""});
    const SurfaceLayer sum = *recorder.addLayer({"sum", LayerKind::sum, "", ""});
    UniformPoints points(meshes[0], 6);
    int expected = 0;
    for (int i = 0; i < 400000; ++i) {
        const UniformPoint p = points.next();
        const SurfacePoint at = recorder.cursor().locate(0, p.face, p.uv);
        if (i % 10 != 0 || position(meshes[0], p.face, p.uv).x <= 0.5f) continue;
        events.add(at);
        sum.add(at, 2.f);
        ++expected;
    }
    const SurfaceField field = recorder.finish();
    EXPECT_EQ(field.layers[0].samples, std::uint64_t(expected));
    EXPECT_NEAR(integral(field, field.layers[0], meshes), expected, 1e-4 * expected);
    EXPECT_NEAR(total(field.layers[1].values), 2.0 * expected, 1e-3 * expected);
    const Refined refined(meshes[0], field);
    double left = 0;
    for (std::size_t i = 0; i < refined.areas.size(); ++i) {
        float right = 0;
        for (const std::uint32_t v : refined.mesh.triangles[i]) right = std::max(right, refined.mesh.positions[v].x);
        if (right <= 0.5f) left += refined.areas[i] * double(field.layers[0].values[i]);
    }
    EXPECT_LT(left / expected, 0.08);
}

TEST(SurfaceFinish, GapsAreFilledSmoothlyFromAllSides) {
    // A plane of x + 2 y with a hole: filling must continue the plane, not smear one side over the hole.
    const std::vector<Mesh> meshes = {grid(30)};
    const Mesh& mesh = meshes[0];
    SurfaceRecorder recorder(meshes, {.maximumLevel = 0});
    const SurfaceLayer mean = *recorder.addLayer({"mean", LayerKind::mean, "", ""});
    const SurfaceLayer color = *recorder.addLayer({"color", LayerKind::meanColor, "", ""});
    const auto centre = [&](std::uint32_t face) { return position(mesh, face, {1.f / 3, 1.f / 3}); };
    const auto isHole = [&](Vec3f p) { return std::abs(p.x - 0.5f) < 0.12f && std::abs(p.y - 0.5f) < 0.12f; };
    const auto truth = [](Vec3f p) { return p.x + 2 * p.y; };
    int holes = 0;
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
        if (isHole(centre(face))) {
            ++holes;
            continue;
        }
        const SurfacePoint at = recorder.cursor().locate(0, face, Vec2f{1.f / 3, 1.f / 3});
        mean.add(at, truth(centre(face)));
        color.add(at, Color(1, 2, truth(centre(face))));
    }
    const SurfaceField field = recorder.finish();
    ASSERT_GT(holes, 50);
    double worst = 0;
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
        const float value = field.value(field.layers[0], 0, face);
        ASSERT_FALSE(std::isnan(value));
        worst = std::max(worst, std::abs(double(value - truth(centre(face)))));
        EXPECT_NEAR(field.value(field.layers[1], 0, face, 1), 2.f, 1e-5f);
        EXPECT_NEAR(field.value(field.layers[1], 0, face, 2), value, 1e-5f);
        EXPECT_EQ(field.points[face], isHole(centre(face)) ? 0.f : 1.f);
    }
    EXPECT_LT(worst, 0.06);  // the plane rises by 0.7 across the hole
}

TEST(SurfaceFinish, FillingCrossesDuplicatedVerticesAndLevels) {
    // Two squares side by side that share no vertex, as exporters write them; one is never sampled, the other divided.
    Mesh mesh = grid(1);
    for (const Vec3f p : grid(1).positions) mesh.positions.push_back(p + Vec3f{1, 0, 0});
    for (const Triangle& t : grid(1).triangles) mesh.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    const std::vector<Mesh> meshes = {mesh};
    SurfaceRecorder recorder(meshes, {.samplesPerDivision = 16});
    const SurfaceLayer mean = *recorder.addLayer({"mean", LayerKind::mean, "", ""});
    UniformPoints points(meshes[0], 2);
    for (int i = 0; i < 8000; ++i) {
        const UniformPoint p = points.next();
        if (p.face < 2) mean.add(recorder.cursor().locate(0, p.face, p.uv), position(mesh, p.face, p.uv).x);
    }
    const SurfaceField field = recorder.finish();
    EXPECT_GT(field.meshes[0].faceCount, 20u);
    const std::uint32_t last = field.meshes[0].faceCount - 2;  // the two faces of the second square
    for (std::uint32_t face = last; face < last + 2; ++face)
        EXPECT_NEAR(field.value(field.layers[0], 0, face), 1.f, 0.1f);  // as at the common edge
}

TEST(SurfaceFinish, GapsInADensityAreFilledOnlyWhereTheyMayBeChance) {
    const std::vector<Mesh> meshes = {grid(40)};
    const Mesh& mesh = meshes[0];
    SurfaceRecorder recorder(meshes);
    const SurfaceLayer density = *recorder.addLayer({"density", LayerKind::density, "", ""});
    UniformPoints points(mesh, 12);
    int count = 0;
    for (int i = 0; i < 1600; ++i) {  // half a sample on a face, none on the right half
        const UniformPoint p = points.next();
        if (position(mesh, p.face, p.uv).x >= 0.5f) continue;
        density.add(recorder.cursor().locate(0, p.face, p.uv));
        ++count;
    }
    const SurfaceField field = recorder.finish();
    EXPECT_NEAR(integral(field, field.layers[0], meshes), count, 1e-3 * count);
    int emptyLeft = 0, emptyRight = 0;
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
        const float x = position(mesh, face, {1.f / 3, 1.f / 3}).x;
        const bool empty = field.value(field.layers[0], 0, face) == 0;
        if (x < 0.45f) emptyLeft += empty;
        if (x > 0.65f) emptyRight += !empty;
    }
    EXPECT_LT(emptyLeft, 40);   // of 1440; 870 of them have no sample
    EXPECT_EQ(emptyRight, 0);
}

TEST(SurfaceFinish, TrianglesWithoutAreaDoNoHarm) {
    Mesh mesh = grid(2);
    const float nan = std::nanf("");
    mesh.positions.push_back({nan, 0, 0});
    mesh.positions.push_back({0.5f, 0.5f + 1e-7f, 0});
    const auto first = static_cast<std::uint32_t>(mesh.triangles.size());
    mesh.triangles.push_back({0, 0, 1});     // an edge
    mesh.triangles.push_back({2, 2, 2});     // a point
    mesh.triangles.push_back({0, 1, 9});     // with a vertex that is not a number
    mesh.triangles.push_back({0, 1, 99});    // with a vertex that does not exist
    mesh.triangles.push_back({3, 4, 10});    // a sliver along an edge
    const std::vector<Mesh> meshes = {mesh};
    SurfaceRecorder recorder(meshes, {.samplesPerDivision = 32});
    const SurfaceLayer density = *recorder.addLayer({"density", LayerKind::density, "", ""});
    const SurfaceLayer mean = *recorder.addLayer({"mean", LayerKind::mean, "", ""});
    UniformPoints points(grid(2), 3);
    for (int i = 0; i < 4000; ++i) {
        const UniformPoint p = points.next();
        const SurfacePoint at = recorder.cursor().locate(0, p.face, p.uv);
        density.add(at);
        mean.add(at, 1.f);
    }
    for (std::uint32_t face = first; face < first + 4; ++face)
        for (int i = 0; i < 100; ++i) {
            const SurfacePoint at = recorder.cursor().locate(0, face, Vec3f{0.1f, 0.2f, 0.3f});
            density.add(at);
            mean.add(at, 1.f);
        }
    density.add(recorder.cursor().locate(0, first + 4, Vec2f{0.2f, 0.2f}));
    const SurfaceField field = recorder.finish();
    EXPECT_EQ(field.layers[0].total, 4401.0);
    EXPECT_EQ(field.counts.invalid, 0u);
    double highest = 0;
    for (const float v : field.layers[0].values) {
        EXPECT_FALSE(std::isinf(v));
        if (!std::isnan(v)) highest = std::max(highest, double(v));
    }
    EXPECT_LT(highest, 2 * 4000);  // 4,000 is the truth; one sample on the sliver would be 10^7
    for (const float v : field.layers[1].values) EXPECT_FLOAT_EQ(v, 1.f);
}

TEST(SurfaceFinish, AMeshWithoutAnyAreaHasNoDensity) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}};
    mesh.triangles = {{0, 1, 1}, {0, 0, 0}};
    const std::vector<Mesh> meshes = {mesh, Mesh{}};
    SurfaceRecorder recorder(meshes);
    const SurfaceLayer density = *recorder.addLayer({"density", LayerKind::density, "", ""});
    for (int i = 0; i < 1000; ++i) density.add(recorder.cursor().locate(0, 0, Vec3f{0.5f, 0, 0}));
    const SurfaceField field = recorder.finish();
    ASSERT_EQ(field.meshes[0].faceCount, 2u);
    EXPECT_EQ(field.meshes[1].faceCount, 0u);
    EXPECT_EQ(field.layers[0].total, 1000.0);
    for (const float v : field.layers[0].values) EXPECT_TRUE(std::isnan(v));
}

}  // namespace
}  // namespace emca
