// Queries that travel with a trace and are evaluated beside the renderer.
#include <algorithm>
#include <cstring>

#include "emca/query/query.h"
#include "served.h"

namespace emca::test {
namespace {

using client::Trace;
using client::TraceOptions;

TraceOptions asking(std::string query) {
    TraceOptions options;
    options.query = std::move(query);
    return options;
}

std::vector<Index> matching(const PathSet& paths, const std::string& text) {
    const auto query = query::Query::parse(text);
    EXPECT_OK(query);
    if (!query) return {};
    const auto matches = query->select(paths);
    EXPECT_OK(matches);
    return matches ? matches->paths : std::vector<Index>();
}

/// The same paths with the same values.
void expectSame(const PathSet& a, const PathSet& b) {
    ASSERT_EQ(a.pathCount(), b.pathCount());
    ASSERT_EQ(a.vertexCount(), b.vertexCount());
    for (Index p = 0; p < a.pathCount(); ++p) {
        EXPECT_EQ(a.pixel(p), b.pixel(p));
        EXPECT_EQ(a.sample(p), b.sample(p));
        EXPECT_EQ(a.estimate(p), b.estimate(p));
    }
    ASSERT_EQ(a.userColumns().size(), b.userColumns().size());
    for (std::size_t c = 0; c < a.userColumns().size(); ++c)
        for (Index v = 0; v < a.vertexCount(); ++v)
            EXPECT_EQ(a.last(a.userColumns()[c], v), b.last(b.userColumns()[c], v));
}

constexpr const char* kQuery = "luminance > 0.5 and any(v.name == \"vertex 2\" and v.value.r < 0.7)";

TEST(Queries, WhatArrivesIsWhatAClientWouldHaveChosen) {
    Served served;
    served.start();
    const auto connection = served.connect();
    TraceOptions options;
    options.samplesPerPixel = 300;
    const auto all = connection->tracePixel({3, 4}, options);
    ASSERT_OK(all);
    const PathSet expected = all->paths.subset(matching(all->paths, kQuery));
    ASSERT_GT(expected.pathCount(), 20u);
    options.query = kQuery;
    const auto some = connection->tracePixel({3, 4}, options);
    ASSERT_OK(some);
    expectSame(some->paths, expected);
    ASSERT_TRUE(some->matches);
    EXPECT_EQ(some->matches->paths, 300u);
    EXPECT_EQ(some->matches->matched, expected.pathCount());
    EXPECT_EQ(some->matches->omitted, 0u);
    EXPECT_EQ(some->replays[0].replayed, all->replays[0].replayed);
    EXPECT_EQ(some->replays[0].sums, SumCheck::unknown) << "some paths are not there";
    EXPECT_FALSE(all->matches);
}

TEST(Queries, CountsAndSumsOfARegionAreThoseOfItsPixels) {
    for (const unsigned threads : {1u, 3u}) {
        Served served;
        served.renderer.description.threads = threads;
        served.start();
        const auto connection = served.connect();
        TraceOptions options = asking(kQuery);
        options.samplesPerPixel = 700;  // two batches for three pixels
        const PixelRect rect{2, 3, 9, 8};
        const auto region = connection->traceRect(rect, options);
        ASSERT_OK(region);
        ASSERT_TRUE(region->matches);
        ASSERT_EQ(region->matches->matchedOfPixel.size(), rect.count());
        options.query.clear();
        std::uint64_t total = 0;
        Index place = 0;
        for (std::size_t i = 0; i < region->pixels.size(); ++i) {
            const auto pixel = connection->tracePixel(region->pixels[i], options);
            ASSERT_OK(pixel);
            const PathSet expected = pixel->paths.subset(matching(pixel->paths, kQuery));
            Color sum;
            for (Index p = 0; p < expected.pathCount(); ++p) {
                sum += *expected.estimate(p);
                ASSERT_LT(place, region->paths.pathCount());
                EXPECT_EQ(region->paths.pixel(place), region->pixels[i]);
                EXPECT_EQ(region->paths.sample(place++), expected.sample(p));
            }
            EXPECT_EQ(region->matches->matchedOfPixel[i], expected.pathCount());
            EXPECT_EQ(region->matches->sumOfPixel[i], sum);
            EXPECT_EQ(region->replays[i].replayed, pixel->replays[0].replayed);
            total += expected.pathCount();
        }
        EXPECT_EQ(region->matches->matched, total);
        EXPECT_EQ(region->matches->paths, 700 * rect.count());
        EXPECT_TRUE(PathSet::make(region->paths.columns()).ok());
    }
}

TEST(Queries, OnlyTheBrightestOrNoneAreKept) {
    Served served;
    served.start();
    const auto connection = served.connect();
    TraceOptions options = asking("luminance > 0.2");
    options.samplesPerPixel = 64;
    const PixelRect image{0, 0, 16, 12};
    const auto all = connection->traceRect(image, options);
    ASSERT_OK(all);
    std::vector<float> expected;
    for (Index p = 0; p < all->paths.pathCount(); ++p) expected.push_back(luminance(*all->paths.estimate(p)));
    ASSERT_GT(expected.size(), 6000u);
    std::sort(expected.rbegin(), expected.rend());
    options.keep = KeepMatches::brightest;
    options.keepCount = 17;
    const auto few = connection->traceRect(image, options);
    ASSERT_OK(few);
    ASSERT_EQ(few->paths.pathCount(), 17u);
    std::vector<float> kept;
    for (Index p = 0; p < 17; ++p) kept.push_back(luminance(*few->paths.estimate(p)));
    std::sort(kept.rbegin(), kept.rend());
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), expected.begin()));
    EXPECT_EQ(few->matches->omitted, expected.size() - 17);
    options.keep = KeepMatches::none;
    const auto none = connection->traceRect(image, options);
    ASSERT_OK(none);
    EXPECT_EQ(none->paths.pathCount(), 0u);
    EXPECT_EQ(none->matches->matched, expected.size());
    EXPECT_EQ(none->matches->omitted, expected.size());
}

