// What a request bounds: pixels, columns, bytes; and any number of threads.
#include "emca/recorder/recording.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "emca/recorder/recorder.h"

namespace emca {
namespace {

void recordPath(Pixel pixel, std::int64_t sample, int vertices) {
    PathRecorder& emca = recorder();
    emca.setPixel(pixel);
    emca.setPathIndex(sample);
    emca.setPathOrigin(Vec3f{float(sample), 0, 0});
    for (int d = 1; d <= vertices; ++d) {
        emca.setDepthIndex(d);
        emca.setIntersectionPos(Vec3f{float(pixel.x), float(sample), float(d)});
        emca.addIntersectionData("depth again", d);
        if (d % 2) emca.addIntersectionData("odd", std::string("odd ") + std::to_string(d));
        emca.addIntersectionData("twice", float(d));
        emca.addIntersectionData("twice", -float(d));
    }
    emca.setFinalEstimate(Color(float(sample)));
}

void expectComplete(const PathSet& paths, Index width, Index samples, int vertices) {
    ASSERT_EQ(paths.pathCount(), width * samples);
    const Column& again = *paths.find(Scope::vertex, "depth again").at(0);
    const Column& odd = *paths.find(Scope::vertex, "odd").at(0);
    const Column& twice = *paths.find(Scope::vertex, "twice").at(0);
    EXPECT_TRUE(again.dense());
    Index p = 0;
    for (Index x = 0; x < width; ++x)
        for (Index s = 0; s < samples; ++s, ++p) {
            ASSERT_EQ(paths.pixel(p), (Pixel{x, 0}));
            ASSERT_EQ(paths.sample(p), s);
            ASSERT_EQ(paths.vertices(p).size(), Index(vertices));
            for (Index v = paths.vertices(p).first; v < paths.vertices(p).last; ++v) {
                const int d = paths.depthIndex(v);
                ASSERT_EQ(paths.position(v), (Vec3f{float(x), float(s), float(d)}));
                ASSERT_EQ(paths.last(again, v), Value(std::int64_t(d)));
                ASSERT_EQ(paths.last(odd, v).has_value(), d % 2 == 1);
                if (d % 2) { ASSERT_EQ(paths.last(odd, v), Value("odd " + std::to_string(d))); }
                ASSERT_EQ(twice.valuesOf(v).size(), 2u);
                ASSERT_EQ(paths.value(twice, twice.valuesOf(v).first), Value(float(d)));
                ASSERT_EQ(paths.last(twice, v), Value(-float(d)));
            }
        }
}

TEST(Recording, ThreadsInAnyOrderGiveTheOrderedResult) {
    constexpr Index kWidth = 8, kSamples = 50;
    constexpr int kVertices = 9;
    Recording recording;
    std::vector<std::pair<Index, Index>> work;
    for (Index x = 0; x < kWidth; ++x)
        for (Index s = 0; s < kSamples; ++s) work.push_back({x, s});
    std::shuffle(work.begin(), work.end(), std::mt19937(5));
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            const RecordScope scope(recording, {0, 0});
            for (std::size_t i; (i = next.fetch_add(1)) < work.size();) recordPath({work[i].first, 0}, work[i].second, kVertices);
        });
    for (std::thread& thread : threads) thread.join();
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    expectComplete(*paths, kWidth, kSamples, kVertices);
}

