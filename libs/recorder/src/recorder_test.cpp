// What the calls of Algorithm 1 mean, seen through the recorded PathSet.
#include "emca/recorder/recorder.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace emca {
namespace {

PathSet finished(Recording& recording) {
    auto paths = recording.finish();
    EXPECT_TRUE(paths.ok()) << paths.error().message;
    return paths.ok() ? *paths : PathSet();
}

Value lastOf(const PathSet& paths, Scope scope, const char* key, Index owner) {
    const auto columns = paths.find(scope, key);
    EXPECT_EQ(columns.size(), 1u) << key;
    return paths.last(*columns.at(0), owner).value();
}

TEST(Recorder, OutsideAScopeNothingIsEvaluated) {
    bool evaluated = false;
    auto costly = [&] { evaluated = true; return 1.f; };
    PathRecorder& emca = recorder();
    EXPECT_FALSE(emca.isRecording());
    emca.setPathIndex(1);
    emca.addIntersectionData("costly", costly);
    EXPECT_FALSE(evaluated);
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        EXPECT_TRUE(emca.isRecording());
        emca.setPathIndex(1);
        emca.setDepthIndex(1);
        emca.addIntersectionData("costly", costly);
    }
    EXPECT_TRUE(evaluated);
    EXPECT_FALSE(emca.isRecording());
}

TEST(Recorder, AlgorithmOneWithIndicesFromOne) {
    Recording recording;
    {
        const RecordScope scope(recording, {3, 4});
        PathRecorder& emca = recorder();
        for (int sample = 1; sample <= 3; ++sample) {
            emca.setPathIndex(sample);
            emca.setPathOrigin(Vec3f{1, 2, 3});
            for (int bounce = 1; bounce <= sample; ++bounce) {
                emca.setDepthIndex(bounce);
                emca.setIntersectionPos(Vec3f{float(bounce), 0, 0});
                emca.addIntersectionData("PDF", 0.25f * float(bounce));
            }
            emca.addPathData("left scene", true);
            emca.setFinalEstimate(Color(1, 2, float(sample)));
        }
    }
    const PathSet paths = finished(recording);
    ASSERT_EQ(paths.pathCount(), 3u);
    EXPECT_EQ(paths.vertexCount(), 6u);
    for (Index p = 0; p < 3; ++p) {
        EXPECT_EQ(paths.sample(p), p + 1);
        EXPECT_EQ(paths.pixel(p), (Pixel{3, 4}));
        EXPECT_EQ(paths.depth(p), std::int32_t(p + 1));
        EXPECT_EQ(paths.origin(p), (Vec3f{1, 2, 3}));
        EXPECT_EQ(paths.estimate(p), Color(1, 2, float(p + 1)));
        EXPECT_EQ(lastOf(paths, Scope::path, "left scene", p), Value(true));
        EXPECT_EQ(lastOf(paths, Scope::vertex, "PDF", paths.vertices(p).last - 1), Value(0.25f * float(p + 1)));
    }
}

TEST(Recorder, MissingDataIsSkippedAndIndicesAreEnough) {
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setPathIndex(-7);
        emca.setPathIndex(1000000007);
        emca.setDepthIndex(40);
        emca.setDepthIndex(2);
    }
    const PathSet paths = finished(recording);
    ASSERT_EQ(paths.pathCount(), 2u);
    EXPECT_EQ(paths.sample(0), -7);
    EXPECT_FALSE(paths.origin(1));
    EXPECT_FALSE(paths.estimate(1));
    EXPECT_EQ(paths.depth(1), 0) << "no vertex has a position";
    ASSERT_EQ(paths.vertices(1).size(), 2u);
    EXPECT_EQ(paths.depthIndex(0), 2) << "vertices come in the order of their depth";
    EXPECT_EQ(paths.depthIndex(1), 40);
    EXPECT_FALSE(paths.position(0));
}

TEST(Recorder, DataBeforeAPathOrVertexIsCounted) {
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setDepthIndex(1);
        emca.setFinalEstimate(1.f);
        emca.setPathIndex(0);
        emca.setIntersectionPos(Vec3f{});
        emca.addIntersectionData("x", 1);
        emca.endPath();
        emca.addPathData("y", 1);
    }
    const PathSet paths = finished(recording);
    EXPECT_EQ(paths.pathCount(), 1u);
    EXPECT_EQ(paths.vertexCount(), 0u);
    EXPECT_EQ(recording.stats().droppedWithoutPath, 3u);
    EXPECT_EQ(recording.stats().droppedWithoutVertex, 2u);
}

