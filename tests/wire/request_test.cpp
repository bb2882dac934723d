// Every kind of request, over a real socket, with a renderer whose answers are known.
#include <algorithm>

#include "served.h"

namespace emca::test {
namespace {

using client::RenderOptions;
using client::RequestObserver;
using client::TraceOptions;

TEST(Requests, InfoSaysWhatRendererAndServerAre) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const auto info = connection->info();
    ASSERT_OK(info);
    EXPECT_EQ(info->renderer, "fake 1.0");
    EXPECT_EQ(info->scene, "hash");
    EXPECT_EQ(info->width, 16u);
    EXPECT_EQ(info->height, 12u);
    EXPECT_EQ(info->samplesPerPixel, 4u);
    EXPECT_EQ(info->seed, 7u);
    EXPECT_EQ(info->triangles, 1u);
    EXPECT_EQ(info->meshes, 1u);
    EXPECT_EQ(info->latestRender, 0u);
    EXPECT_EQ(info->maximumSamplesPerPixel, ServerOptions().maximumSamplesPerPixel);
    const auto& words = info->capabilities;
    EXPECT_NE(std::find(words.begin(), words.end(), "concurrent"), words.end());
}

TEST(Requests, CameraArrivesAsItIs) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const auto camera = connection->camera();
    ASSERT_OK(camera);
    EXPECT_EQ(*camera, served.renderer.camera());
}

TEST(Requests, LargeScenesArriveInChunksAndWhole) {
    Served served;
    served.renderer.scene.clear();
    for (std::uint32_t m = 0; m < 5; ++m) {
        Mesh mesh;
        mesh.name = "mesh " + std::to_string(m);
        mesh.material = m == 3 ? "glass" : "";
        mesh.diffuse = Color(0.1f * static_cast<float>(m));
        mesh.emission = m == 4 ? Color(9) : Color();
        const std::uint32_t n = m == 2 ? 0 : 100000 * m;  // an empty mesh among the others
        for (std::uint32_t i = 0; i < n; ++i) mesh.positions.push_back({float(i), float(m), 0.5f});
        for (std::uint32_t i = 0; i + 2 < n; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
        served.renderer.scene.push_back(std::move(mesh));
    }
    served.start();
    const auto connection = served.connect();
    std::vector<double> progress;
    RequestObserver observer;
    observer.progress = [&](double fraction) { progress.push_back(fraction); };
    const auto meshes = connection->meshes(observer);
    ASSERT_OK(meshes);
    ASSERT_EQ(meshes->size(), served.renderer.scene.size());
    for (std::size_t m = 0; m < meshes->size(); ++m) {
        const Mesh &got = (*meshes)[m], &sent = served.renderer.scene[m];
        EXPECT_EQ(got.name, sent.name);
        EXPECT_EQ(got.material, sent.material);
        EXPECT_EQ(got.diffuse, sent.diffuse);
        EXPECT_EQ(got.emission, sent.emission);
        EXPECT_EQ(got.positions, sent.positions);
        EXPECT_EQ(got.triangles, sent.triangles);
    }
    EXPECT_GT(progress.size(), 2u);
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.back(), 1.0);
}

TEST(Requests, AnEmptySceneIsNoError) {
    Served served;
    served.renderer.scene.clear();
    served.start();
    const auto meshes = served.connect()->meshes();
    ASSERT_OK(meshes);
    EXPECT_TRUE(meshes->empty());
}

TEST(Requests, ASceneWithBadIndicesIsTheRenderersFault) {
    Served served;
    served.renderer.scene[0].triangles.push_back({0, 1, 3});
    served.start();
    const auto connection = served.connect();
    const auto meshes = connection->meshes();
    EXPECT_CODE(meshes, rendererFailed);
    EXPECT_TRUE(connection->camera().ok());
}

TEST(Requests, RenderBringsPixelsSamplesAndVariance) {
    Served served;
    served.start();
    const auto connection = served.connect();
    RenderOptions options;
    options.samplesPerPixel = 3;
    const auto render = connection->render(options);
    ASSERT_OK(render);
    EXPECT_NE(render->id, 0u);
    EXPECT_EQ(render->samplesPerPixel, 3u);
    EXPECT_EQ(render->seed, 7u);
    EXPECT_EQ(render->integrator, "hash");
    const RenderedImage& image = render->image;
    ASSERT_EQ(image.color.width(), 16u);
    ASSERT_EQ(image.color.height(), 12u);
    for (std::uint32_t y = 0; y < 12; ++y) {
        for (std::uint32_t x = 0; x < 16; ++x) {
            const Pixel p{x, y};
            const Color mean = (FakeRenderer::sample(p, 0, 7) + FakeRenderer::sample(p, 1, 7) + FakeRenderer::sample(p, 2, 7)) / 3.f;
            EXPECT_EQ(image.color.color(p), mean);
            EXPECT_EQ(*image.samples.at(p), 3.f);
            EXPECT_EQ(image.variance.color(p), Color(float(x), float(y), 0));
        }
    }
    EXPECT_EQ(connection->info()->latestRender, render->id);
}