// Longer than the 65,536 owners that a page can address from its first.
TEST(Recording, LongPathsAndLongGapsBetweenValues) {
    Recording recording({.budgetBytes = 1u << 30});
    {
        const RecordScope scope(recording, {0, 0});
        PathRecorder& emca = recorder();
        emca.setPathIndex(0);
        for (int d = 0; d < 200000; ++d) {
            emca.setDepthIndex(d);
            if (d % 70000 == 0) emca.addIntersectionData("rare", d);
            emca.addIntersectionData("each", d);
        }
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    const Column& rare = *paths->find(Scope::vertex, "rare").at(0);
    const Column& each = *paths->find(Scope::vertex, "each").at(0);
    ASSERT_EQ(rare.count, 3u);
    EXPECT_EQ(rare.owner(2), 140000u);
    EXPECT_EQ(paths->value(rare, 2), Value(std::int64_t(140000)));
    ASSERT_EQ(each.count, 200000u);
    for (Index v = 0; v < 200000; v += 997) ASSERT_EQ(paths->value(each, v), Value(std::int64_t(v)));
}

TEST(Recording, OnlyPathsThatHitTheAskedPixelsAreKept) {
    Recording recording({.pixels = {{1, 0}, {5, 5}}});
    {
        const RecordScope scope(recording);
        PathRecorder& emca = recorder();
        for (int s = 0; s < 300; ++s) {
            emca.setPathIndex(s);
            for (int d = 1; d < 20; ++d) {
                emca.setDepthIndex(d, Subpath::light);
                emca.addIntersectionData("value", s * 100 + d);
                emca.addIntersectionData("spectrum", std::vector<float>(3, float(s)));
            }
            emca.addPathData("path", s);
            emca.addSplat({std::uint32_t(s % 10), 0}, Color(float(s)));
            if (s == 7) emca.addSplat({5, 5}, Color(1.f));
        }
        emca.setPixel({1, 0});
        emca.setPathIndex(1000);
        emca.setPixel({2, 0});
        emca.setPathIndex(1000);
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    EXPECT_EQ(paths->pathCount(), 30u + 1u + 1u);
    EXPECT_EQ(recording.stats().pathsNotKept, 270u - 1u + 1u);
    const Column& value = *paths->find(Scope::vertex, "value").at(0);
    const Column& spectrum = *paths->find(Scope::vertex, "spectrum").at(0);
    for (Index p = 0; p < paths->pathCount(); ++p) {
        const auto s = paths->sample(p);
        if (s == 1000) continue;
        EXPECT_TRUE(s % 10 == 1 || s == 7);
        EXPECT_EQ(paths->splats(p).size(), s == 7 ? 2u : 1u);
        for (Index v = paths->vertices(p).first; v < paths->vertices(p).last; ++v) {
            ASSERT_EQ(paths->last(value, v), Value(s * 100 + paths->depthIndex(v)));
            ASSERT_EQ(paths->last(spectrum, v), Value(std::vector<float>(3, float(s))));
        }
    }
    EXPECT_EQ(paths->pixel(*paths->findPath({5, 5}, 7)), (Pixel{5, 5}));
}

TEST(Recording, ForgottenPathsGiveTheirBytesBack) {
    Recording recording({.pixels = {{0, 0}}, .budgetBytes = 1u << 20});
    {
        const RecordScope scope(recording);
        PathRecorder& emca = recorder();
        for (int s = 0; s < 20000; ++s) {
            emca.setPathIndex(s);
            for (int d = 0; d < 8; ++d) {
                emca.setDepthIndex(d);
                emca.addIntersectionData("a", d);
                emca.addIntersectionData("s", std::vector<float>(16, 1.f));
            }
            emca.addSplat({s == 19999 ? 0u : 1u, 0}, Color(1.f));
        }
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    EXPECT_EQ(paths->pathCount(), 1u);
    EXPECT_EQ(recording.stats().droppedByBudget, 0u);
    EXPECT_EQ(paths->vertexCount(), 8u);
}

// More than two bytes can count.
TEST(Recording, ManyKeys) {
    constexpr int kKeys = 70000;
    Recording recording;
    {
        const RecordScope scope(recording, {0, 0});
        recorder().setPathIndex(0);
        recorder().setDepthIndex(1);
        for (int round = 0; round < 2; ++round)
            for (int k = 0; k < kKeys; ++k) recorder().addIntersectionData(Key(std::to_string(k)), k + round);
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok()) << paths.error().message;
    ASSERT_EQ(paths->userColumns().size(), std::size_t(kKeys));
    for (const Column& column : paths->userColumns()) {
        ASSERT_EQ(column.count, 2u);
        ASSERT_EQ(paths->value(column, 0), Value(std::int64_t(std::stoi(column.name))));
        ASSERT_EQ(paths->value(column, 1), Value(std::int64_t(std::stoi(column.name)) + 1));
    }
}

// The memory that a text lies in says nothing about the text.
TEST(Recording, ABufferThatChangesIsAnotherText) {
    Recording recording;
    std::vector<std::string> expected;
    {
        const RecordScope scope(recording, {0, 0});
        std::string buffer;
        buffer.reserve(100);
        recorder().setPathIndex(0);
        recorder().setDepthIndex(1);
        for (const std::size_t size : {0, 1, 2, 3, 4, 7, 8, 9, 15, 16, 17, 40})
            for (std::size_t changed = 0; changed < size; ++changed) {
                buffer.assign(size, 'a');
                buffer[changed] = 'b';
                recorder().addIntersectionData("text", buffer);
                expected.push_back(buffer);
                buffer[changed] = 'c';
                recorder().addIntersectionData("text", buffer);
                expected.push_back(buffer);
            }
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    const Column& text = *paths->find(Scope::vertex, "text").at(0);
    ASSERT_EQ(text.count, expected.size());
    for (Index i = 0; i < text.count; ++i) EXPECT_EQ(paths->value(text, i), Value(expected[i]));
}

// A column that was not asked for changes nothing else.
TEST(Recording, AnEnvironmentHitIsAVertexOfItsOwnWithoutPositions) {
    Recording recording({.columns = {"emission"}});
    {
        const RecordScope scope(recording, {0, 0});
        recorder().setPathIndex(0);
        recorder().setDepthIndex(1);
        recorder().setIntersectionPos(Vec3f{1, 0, 0});
        recorder().setIntersectionPosEnvmap(Vec3f{9, 0, 0});
        recorder().setIntersectionEmission(Color(2.f));
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    ASSERT_EQ(paths->vertexCount(), 2u);
    EXPECT_FALSE(paths->isEnvironment(0));
    EXPECT_TRUE(paths->isEnvironment(1));
    EXPECT_EQ(paths->emission(1), Color(2.f));
    EXPECT_FALSE(paths->position(0));
}

TEST(Recording, OnlyTheColumnsAskedFor) {
    Recording recording({.columns = {"odd", "position"}});
    {
        const RecordScope scope(recording, {0, 0});
        recordPath({0, 0}, 3, 4);
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    EXPECT_EQ(paths->userColumns().size(), 1u);
    EXPECT_EQ(paths->userColumns()[0].name, "odd");
    EXPECT_TRUE(paths->position(0));
    EXPECT_FALSE(paths->origin(0));
    EXPECT_FALSE(paths->estimate(0));
    EXPECT_TRUE(paths->columns().origins.empty());
    EXPECT_TRUE(paths->columns().estimates.empty());
}

TEST(Recording, OwnDataOfACoreQuantitysNameIsAskedForAsData) {
    for (const bool own : {false, true}) {
        Recording recording({.columns = {own ? "data[\"position\"]" : "position"}});
        int computed = 0;
        {
            const RecordScope scope(recording, {0, 0});
            recorder().setPathIndex(0);
            recorder().setDepthIndex(1);
            recorder().setIntersectionPos(Vec3f{1, 2, 3});
            recorder().addIntersectionData("position", [&] { ++computed; return 9.f; });
        }
        auto paths = recording.finish();
        ASSERT_TRUE(paths.ok());
        EXPECT_EQ(paths->userColumns().size(), own ? 1u : 0u);
        EXPECT_EQ(paths->position(0).has_value(), !own);
        EXPECT_EQ(computed, own ? 1 : 0) << "where no data are wanted, none are computed";
    }
}

TEST(Recording, TheBudgetHoldsAndWhatDidNotFitIsCounted) {
    Recording recording({.budgetBytes = 200000});
    {
        const RecordScope scope(recording, {0, 0});
        for (int s = 0; s < 10000; ++s) recordPath({0, 0}, s, 8);
    }
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    const RecordingStats stats = recording.stats();
    EXPECT_LE(stats.bytes, 200000u);
    EXPECT_GT(stats.bytes, 150000u);
    EXPECT_GT(stats.droppedByBudget, 100000u);
    EXPECT_EQ(stats.droppedWithoutPath, 0u);
    EXPECT_EQ(stats.droppedWithoutVertex, 0u);
    EXPECT_GT(paths->pathCount(), 100u) << "what came first is there";
}

TEST(Recording, SourceLinesOnDemand) {
    Recording recording({.locations = true});
    {
        const RecordScope scope(recording, {0, 0});
        recorder().setPathIndex(0);
        recorder().setDepthIndex(0);
        recorder().addIntersectionData("here", 1.f);
    }
    const int line = __LINE__ - 2;
    auto paths = recording.finish();
    ASSERT_TRUE(paths.ok());
    const Column& column = *paths->find(Scope::vertex, "here").at(0);
    ASSERT_EQ(column.locations.size(), 1u);
    const std::string where(paths->text(column.locations[0]));
    EXPECT_NE(where.find("recording_test.cpp:" + std::to_string(line)), std::string::npos) << where;
}

TEST(Recording, TheObserverSeesBeginAndEnd) {
    struct Log : RecordingObserver {
        std::string text;
        void beginPath(Pixel, std::int64_t s) override { text += "P" + std::to_string(s); }
        void endPath(Pixel, std::int64_t s) override { text += "p" + std::to_string(s); }
        void beginVertex(std::int32_t d) override { text += "V" + std::to_string(d); }
        void endVertex(std::int32_t d) override { text += "v" + std::to_string(d); }
    } log;
    Recording recording({.observer = &log});
    {
        const RecordScope scope(recording, {0, 0});
        recorder().setPathIndex(1);
        recorder().setDepthIndex(1);
        recorder().setDepthIndex(2);
        recorder().setDepthIndex(1);
        recorder().setPathIndex(2);
    }
    EXPECT_EQ(log.text, "P1V1v1V2v2V1v1p1P2p2");
}

}  // namespace
}  // namespace emca