TEST(Recorder, RevisitingADepthContinuesTheVertexAndRepeatedKeysKeepCallOrder) {
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setPathIndex(0);
        emca.setDepthIndex(1);
        emca.addIntersectionData("k", 1);
        emca.setDepthIndex(2);
        emca.addIntersectionData("k", 2);
        emca.setDepthIndex(1);
        emca.addIntersectionData("k", 3);
        emca.setNextEventEstimationPos(Vec3f{1, 0, 0}, true);
        emca.setNextEventEstimationPos(Vec3f{2, 0, 0}, false);
    }
    const PathSet paths = finished(recording);
    ASSERT_EQ(paths.vertexCount(), 2u);
    const Column& k = *paths.find(Scope::vertex, "k").at(0);
    ASSERT_EQ(k.valuesOf(0).size(), 2u);
    EXPECT_EQ(paths.value(k, 0), Value(std::int64_t(1)));
    EXPECT_EQ(paths.value(k, 1), Value(std::int64_t(3)));
    EXPECT_EQ(paths.last(k, 0), Value(std::int64_t(3)));
    EXPECT_EQ(paths.last(k, 1), Value(std::int64_t(2)));
    ASSERT_EQ(paths.nextEvents(0).size(), 2u);
    EXPECT_EQ(paths.nextEvent(0).visible, 1u);
    EXPECT_EQ(paths.nextEvent(1).position, (Vec3f{2, 0, 0}));
    EXPECT_EQ(paths.nextEvent(1).visible, 0u);
}

TEST(Recorder, EveryTypeComesBackBitByBit) {
    struct Mine { double x, y, z; };
    struct Paint { float r, g, b, a; };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> spectrum{1, nan, 3};
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setPathIndex(0);
        emca.setDepthIndex(1);
        emca.addIntersectionData("bool", false);
        emca.addIntersectionData("int", 42u);
        emca.addIntersectionData("int2", Vec2i{-1, 2});
        emca.addIntersectionData("int3", Vec3<int>{1, 2, 3});
        emca.addIntersectionData("float", 1.5f);
        emca.addIntersectionData("float2", Vec2f{1, 2});
        emca.addIntersectionData("float3", Vec3f{1, 2, 3});
        emca.addIntersectionData("double", 1e300);
        emca.addIntersectionData("double2", Vec2d{1, 2});
        emca.addIntersectionData("double3", Mine{1, 2, 3});
        emca.addIntersectionData("color", Color(1, 2, 3));
        emca.addIntersectionData("rgba", Paint{1, 2, 3, 4});
        emca.addIntersectionData("text", std::string("glass, rough"));
        emca.addIntersectionData("literal", "a key whose text is longer than any small string");
        emca.addIntersectionData("spectrum", spectrum);
    }
    const PathSet paths = finished(recording);
    EXPECT_EQ(lastOf(paths, Scope::vertex, "bool", 0), Value(false));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "int", 0), Value(std::int64_t(42)));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "int2", 0), Value(Vec2i{-1, 2}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "int3", 0), Value(Vec3i{1, 2, 3}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "float", 0), Value(1.5f));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "float2", 0), Value(Vec2f{1, 2}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "float3", 0), Value(Vec3f{1, 2, 3}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "double", 0), Value(1e300));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "double2", 0), Value(Vec2d{1, 2}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "double3", 0), Value(Vec3d{1, 2, 3}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "color", 0), Value(Color(1, 2, 3)));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "rgba", 0), Value(ColorA{1, 2, 3, 4}));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "text", 0), Value(std::string("glass, rough")));
    EXPECT_EQ(lastOf(paths, Scope::vertex, "literal", 0), Value(std::string("a key whose text is longer than any small string")));
    const auto back = std::get<std::vector<float>>(lastOf(paths, Scope::vertex, "spectrum", 0));
    ASSERT_EQ(back.size(), 3u);
    EXPECT_TRUE(std::isnan(back[1]));
}

