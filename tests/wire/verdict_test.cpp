// What a replay says about itself: exact, close, different, unknown; and whether the recorded parts add up.
#include <cmath>
#include <limits>

#include "served.h"

namespace emca::test {
namespace {

using client::RenderOptions;
using client::Trace;
using client::TraceOptions;
using client::VerdictAgainst;

constexpr Pixel kPixel{5, 6};

RenderOptions withSamples(std::uint32_t samples) {
    RenderOptions options;
    options.samplesPerPixel = samples;
    return options;
}

TEST(Verdict, AReplayOfARenderedPixelIsExact) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const auto render = connection->render(withSamples(64));
    ASSERT_OK(render);
    const auto trace = connection->traceRect({0, 0, 16, 12});
    ASSERT_OK(trace);
    EXPECT_EQ(trace->renderId, render->id);
    EXPECT_EQ(trace->samplesPerPixel, 64u) << "taken from the image, not from the scene";
    for (std::size_t i = 0; i < trace->pixels.size(); ++i) {
        EXPECT_EQ(trace->replays[i].verdict, Verdict::exact);
        EXPECT_EQ(trace->replays[i].sums, SumCheck::matches);
        EXPECT_EQ(trace->replays[i].rendered, render->image.color.color(trace->pixels[i]));
    }
}

TEST(Verdict, WithoutAnImageItIsUnknown) {
    Served served;
    served.start();
    const auto trace = served.connect()->tracePixel(kPixel);
    ASSERT_OK(trace);
    EXPECT_EQ(trace->replays[0].verdict, Verdict::unknown);
    EXPECT_EQ(trace->replays[0].rendered, Color());
    EXPECT_EQ(trace->replays[0].sums, SumCheck::matches) << "needs no image";
    EXPECT_EQ(trace->renderId, 0u);
}

TEST(Verdict, DeviationsAreCloseOrDifferent) {
    Served served;
    served.start();
    const auto connection = served.connect();
    ASSERT_OK(connection->render());
    served.renderer.disturbReplay = [](Pixel, Color c) { return c * 1.00005f; };
    EXPECT_EQ(connection->tracePixel(kPixel)->replays[0].verdict, Verdict::close);
    served.renderer.disturbReplay = [](Pixel, Color c) { return c * 1.01f; };
    const auto different = connection->tracePixel(kPixel);
    EXPECT_EQ(different->replays[0].verdict, Verdict::different);
    EXPECT_EQ(different->replays[0].sums, SumCheck::differs);
}

TEST(Verdict, NanEqualsNan) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    TraceOptions options;
    options.against = VerdictAgainst::givenColors;
    options.colors = {{nan, 1, 2}};
    served.renderer.disturbReplay = [nan](Pixel, Color) { return Color(-nan, 1, 2); };
    const auto trace = connection->tracePixel(kPixel, options);
    ASSERT_OK(trace);
    EXPECT_EQ(trace->replays[0].verdict, Verdict::exact);
    EXPECT_TRUE(std::isnan(trace->replays[0].rendered.r));
    served.renderer.disturbReplay = [](Pixel, Color) { return Color(0, 1, 2); };
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::different);
}

TEST(Verdict, AnOpenedImageCanTakeTheRendersPlace) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const auto replayed = connection->tracePixel(kPixel)->replays[0].replayed;
    TraceOptions options;
    options.against = VerdictAgainst::givenColors;
    options.colors = {replayed, replayed};
    const auto trace = connection->tracePixels({kPixel, {0, 0}}, options);
    ASSERT_OK(trace);
    EXPECT_EQ(trace->replays[0].verdict, Verdict::exact);
    EXPECT_EQ(trace->replays[1].verdict, Verdict::different);
    EXPECT_EQ(trace->replays[1].rendered, replayed);
}

TEST(Verdict, TheLatestImageWithTheSameSettingsCounts) {
    Served served;
    served.start();
    const auto connection = served.connect();
    RenderOptions seeded = withSamples(8);
    seeded.seed = 99;
    seeded.hasSeed = true;
    const auto eight = connection->render(withSamples(8));
    const auto other = connection->render(seeded);
    const auto four = connection->render(withSamples(4));
    ASSERT_OK(four);
    EXPECT_EQ(connection->tracePixel(kPixel)->renderId, four->id) << "nothing said: the newest";
    TraceOptions options;
    options.samplesPerPixel = 8;
    EXPECT_EQ(connection->tracePixel(kPixel, options)->renderId, other->id);
    options.seed = 7;
    options.hasSeed = true;
    const auto trace = connection->tracePixel(kPixel, options);
    EXPECT_EQ(trace->renderId, eight->id);
    EXPECT_EQ(trace->replays[0].verdict, Verdict::exact);
    options.samplesPerPixel = 5;
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::unknown);
}