TEST(Requests, PreviewTilesAreTheFinalPixels) {
    Served served;
    served.start();
    const auto connection = served.connect();
    Image seen(16, 12);
    std::size_t tiles = 0;
    RequestObserver observer;
    observer.preview = [&](PixelRect rect, std::span<const Color> colors) {
        ++tiles;
        std::size_t i = 0;
        for (std::uint32_t y = rect.y0; y < rect.y1; ++y) {
            for (std::uint32_t x = rect.x0; x < rect.x1; ++x) seen.setColor({x, y}, colors[i++]);
        }
    };
    const auto render = connection->render({}, observer);
    ASSERT_OK(render);
    EXPECT_EQ(tiles, 12u);
    EXPECT_TRUE(std::equal(seen.data(), seen.data() + seen.size(), render->image.color.data()));
}

TEST(Requests, ProgressIsThrottledButArrives) {
    Served served;
    served.renderer.duringImage = [](RequestMonitor& monitor) {
        for (int i = 0; i < 100000; ++i) monitor.progress(0.5);
    };
    served.start();
    const auto connection = served.connect();
    int heard = 0;
    RequestObserver observer;
    observer.progress = [&](double fraction) {
        ++heard;
        EXPECT_GE(fraction, 0);
        EXPECT_LE(fraction, 1);
    };
    const auto render = connection->render({}, observer);
    ASSERT_OK(render);
    EXPECT_GE(heard, 1);
    EXPECT_LE(heard, 2 + static_cast<int>(render->seconds * 20 + 1)) << "at most 20 a second";
}

TEST(Requests, TraceBringsEveryPathWithItsData) {
    Served served;
    served.start();
    const auto trace = served.connect()->tracePixel({5, 6});
    ASSERT_OK(trace);
    EXPECT_EQ(trace->pixels, std::vector<Pixel>({{5, 6}}));
    EXPECT_EQ(trace->samplesPerPixel, 4u);
    EXPECT_EQ(trace->integrator, "hash");
    const PathSet& paths = trace->paths;
    ASSERT_EQ(paths.pathCount(), 4u);
    for (Index path = 0; path < 4; ++path) {
        EXPECT_EQ(paths.sample(path), path);
        EXPECT_EQ(paths.estimate(path), FakeRenderer::sample({5, 6}, path, 7));
        EXPECT_EQ(paths.depth(path), 3);
        EXPECT_EQ(paths.origin(path), (Vec3f{1, 2, 3}));
    }
    const auto names = paths.find(Scope::vertex, "name");
    ASSERT_EQ(names.size(), 1u);
    EXPECT_EQ(std::get<std::string>(paths.value(*names[0], 1)), "vertex 2");
    EXPECT_GT(trace->stats.bytes, 0u);
}

TEST(Requests, PathIndicesMayStartAtOne) {  // hung the published client
    Served served;
    served.renderer.firstSample = 1;
    served.start();
    const auto trace = served.connect()->tracePixel({0, 0});
    ASSERT_OK(trace);
    ASSERT_EQ(trace->paths.pathCount(), 4u);
    EXPECT_EQ(trace->paths.sample(0), 1);
    EXPECT_EQ(trace->paths.sample(3), 4);
}

TEST(Requests, MoreSamplesExtendThePathsAndChangeNone) {  // the published seeds changed every path
    Served served;
    served.start();
    const auto connection = served.connect();
    TraceOptions options;
    options.samplesPerPixel = 2;
    const auto few = connection->tracePixel({3, 3}, options);
    options.samplesPerPixel = 9;
    const auto many = connection->tracePixel({3, 3}, options);
    ASSERT_OK(few);
    ASSERT_OK(many);
    ASSERT_EQ(many->paths.pathCount(), 9u);
    for (Index path = 0; path < 2; ++path) EXPECT_EQ(few->paths.estimate(path), many->paths.estimate(path));
}