TEST(Recorder, AKeyWithTwoTypesIsTwoColumns) {
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        recorder().setPathIndex(0);
        recorder().addPathData("k", 1);
        recorder().addPathData("k", 2.5);
    }
    const PathSet paths = finished(recording);
    EXPECT_EQ(paths.find(Scope::path, "k").size(), 2u);
    EXPECT_TRUE(paths.find(Scope::vertex, "k").empty());
}

TEST(Recorder, AnEnvironmentHitIsAVertexOfItsOwn) {
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setPathIndex(0);
        emca.setDepthIndex(1);
        emca.setIntersectionPos(Vec3f{1, 0, 0});
        emca.setIntersectionPosEnvmap(Vec3f{100, 0, 0});
        emca.setIntersectionEmission(Color(5.f));
        emca.setPathIndex(1);
        emca.setDepthIndex(1);
        emca.setIntersectionPosEnvmap(Vec3f{200, 0, 0});
    }
    const PathSet paths = finished(recording);
    ASSERT_EQ(paths.vertices(0).size(), 2u);
    EXPECT_FALSE(paths.isEnvironment(0));
    EXPECT_TRUE(paths.isEnvironment(1));
    EXPECT_EQ(paths.depthIndex(1), 2);
    EXPECT_EQ(paths.emission(1), Color(5.f));
    EXPECT_FALSE(paths.emission(0));
    EXPECT_EQ(paths.depth(0), 2);
    ASSERT_EQ(paths.vertices(1).size(), 1u);
    EXPECT_TRUE(paths.isEnvironment(2));
}

TEST(Recorder, EventsSurfacesContributionsAndSubpaths) {
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setPathIndex(0, 2);
        emca.setDepthIndex(1);
        emca.setIntersectionSurface(4, 17);
        emca.setIntersectionEvent(Event::transmit, Lobe::specular, "glass");
        emca.addContribution(Color(1, 0, 0), "light sampling", 0.25f);
        emca.addContribution(Color(0, 1, 0), "BSDF sampling", 0.75f, LightEnd::hit);
        emca.setIntersectionEstimate(Color(3.f));
        emca.setDepthIndex(1, Subpath::light);
        emca.setIntersectionPos(Vec3f{9, 9, 9});
    }
    const PathSet paths = finished(recording);
    EXPECT_EQ(paths.part(0), 2);
    ASSERT_EQ(paths.vertexCount(), 2u);
    EXPECT_EQ(paths.subpath(0), Subpath::camera);
    EXPECT_EQ(paths.subpath(1), Subpath::light);
    EXPECT_EQ(paths.surface(0)->mesh, 4);
    EXPECT_EQ(paths.surface(0)->face, 17);
    EXPECT_FALSE(paths.surface(1));
    EXPECT_EQ(paths.scattering(0)->event, Event::transmit);
    EXPECT_EQ(paths.scattering(0)->lobe, Lobe::specular);
    EXPECT_EQ(paths.scattering(0)->label, "glass");
    ASSERT_EQ(paths.contributions(0).size(), 2u);
    EXPECT_EQ(paths.text(paths.contribution(0).technique), "light sampling");
    EXPECT_EQ(paths.contribution(1).misWeight, 0.75f);
    EXPECT_EQ(paths.contribution(1).end, LightEnd::hit);
    EXPECT_EQ(paths.vertexEstimate(0), Color(3.f));
}

TEST(Recorder, ScopesNestAndDoNotMix) {
    Recording outer, inner;
    {
        const RecordScope a(outer, {0, 0});
        recorder().setPathIndex(1);
        {
            const RecordScope b(inner, {0, 0});
            recorder().setPathIndex(2);
        }
        recorder().addPathData("still outer", true);
    }
    const PathSet outerPaths = finished(outer), innerPaths = finished(inner);
    ASSERT_EQ(outerPaths.pathCount(), 1u);
    EXPECT_EQ(outerPaths.sample(0), 1);
    EXPECT_EQ(outerPaths.find(Scope::path, "still outer").size(), 1u);
    ASSERT_EQ(innerPaths.pathCount(), 1u);
    EXPECT_EQ(innerPaths.sample(0), 2);
}

}  // namespace
}  // namespace emca