TEST(Verdict, ANamedImageGivesItsSettings) {
    Served served;
    served.start();
    const auto connection = served.connect();
    RenderOptions seeded = withSamples(8);
    seeded.seed = 99;
    seeded.hasSeed = true;
    const auto first = connection->render(seeded);
    ASSERT_OK(first);
    ASSERT_OK(connection->render());
    TraceOptions options;
    options.against = VerdictAgainst::renderId;
    options.renderId = first->id;
    const auto trace = connection->tracePixel(kPixel, options);
    ASSERT_OK(trace);
    EXPECT_EQ(trace->samplesPerPixel, 8u);
    EXPECT_EQ(trace->seed, 99u);
    EXPECT_EQ(trace->replays[0].verdict, Verdict::exact);
    options.samplesPerPixel = 2;
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::unknown)
        << "other settings than the image's: it would differ for that reason alone";
    options = {};
    options.against = VerdictAgainst::renderId;
    options.renderId = 12345;
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::unknown);
    options.against = VerdictAgainst::nothing;
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::unknown);
}

TEST(Verdict, OldImagesAreForgotten) {
    Served served;
    ServerOptions two;
    two.keptImages = 2;
    served.start(two);
    const auto connection = served.connect();
    const auto first = connection->render();
    ASSERT_OK(first);
    ASSERT_OK(connection->render());
    TraceOptions options;
    options.against = VerdictAgainst::renderId;
    options.renderId = first->id;
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::exact);
    ASSERT_OK(connection->render());
    EXPECT_EQ(connection->tracePixel(kPixel, options)->replays[0].verdict, Verdict::unknown);
}

TEST(Verdict, AForgottenEstimateIsFoundOut) {
    Served served;
    served.start();
    const auto connection = served.connect();
    served.renderer.recordEstimates = false;
    EXPECT_EQ(connection->tracePixel(kPixel)->replays[0].sums, SumCheck::unknown) << "nothing was recorded to sum up";
    served.renderer.recordEstimates = true;
    served.renderer.disturbReplay = [](Pixel, Color c) { return c + Color(0.1f); };
    EXPECT_EQ(connection->tracePixel(kPixel)->replays[0].sums, SumCheck::differs);
}

/// Paths from the light: every one splats on two pixels, in the film's units.
class SplattingRenderer final : public FakeRenderer {
  public:
    Result<std::vector<Color>> renderPixels(const std::vector<Pixel>& pixels, const RenderSettings& settings,
                                            Recording&, RequestMonitor&) override {
        PathRecorder& emca = recorder();
        std::vector<Color> sums(pixels.size());
        for (std::uint32_t i = 0; i < settings.samplesPerPixel; ++i) {
            emca.setPathIndex(i);
            emca.setDepthIndex(0, Subpath::light);
            emca.setIntersectionPos(Vec3f{0, 0, 0});
            for (const Pixel hit : {Pixel{i % 4, 0}, Pixel{i % 4, 1}}) {
                const Color value = Color(0.25f * static_cast<float>(i + 1));
                emca.addSplat(hit, value);
                for (std::size_t p = 0; p < pixels.size(); ++p) {
                    if (pixels[p] == hit) sums[p] += value;
                }
            }
        }
        return sums;
    }
};

TEST(Verdict, SplatsAddUpToo) {
    SplattingRenderer renderer;
    auto server = Server::start(renderer);
    ASSERT_OK(server);
    auto connection = client::Connection::open({"127.0.0.1", (*server)->port()});
    ASSERT_OK(connection);
    TraceOptions options;
    options.samplesPerPixel = 16;
    const auto trace = (*connection)->tracePixels({{1, 0}, {2, 1}}, options);
    ASSERT_OK(trace);
    EXPECT_EQ(trace->replays[0].sums, SumCheck::matches);
    EXPECT_EQ(trace->replays[1].sums, SumCheck::matches);
    EXPECT_EQ(trace->paths.pathCount(), 8u) << "paths that hit neither pixel are not kept";
    EXPECT_EQ(trace->stats.pathsNotKept, 8u);
}

}  // namespace
}  // namespace emca::test
