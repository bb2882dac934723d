// A region that is traced without a query: replayed by as many threads as the renderer allows, and yet the same.
#include <algorithm>

#include "emca/protocol/codec.h"
#include "emca/recorder/handles.h"
#include "served.h"

namespace emca::test {
namespace {

using client::Trace;
using client::TraceOptions;

/// Texts and further columns that not every pixel has, so that threads meet them in any order; some paths through handles.
class TalkingRenderer final : public FakeRenderer {
  public:
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording, RequestMonitor& monitor) override {
        auto value = FakeRenderer::renderPixel(pixel, settings, recording, monitor);
        recorder().addPathData("place", "pixel " + std::to_string((pixel.x * 7 + pixel.y * 3) % 11));
        if (pixel.x % 3 == 0) recorder().addPathData("third", static_cast<std::int32_t>(pixel.y));
        recording.path(pixel, settings.samplesPerPixel).finalEstimate(Color(0.f));
        recording.path(pixel, 0).add("late", "by handle " + std::to_string(pixel.y));
        return value;
    }
};

struct Region {
    explicit Region(unsigned threads, bool concurrent = true) {
        renderer.description.threads = threads;
        renderer.description.concurrent = concurrent;
        auto started = Server::start(renderer, {});
        EXPECT_OK(started);
        server = std::move(started).value();
        connection = std::move(client::Connection::open({"127.0.0.1", server->port()}, {})).value();
    }
    TalkingRenderer renderer;
    std::unique_ptr<Server> server;
    std::unique_ptr<client::Connection> connection;
};

/// Everything that arrived of paths and replays, as bytes.
std::vector<std::byte> bytesOf(const Trace& trace) {
    protocol::TraceResult result;
    result.paths = trace.paths;
    result.pixels = trace.pixels;
    result.replays = trace.replays;
    result.stats = trace.stats;
    result.stats.bytes = 0;   // of memory, a page more or less for each thread
    const auto frame = protocol::encode({1, result});
    EXPECT_OK(frame);
    return frame ? std::vector<std::byte>(frame->begin(), frame->end()) : std::vector<std::byte>();
}

TEST(Regions, AreTheSameBitByBitForAnyNumberOfThreads) {
    Region one(1), several(4);
    TraceOptions options;
    options.samplesPerPixel = 100;
    const std::vector<Pixel> list{{9, 9}, {1, 2}, {15, 11}, {1, 2}, {0, 0}, {3, 3}, {4, 3}, {5, 3}, {6, 7}, {7, 7}};
    for (const bool locations : {false, true}) {
        options.locations = locations;
        const auto a = one.connection->traceRect({0, 0, 16, 12}, options), b = several.connection->traceRect({0, 0, 16, 12}, options);
        ASSERT_OK(a);
        ASSERT_OK(b);
        EXPECT_EQ(a->paths.pathCount(), 16u * 12 * 101);
        EXPECT_EQ(bytesOf(*a), bytesOf(*b));
        const auto c = one.connection->tracePixels(list, options), d = several.connection->tracePixels(list, options);
        ASSERT_OK(c);
        ASSERT_OK(d);
        EXPECT_EQ(bytesOf(*c), bytesOf(*d));
    }
}

/// The renderer is in several pixels at once if it says that it can, and else never.
TEST(Regions, AreReplayedBySeveralThreads) {
    for (const bool concurrent : {true, false}) {
        Region region(3, concurrent);
        Gate together;
        std::atomic<int> waiting{0};
        if (concurrent)
            region.renderer.duringPixel = [&](Pixel, RequestMonitor&) {
                if (++waiting >= 3) together.open();
                EXPECT_TRUE(together.wait());
            };
        TraceOptions options;
        options.samplesPerPixel = 512;
        ASSERT_OK(region.connection->traceRect({0, 0, 6, 6}, options));
        EXPECT_EQ(region.renderer.mostAtOnce, concurrent ? 3 : 1);
    }
}

/// What does not fit: the first pixels are kept, as by one thread.
TEST(Regions, OfMoreThanTheBudgetAreTheSameToo) {
    Region one(1), several(4);
    TraceOptions options;
    options.samplesPerPixel = 256;
    options.budget = 3u << 20;
    const auto a = one.connection->traceRect({0, 0, 16, 12}, options), b = several.connection->traceRect({0, 0, 16, 12}, options);
    ASSERT_OK(a);
    ASSERT_OK(b);
    EXPECT_GT(a->stats.droppedByBudget, 1000u);
    EXPECT_EQ(bytesOf(*a), bytesOf(*b));
}

TEST(Regions, EndWithTheFirstErrorOrAsSoonAsTheyAreCancelled) {
    Region region(4);
    TraceOptions options;
    options.samplesPerPixel = 512;
    region.renderer.duringPixel = [](Pixel pixel, RequestMonitor&) {
        if (pixel == Pixel{3, 2}) throw std::runtime_error("no light");
    };
    const auto failed = region.connection->traceRect({0, 0, 16, 12}, options);
    EXPECT_CODE(failed, rendererFailed);
    EXPECT_NE(failed.error().message.find("no light"), std::string::npos) << failed.error().message;

    std::atomic<int> seen{0};
    const auto cancel = std::make_shared<std::atomic<bool>>(false);
    region.renderer.duringPixel = [&](Pixel, RequestMonitor& monitor) {
        ++seen;
        *cancel = true;
        while (!monitor.cancelled()) std::this_thread::yield();
    };
    client::RequestObserver observer;
    observer.cancel = cancel;
    const auto given = region.connection->traceRect({0, 0, 16, 12}, options, observer);
    EXPECT_CODE(given, cancelled);
    region.renderer.duringPixel = nullptr;
    ASSERT_OK(region.connection->traceRect({0, 0, 4, 4}, options)) << "and the server lives";
    EXPECT_LE(seen, 4);
}

}  // namespace
}  // namespace emca::test
