// Counting: every sample arrives exactly once, whatever the threads, the budget and the input are.
#include "emca/recorder/surface_recorder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "emca/core/surface_tree.h"
#include "surface_for_tests.h"
#include "surface_store.h"

namespace emca {
namespace {

using namespace test;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// All that must be true of `count` samples on mesh 0.
void expectAll(Collection& c, std::uint64_t count) {
    const SurfaceField field = c.recorder.finish();
    ASSERT_TRUE(validate(field, c.meshes).ok()) << validate(field, c.meshes).error().message;
    EXPECT_EQ(field.counts.points, count);
    EXPECT_EQ(field.layers[0].samples, count);
    EXPECT_EQ(field.layers[0].total, double(count));
    EXPECT_EQ(field.layers[1].samples, count);
    EXPECT_NEAR(total(field.points) / double(count), 1.0, 1e-5);
    EXPECT_NEAR(integral(field, field.layers[0], c.meshes) / double(count), 1.0, 1e-5);
    EXPECT_EQ(field.counts.invalid, 0u);
    EXPECT_LE(field.counts.bytesUsed, field.counts.budgetBytes);
}

TEST(SurfaceRecorder, TotalWeightIsTheNumberOfSamplesForAnyNumberOfThreads) {
    for (const int threads : {1, 2, 4}) {
        Collection c({grid(12)});
        inThreads(threads, [&](int i) { c.record(300000 / threads, 10 + unsigned(i)); });
        expectAll(c, 300000);
        EXPECT_GT(c.recorder.finish().meshes[0].faceCount, 2 * c.meshes[0].triangles.size());
    }
}

TEST(SurfaceRecorder, BeyondTheBudgetNoSampleIsLost) {
    for (const int threads : {1, 4})
        for (const std::size_t budget : {std::size_t(0), std::size_t(1) << 14, std::size_t(1) << 18, std::size_t(3) << 20}) {
            SCOPED_TRACE(budget);
            Collection c({grid(100)}, {.budgetBytes = budget, .samplesPerDivision = 4});
            inThreads(threads, [&](int i) { c.record(160000 / threads, 20 + unsigned(i)); });
            const SurfaceField field = c.recorder.finish();
            EXPECT_EQ(field.counts.points, 160000u);
            EXPECT_EQ(field.layers[0].samples, 160000u);
            EXPECT_EQ(field.layers[0].total, 160000.0);
            EXPECT_NEAR(integral(field, field.layers[0], c.meshes) / 160000, 1.0, 1e-5);
            if (budget <= std::size_t(1) << 18) {
                EXPECT_GT(field.counts.coarse, 0u);
            } else {
                EXPECT_GT(field.counts.refusedDivisions, 0u);
            }
            if (budget >= std::size_t(1) << 18) {
                EXPECT_LE(field.counts.bytesUsed, budget);
            }
        }
}

TEST(SurfaceRecorder, AllSamplesOnOnePoint) {
    for (const int threads : {1, 2, 4}) {
        Collection c({grid(1)});
        inThreads(threads, [&](int) {
            SurfaceCursor& surface = c.recorder.cursor();
            for (int i = 0; i < 200000; ++i) {
                const SurfacePoint at = surface.locate(0, 0, Vec2f{0.3f, 0.2f});
                c.density.add(at);
                c.mean.add(at, 0.25f);
            }
        });
        expectAll(c, 200000u * unsigned(threads));
        const SurfaceField field = c.recorder.finish();
        EXPECT_EQ(field.layers[1].total, 50000.0 * threads);
    }
}

TEST(SurfaceRecorder, ACounterNearItsLimitGoesOnExactly) {
    const std::vector<Mesh> meshes = {grid(1)};
    const std::uint64_t before = (std::uint64_t(1) << 32) - 1000, pointsBefore = detail::SurfaceNode::kFull - 1000;
    detail::SurfaceStore store({{meshes[0].positions, meshes[0].triangles}}, {.maximumLevel = 0});
    store.addLayer({"density", LayerKind::density, "", ""});
    detail::SurfaceCursorImpl* cursor = store.acquire();
    detail::SurfaceNode* root = store.rootForTest(0);
    root->points = static_cast<std::uint32_t>(pointsBefore);
    *store.counterForTest(root, store.layouts()[0]) = static_cast<std::uint32_t>(before);
    *const_cast<double*>(store.sums(root, store.layouts()[0])) = double(before);
    for (int i = 0; i < 5000; ++i) {
        std::uint32_t* values = cursor->append(0, 0, 0, 0, 0, 0);  // at the first vertex
        values[store.layouts()[0].maskWord] = 1u << store.layouts()[0].bit;
        values[store.layouts()[0].valueWord] = std::bit_cast<std::uint32_t>(1.f);
    }
    store.flush();
    const SurfaceField field = detail::makeField(store);
    EXPECT_EQ(field.layers[0].samples, before + 5000);
    EXPECT_EQ(field.layers[0].total, double(before + 5000));
    EXPECT_EQ(store.points(root), pointsBefore + 5000);
    EXPECT_FLOAT_EQ(field.points[0], float(pointsBefore + 5000));
}

TEST(SurfaceRecorder, SmallWeightsAreStillAddedToALargeSum) {
    Collection c({grid(1)}, {.maximumLevel = 0});
    SurfaceCursor& surface = c.recorder.cursor();
    const SurfacePoint at = surface.locate(0, 0, Vec2f{0.1f, 0.1f});
    c.density.add(at, float(1u << 24));
    for (int i = 0; i < 100000; ++i) c.density.add(at, 1.f);  // in single precision, every one of them would be lost
    EXPECT_EQ(c.recorder.finish().layers[0].total, double((1u << 24) + 100000));
}

TEST(SurfaceRecorder, PositionAndBarycentricsMeanTheSamePlace) {
    Collection byPosition({grid(3)}, {.samplesPerDivision = 16, .maximumLevel = 4});
    Collection byWeights({grid(3)}, {.samplesPerDivision = 16, .maximumLevel = 4});
    for (Collection* c : {&byPosition, &byWeights}) {
        c->record(20000, 6);
        c->recorder.passDone(0.5);  // from here on, both divide no more
    }
    UniformPoints points(byWeights.meshes[0], 5);
    for (int i = 0; i < 20000; ++i) {
        const UniformPoint p = points.next();
        byWeights.mean.add(byWeights.recorder.cursor().locate(0, p.face, p.uv), 1.f);
        const Vec3f above = position(byPosition.meshes[0], p.face, p.uv) + Vec3f{0, 0, 0.01f};
        byPosition.mean.add(byPosition.recorder.cursor().locate(0, p.face, above), 1.f);
    }
    const SurfaceField a = byPosition.recorder.finish(), b = byWeights.recorder.finish();
    ASSERT_EQ(a.meshes[0], b.meshes[0]);
    ASSERT_GT(a.meshes[0].faceCount, 1000u);
    double apart = 0;  // points within rounding of a border may be on either side
    for (std::size_t i = 0; i < a.points.size(); ++i) apart += std::abs(double(a.points[i] - b.points[i]));
    EXPECT_LT(apart, 20);
}

TEST(SurfaceRecorder, APathIsWhatGoingDownStepByStepFinds) {
    std::mt19937 random(4);
    for (int i = 0; i < 100000; ++i) {
        std::uint32_t u = random() & (detail::kOne - 1), v = random() & (detail::kOne - 1);
        if (u + v >= detail::kOne) u = detail::kOne - 1 - u, v = detail::kOne - 1 - v;
        std::uint32_t path = detail::surfacePath(u, v);
        // On an edge, both sides are right; of 30 digits, the last ones are all zero too seldom to matter.
        for (std::uint32_t level = 0; level < 12; ++level, path = detail::below(path))
            ASSERT_EQ(detail::firstChild(path), detail::descend(u, v)) << i << ", level " << level;
    }
    for (const auto& [u, v] : {std::pair{0u, 0u}, {detail::kOne, 0u}, {0u, detail::kOne}})  // the three corners
        EXPECT_EQ(detail::surfacePath(u, v), u ? 0x55555555u : v ? 0xaaaaaaaau : 0u);
}

TEST(SurfaceRecorder, WhatIsNotAPlaceOrAValueIsCountedAsInvalid) {
    Collection c({grid(2), grid(1)});
    SurfaceCursor& surface = c.recorder.cursor();
    for (const auto& [mesh, face] : {std::pair{2u, 0u}, {0u, 8u}, {~0u, 0u}, {1u, ~0u}}) {
        const SurfacePoint nowhere = surface.locate(mesh, face, Vec2f{0.1f, 0.1f});
        c.density.add(nowhere);
        c.density.add(surface.locate(mesh, face, Vec3f{}));
    }
    c.density.add(surface.locate(0, 0, Vec3f{0, kNaN, 0}));
    c.density.add(surface.locate(0, 0, Vec3f{0, 0, kInfinity}));
    c.density.add(surface.locate(0, 0, Vec2f{kNaN, 0}));
    EXPECT_EQ(c.recorder.finish().counts.invalid, 11u);
    const SurfacePoint good = surface.locate(0, 0, Vec2f{0.1f, 0.1f});
    for (const float value : {kNaN, kInfinity, -kInfinity}) c.mean.add(good, value);
    c.mean.add(good, Color(1, kNaN, 1));
    c.mean.add(good, 2.f);
    const SurfaceField field = c.recorder.finish();
    EXPECT_EQ(field.counts.invalid, 15u);
    EXPECT_EQ(field.counts.points, 1u);
    EXPECT_EQ(field.layers[0].samples, 0u);
    EXPECT_EQ(field.layers[1].samples, 1u);
    EXPECT_EQ(field.value(field.layers[1], 0, 0), 2.f);
    EXPECT_EQ(field.meshes[1].faceCount, 0u);  // never sampled
    EXPECT_TRUE(std::isnan(field.value(field.layers[1], 1, 0)));
    EXPECT_EQ(field.value(field.layers[0], 1, 0), 0.f);
}

TEST(SurfaceRecorder, APointThatIsLocatedAnewKeepsNothingOfItsLastPlace) {
    Collection c({grid(2)});
    SurfaceCursor& surface = c.recorder.cursor();
    SurfacePoint point = surface.locate(0, 0, Vec3f{0, 0, kNaN});  // the first that is invalid
    surface.locate(0, 0, Vec2f{0.1f, 0.1f}, point);
    c.mean.add(point, kNaN);  // and the second
    c.mean.add(point, 2.f);
    const SurfaceField field = c.recorder.finish();
    EXPECT_EQ(field.counts.invalid, 2u);
    EXPECT_EQ(field.counts.points, 1u);
}

TEST(SurfaceRecorder, PlacesOutsideTheirTriangleAreTakenToItsBorder) {
    Collection c({grid(1)}, {.samplesPerDivision = 1, .maximumLevel = 3});
    SurfaceCursor& surface = c.recorder.cursor();
    for (int i = 0; i < 100; ++i) {
        for (const SurfacePoint& at :
             {surface.locate(0, 0, Vec2f{-1e30f, 3e38f}), surface.locate(0, 0, Vec3f{1e20f, -1e20f, 7}),
              surface.locate(0, 1, Vec2f{0.7f, 0.7f})}) {
            c.density.add(at);
            c.mean.add(at, 1.f);
        }
    }
    expectAll(c, 300);
}

TEST(SurfaceRecorder, ValuesMayComeLongAfterTheirPoint) {
    Collection c({grid(4)}, {.samplesPerDivision = 8});
    SurfaceCursor& surface = c.recorder.cursor();
    UniformPoints points(c.meshes[0], 3);
    std::vector<SurfacePoint> kept;
    for (int i = 0; i < 20000; ++i) {
        const UniformPoint p = points.next();
        kept.push_back(surface.locate(0, p.face, p.uv));
    }
    for (const SurfacePoint& at : kept) c.mean.add(at, 3.f);
    const SurfaceField field = c.recorder.finish();
    EXPECT_EQ(field.counts.points, 20000u);
    EXPECT_EQ(field.layers[1].samples, 20000u);
    EXPECT_EQ(field.layers[1].total, 60000.0);
    EXPECT_EQ(field.layers[0].samples, 0u);
    for (const float v : field.layers[1].values) EXPECT_FLOAT_EQ(v, 3.f);
}

TEST(SurfaceRecorder, EveryCallIsASampleOfItsOwn) {
    Collection c({grid(1)});
    const SurfacePoint at = c.recorder.cursor().locate(0, 1, Vec2f{0.2f, 0.2f});
    for (const float v : {1.f, 2.f, 6.f}) c.mean.add(at, v);
    const SurfaceField field = c.recorder.finish();
    EXPECT_EQ(field.layers[1].samples, 3u);
    EXPECT_FLOAT_EQ(field.value(field.layers[1], 0, 1), 3.f);
    EXPECT_EQ(field.counts.points, 1u);
}

TEST(SurfaceRecorder, AnyNumberOfLayers) {
    const std::vector<Mesh> meshes = {grid(2)};
    SurfaceRecorder recorder(meshes, {.samplesPerDivision = 10});
    std::vector<SurfaceLayer> layers;
    for (int i = 0; i < 100; ++i)
        layers.push_back(*recorder.addLayer({"layer " + std::to_string(i), LayerKind(i % 4), "", ""}));
    SurfaceCursor& surface = recorder.cursor();
    UniformPoints points(meshes[0], 4);
    for (int i = 0; i < 3000; ++i) {
        const UniformPoint p = points.next();
        const SurfacePoint at = surface.locate(0, p.face, p.uv);
        for (int l = 0; l < 100; ++l)
            if (i % (l + 1) == 0) layers[std::size_t(l)].add(at, Color(float(l)));
    }
    const SurfaceField field = recorder.finish();
    ASSERT_TRUE(validate(field, meshes).ok());
    for (std::uint64_t l = 0; l < 100; ++l) {
        EXPECT_EQ(field.layers[l].samples, (2999 / (l + 1)) + 1);
        EXPECT_NEAR(field.layers[l].total, double(l * field.layers[l].samples), 1e-3 * double(l));
    }
}

TEST(SurfaceRecorder, NothingIsAllocatedBeforeALayerIsAskedFor) {
    const std::vector<Mesh> meshes = {grid(2)};
    SurfaceRecorder recorder(meshes);
    recorder.cursor().locate(0, 0, Vec2f{});
    EXPECT_EQ(recorder.counts().bytesUsed, 0u);
    const SurfaceLayer nothing;
    nothing.add(recorder.cursor().locate(0, 0, Vec2f{}), 1.f);
    const SurfaceField field = recorder.finish();
    EXPECT_TRUE(validate(field, meshes).ok());
    EXPECT_EQ(field.faceCount(), 0u);
    ASSERT_TRUE(recorder.addLayer({"a", LayerKind::sum, "", ""}).ok());  // still possible
    recorder.cursor().locate(0, 0, Vec2f{});
    EXPECT_GT(recorder.counts().bytesUsed, 0u);
}

TEST(SurfaceRecorder, LayersAreRefusedWithAReason) {
    const std::vector<Mesh> meshes = {grid(1)};
    SurfaceRecorder recorder(meshes);
    EXPECT_FALSE(recorder.addLayer({"", LayerKind::mean, "", ""}).ok());
    EXPECT_FALSE(recorder.addLayer({"x", LayerKind(17), "", ""}).ok());
    EXPECT_TRUE(recorder.addLayer({"x", LayerKind::mean, "", ""}).ok());
    EXPECT_FALSE(recorder.addLayer({"x", LayerKind::sum, "", ""}).ok());
    recorder.cursor();
    EXPECT_FALSE(recorder.addLayer({"y", LayerKind::mean, "", ""}).ok());
}

TEST(SurfaceRecorder, RecordingMayGoOnAfterFinish) {
    Collection c({grid(4)});
    c.record(50000, 1);
    const SurfaceField first = c.recorder.finish();
    c.record(50000, 2);
    EXPECT_EQ(first.counts.points, 50000u);
    expectAll(c, 100000);
}

TEST(SurfaceRecorder, ThreadsThatEndLeaveTheirBlocksToOthers) {
    Collection c({grid(4)});
    inThreads(1, [&](int) { c.record(20000, 1); });
    const std::uint64_t used = c.recorder.counts().bytesUsed;
    for (unsigned i = 0; i < 30; ++i) inThreads(1, [&](int) { c.record(100, 2 + i); });
    EXPECT_LE(c.recorder.counts().bytesUsed, used + 64 * 4096);
    expectAll(c, 23000);
}

TEST(SurfaceRecorder, ARecorderMayEndBeforeItsThreads) {
    auto first = std::make_unique<Collection>(std::vector<Mesh>{grid(1)});
    auto second = std::make_unique<Collection>(std::vector<Mesh>{grid(1)});
    for (int round = 0; round < 10; ++round) {
        first->record(10, 1);
        second->record(10, 2);
        first.swap(second);
        second = std::make_unique<Collection>(std::vector<Mesh>{grid(1)});
    }
    first->record(5, 3);
    expectAll(*first, 15);
}

TEST(SurfaceRecorder, AFieldThatTheRendererCollectedItselfIsReturnedAsItIs) {
    Collection source({grid(3)});
    source.record(1000, 1);
    const SurfaceField own = source.recorder.finish();
    Collection c({grid(3)});
    c.record(10, 2);
    ASSERT_TRUE(c.recorder.setField(own).ok());
    const SurfaceField returned = c.recorder.finish();
    EXPECT_EQ(returned.meshes, own.meshes);
    EXPECT_EQ(returned.counts, own.counts);
    ASSERT_EQ(returned.layers.size(), own.layers.size());
    EXPECT_TRUE(std::ranges::equal(returned.layers[1].values, own.layers[1].values));

    SurfaceField fewer = own;
    fewer.layers.pop_back();
    EXPECT_EQ(c.recorder.setField(fewer).error().code, ErrorCode::invalidArgument);
    SurfaceField other = own;
    other.meshes[0].faceCount -= 1;
    EXPECT_EQ(c.recorder.setField(other).error().code, ErrorCode::protocolViolation);
    Collection smaller({grid(2)});
    EXPECT_FALSE(smaller.recorder.setField(own).ok());
}

TEST(SurfaceRecorder, OneThreadGivesEqualBits) {
    Collection a({grid(5)}, {.samplesPerDivision = 50}), b({grid(5)}, {.samplesPerDivision = 50});
    a.record(100000, 6);
    b.record(100000, 6);
    const SurfaceField x = a.recorder.finish(), y = b.recorder.finish();
    EXPECT_EQ(x.meshes, y.meshes);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_TRUE(std::equal(x.layers[i].values.begin(), x.layers[i].values.end(), y.layers[i].values.begin()));
}

}  // namespace
}  // namespace emca