TEST(Requests, ListsKeepTheirOrderAndRectanglesReadRowByRow) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const std::vector<Pixel> asked{{9, 9}, {1, 1}, {9, 9}, {15, 0}};
    const auto list = connection->tracePixels(asked);
    ASSERT_OK(list);
    EXPECT_EQ(list->pixels, asked);
    ASSERT_EQ(list->replays.size(), 4u);
    EXPECT_EQ(list->replays[0].replayed, list->replays[2].replayed);
    ASSERT_EQ(list->paths.pathCount(), 3u * 4u) << "a pixel asked for twice is replayed once";
    EXPECT_EQ(list->paths.pixel(0), (Pixel{15, 0}));
    const auto next = list->paths.columns().nextEvents.size();
    EXPECT_EQ(next, 3u * 4u * 3u) << "one shadow test per vertex, not two";

    const auto rect = connection->traceRect({2, 3, 5, 5});
    ASSERT_OK(rect);
    EXPECT_EQ(rect->pixels, std::vector<Pixel>({{2, 3}, {3, 3}, {4, 3}, {2, 4}, {3, 4}, {4, 4}}));
    EXPECT_EQ(rect->paths.pathCount(), 6u * 4u);
}

TEST(Requests, OnlyTheColumnsThatWereAskedForAreRecorded) {
    Served served;
    served.start();
    TraceOptions options;
    options.columns = {"position", "value"};
    const auto trace = served.connect()->tracePixel({1, 1}, options);
    ASSERT_OK(trace);
    const PathColumns& columns = trace->paths.columns();
    EXPECT_EQ(columns.positions.size(), 12u);
    EXPECT_TRUE(columns.nextEvents.empty());
    EXPECT_FALSE(trace->paths.origin(0));
    ASSERT_EQ(columns.columns.size(), 1u);
    EXPECT_EQ(columns.columns[0].name, "value");
    EXPECT_EQ(trace->replays[0].sums, SumCheck::unknown) << "estimates were not recorded";
}

TEST(Requests, ABudgetBoundsTheRecordingAndSaysSo) {
    Served served;
    served.renderer.verticesPerPath = 500;
    served.start();
    TraceOptions options;
    options.samplesPerPixel = 100;
    options.budget = 1 << 20;
    const auto trace = served.connect()->tracePixel({1, 1}, options);
    ASSERT_OK(trace);
    EXPECT_GT(trace->stats.droppedByBudget, 0u);
    EXPECT_LE(trace->stats.bytes, options.budget);
    EXPECT_EQ(trace->replays[0].sums, SumCheck::unknown);
}

TEST(Requests, WhatNoRequestMayHaveIsAnsweredClearly) {
    Served served;
    ServerOptions limits;
    limits.maximumPixelsPerTrace = 100;
    served.start(limits);
    const auto connection = served.connect();
    EXPECT_CODE(connection->tracePixel({16, 0}), pixelOutOfRange);
    EXPECT_CODE(connection->tracePixel({0, 12}), pixelOutOfRange);
    EXPECT_CODE(connection->tracePixel({0xffffffffu, 0xffffffffu}), pixelOutOfRange);
    EXPECT_CODE(connection->traceRect({10, 0, 17, 2}), pixelOutOfRange);
    EXPECT_CODE(connection->traceRect({0, 0, 0xffffffffu, 0xffffffffu}), tooLarge);
    EXPECT_CODE(connection->traceRect({3, 3, 3, 9}), invalidArgument);
    EXPECT_CODE(connection->tracePixels({}), invalidArgument);
    EXPECT_CODE(connection->tracePixels(std::vector<Pixel>(101)), tooLarge);
    TraceOptions options;
    options.samplesPerPixel = 1'000'000'000;
    EXPECT_CODE(connection->tracePixel({1, 1}, options), tooLarge);
    RenderOptions render;
    render.samplesPerPixel = 1'000'000'000;
    EXPECT_CODE(connection->render(render), tooLarge);
    options = {};
    options.against = client::VerdictAgainst::givenColors;
    EXPECT_CODE(connection->tracePixel({1, 1}, options), invalidArgument);
    EXPECT_CODE(connection->askTool("nobody", {}), notSupported);
    EXPECT_CODE(connection->quitServer(), notSupported);
    EXPECT_TRUE(connection->isOpen());
    EXPECT_TRUE(connection->tracePixel({15, 11}).ok()) << "and the last pixel is a good one";
}

TEST(Requests, NoSamplesInRequestAndSceneAreRefused) {
    Served served;
    served.renderer.description.samplesPerPixel = 0;
    served.start();
    const auto connection = served.connect();
    EXPECT_CODE(connection->tracePixel({1, 1}), invalidArgument);
    EXPECT_CODE(connection->render(), invalidArgument);
}

}  // namespace
}  // namespace emca::test