TEST(Queries, WhatDoesNotFitIsCountedAndTheSameForAnyThreads) {
    std::vector<Index> kept;
    for (const unsigned threads : {1u, 4u}) {
        Served served;
        served.renderer.description.threads = threads;
        served.start();
        const auto connection = served.connect();
        TraceOptions options = asking("luminance >= 0");
        options.samplesPerPixel = 256;
        options.budget = 8u << 20;
        const auto region = connection->traceRect({0, 0, 16, 12}, options);
        ASSERT_OK(region);
        EXPECT_EQ(region->matches->matched, 256u * 16 * 12);
        EXPECT_GT(region->paths.pathCount(), 1000u);
        EXPECT_EQ(region->matches->omitted, region->matches->matched - region->paths.pathCount());
        EXPECT_GT(region->matches->omitted, 1000u);
        // The first pixels are there whole.
        EXPECT_EQ(region->paths.pixel(0), (Pixel{0, 0}));
        kept.push_back(region->paths.pathCount());
    }
    EXPECT_EQ(kept[0], kept[1]);
}

TEST(Queries, TroubleIsSaidAndNothingDies) {
    Served served;
    served.start();
    const auto connection = served.connect();
    EXPECT_CODE(connection->tracePixel({1, 1}, asking("luminance >")), parseFailed);
    const auto broken = connection->tracePixel({1, 1}, asking("luminance > 1 an depth > 2"));
    ASSERT_FALSE(broken.ok());
    EXPECT_NE(broken.error().message.find("At character 15"), std::string::npos) << broken.error().message;
    EXPECT_CODE(connection->tracePixel({1, 1}, asking("any(v.name > 3)")), parseFailed);
    EXPECT_CODE(connection->tracePixel({1, 1}, asking("luminance")), parseFailed);
    EXPECT_CODE(connection->tracePixel({1, 1}, asking(std::string(1 << 20, '('))), parseFailed);
    EXPECT_CODE(connection->tracePixel({1, 1}, asking("lpe(\"((((.{900}){900}){900}){900})\")")), parseFailed);
    const auto unknown = connection->tracePixel({1, 1}, asking("any(v.nobody > 3) or any(v.value.r > 0.5)"));
    ASSERT_OK(unknown);
    EXPECT_EQ(unknown->matches->missing, std::vector<std::string>{"nobody"});
    served.renderer.duringPixel = [](Pixel pixel, RequestMonitor&) { if (pixel == Pixel{5, 5}) throw std::runtime_error("no light"); };
    EXPECT_CODE(connection->traceRect({0, 0, 16, 12}, asking("luminance > 0")), rendererFailed);
    served.renderer.duringPixel = nullptr;
    EXPECT_OK(connection->tracePixel({1, 1}, asking("luminance > 0")));
}

TEST(Queries, AScanCanBeCancelled) {
    Served served;
    served.start();
    const auto connection = served.connect();
    client::RequestObserver observer;
    observer.cancel = std::make_shared<std::atomic<bool>>(false);
    std::atomic<int> replayed{0};
    served.renderer.duringPixel = [&](Pixel, RequestMonitor& monitor) {
        if (++replayed == 3) *observer.cancel = true;
        // The server learns of it within a moment; a scan that went on would replay all pixels.
        for (int i = 0; i < 2000 && *observer.cancel && !monitor.cancelled(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    TraceOptions options = asking("luminance > 0");
    options.samplesPerPixel = 2000;
    EXPECT_CODE(connection->traceRect({0, 0, 16, 12}, options, observer), cancelled);
    EXPECT_LT(replayed, 16 * 12);
    served.renderer.duringPixel = nullptr;
    EXPECT_OK(connection->tracePixel({1, 1}));
}

TEST(Queries, ManyPixelsMayBeAskedForWithAQueryAlone) {
    ServerOptions options;
    options.maximumPixelsPerTrace = 100;
    Served served(options);
    const auto connection = served.connect();
    EXPECT_CODE(connection->traceRect({0, 0, 16, 12}), tooLarge);
    EXPECT_OK(connection->traceRect({0, 0, 16, 12}, asking("luminance > 2")));
}

}  // namespace
}  // namespace emca::test
