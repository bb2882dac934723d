// Surface layers over a real socket: asked for, collected while an image renders, kept, fetched.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "layered_renderer.h"
#include "raw_client.h"
#include "served.h"

namespace emca::test {
namespace {

using client::RenderOptions;
using client::RequestObserver;

struct LayersServed {
    LayeredRenderer renderer;
    std::unique_ptr<Server> server;
    void start(ServerOptions options = {}) {
        auto started = Server::start(renderer, std::move(options));
        ASSERT_TRUE(started.ok()) << started.error().message;
        server = std::move(started).value();
    }
    std::unique_ptr<client::Connection> connect() const {
        auto opened = client::Connection::open({"127.0.0.1", server->port()});
        EXPECT_TRUE(opened.ok()) << opened.error().message;
        return opened ? std::move(opened).value() : nullptr;
    }
};

RenderOptions with(std::vector<std::string> layers) {
    RenderOptions options;
    options.layers = std::move(layers);
    return options;
}

constexpr std::uint64_t kPoints = 16 * 12 * 20;

TEST(SurfaceLayers, InfoSaysWhatCanBeCollectedAndWhatWas) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    auto info = connection->info();
    ASSERT_OK(info);
    EXPECT_EQ(info->layers, served.renderer.offered);
    EXPECT_EQ(info->surfaceRender, 0u);
    EXPECT_TRUE(info->collected.empty());
    EXPECT_EQ(info->maximumSurfaceBudget, ServerOptions().maximumSurfaceBudget);
    EXPECT_EQ(std::count(info->capabilities.begin(), info->capabilities.end(), "surface-layers"), 1);
    const auto render = connection->render(with({"hits"}));
    ASSERT_OK(render);
    info = connection->info();
    ASSERT_OK(info);
    EXPECT_EQ(info->surfaceRender, render->id);
    ASSERT_EQ(info->collected.size(), 1u);
    EXPECT_EQ(info->collected[0].description, served.renderer.offered[0]);
    EXPECT_EQ(info->collected[0].samples, kPoints);
    EXPECT_EQ(info->collected[0].total, static_cast<double>(kPoints));
}

TEST(SurfaceLayers, ARendererWithoutLayersSaysSo) {
    Served served;
    served.start();
    const auto connection = served.connect();
    const auto info = connection->info();
    ASSERT_OK(info);
    EXPECT_TRUE(info->layers.empty());
    EXPECT_EQ(std::count(info->capabilities.begin(), info->capabilities.end(), "surface-layers"), 0);
    EXPECT_CODE(connection->render(with({"hits"})), notSupported);
    EXPECT_CODE(connection->surface(), notSupported);
    EXPECT_TRUE(connection->render().ok());
}

TEST(SurfaceLayers, EveryValueArrives) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    const auto meshes = connection->meshes();
    ASSERT_OK(meshes);
    const auto render = connection->render(with({"row sum", "hits", "colors", "column", "hits"}));
    ASSERT_OK(render);
    ASSERT_EQ(render->layers.size(), 4u) << "one asked for twice is collected once";
    EXPECT_EQ(render->layers[0].name, "row sum");
    EXPECT_EQ(render->layerSamples, std::vector<std::uint64_t>(4, kPoints));
    EXPECT_EQ(render->surfaceCounts.points, kPoints);
    EXPECT_EQ(render->surfaceCounts.coarse, 0u);
    EXPECT_GT(render->surfaceFaces, 2u);
    EXPECT_EQ(render->surfaceCounts.budgetBytes, 256u << 20);

    std::vector<double> progress;
    RequestObserver observer;
    observer.progress = [&](double fraction) { progress.push_back(fraction); };
    const auto field = connection->surface(render->id, {}, observer);
    ASSERT_OK(field);
    ASSERT_OK(validate(*field, *meshes));
    EXPECT_EQ(field->counts, render->surfaceCounts);
    EXPECT_EQ(field->faceCount(), render->surfaceFaces);
    ASSERT_EQ(field->meshes.size(), 2u);
    EXPECT_EQ(field->meshes[0].faceCount, 0u) << "nothing landed on the triangle";
    EXPECT_GT(field->meshes[1].faceCount, 2u) << "so many points divide the square";
    const auto refined = refine((*meshes)[1], field->meshes[1].subdivision);
    ASSERT_OK(refined);

    const auto *hits = field->find("hits"), *colors = field->find("colors"), *column = field->find("column"), *rows = field->find("row sum");
    ASSERT_TRUE(hits && colors && column && rows);
    EXPECT_EQ(hits->samples, kPoints);
    EXPECT_EQ(hits->total, static_cast<double>(kPoints));
    EXPECT_EQ(rows->total, 20. * 16 * (11 * 12 / 2));
    double events = 0, rowSum = 0, points = 0;
    for (std::uint32_t f = 0; f < field->meshes[1].faceCount; ++f) {
        const Triangle& t = refined->triangles[f];
        const auto& p = refined->positions;
        const double area = static_cast<double>(length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]))) / 2;
        events += static_cast<double>(field->value(*hits, 1, f)) * area;
        rowSum += static_cast<double>(field->value(*rows, 1, f));
        points += static_cast<double>(field->points[f]);
        EXPECT_EQ(field->value(*column, 1, f), 2.f) << "the mean of equal values";
        EXPECT_EQ(field->value(*colors, 1, f, 0), 0.25f);
        EXPECT_EQ(field->value(*colors, 1, f, 1), 0.5f);
        EXPECT_EQ(field->value(*colors, 1, f, 2), 1.f);
    }
    EXPECT_NEAR(events, static_cast<double>(kPoints), 0.01);
    EXPECT_NEAR(rowSum, rows->total, 1);
    EXPECT_NEAR(points, static_cast<double>(kPoints), 0.01);
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    ASSERT_FALSE(progress.empty());
    EXPECT_EQ(progress.back(), 1.0);
}

TEST(SurfaceLayers, OnlyTheAskedOnesTravelInTheAskedOrder) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    ASSERT_OK(connection->render(with({"hits", "colors", "column"})));
    const auto all = connection->surface();
    ASSERT_OK(all);
    const auto two = connection->surface(0, {"column", "hits"});
    ASSERT_OK(two);
    ASSERT_EQ(two->layers.size(), 2u);
    EXPECT_EQ(two->layers[0].description.name, "column");
    EXPECT_EQ(two->layers[1].description.name, "hits");
    EXPECT_TRUE(std::ranges::equal(two->layers[1].values, all->find("hits")->values));
    EXPECT_TRUE(std::ranges::equal(two->points, all->points));
}

TEST(SurfaceLayers, UnknownNamesGetTheListOfThoseThatThereAre) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    const auto render = connection->render(with({"hits", "nonsense"}));
    EXPECT_CODE(render, invalidArgument);
    for (const auto& layer : served.renderer.offered) EXPECT_NE(render.error().message.find('"' + layer.name + '"'), std::string::npos);
    EXPECT_EQ(served.renderer.layeredRenders, 0);
    EXPECT_CODE(connection->surface(), invalidArgument);  // nothing was rendered with layers yet
    ASSERT_OK(connection->render(with({"hits"})));
    const auto field = connection->surface(0, {"colors"});
    EXPECT_CODE(field, invalidArgument);
    EXPECT_NE(field.error().message.find("\"hits\""), std::string::npos) << field.error().message;
    EXPECT_EQ(field.error().message.find("column"), std::string::npos) << "it was not collected";
}

/// Without layers a render is what it was before there were any: the same call, the same bits.
TEST(SurfaceLayers, WithoutLayersNothingIsDifferent) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    const auto plain = connection->render();
    ASSERT_OK(plain);
    EXPECT_EQ(served.renderer.plainRenders, 1);
    EXPECT_EQ(served.renderer.layeredRenders, 0);
    EXPECT_EQ(served.renderer.meshCalls, 0) << "not even the scene is asked for";
    EXPECT_TRUE(plain->layers.empty());
    EXPECT_EQ(plain->surfaceCounts, SurfaceCounts{});
    const auto layered = connection->render(with({"hits"}));
    ASSERT_OK(layered);
    EXPECT_EQ(served.renderer.plainRenders, 1);
    ASSERT_EQ(plain->image.color.size(), layered->image.color.size());
    EXPECT_TRUE(std::equal(plain->image.color.data(), plain->image.color.data() + plain->image.color.size(), layered->image.color.data()));
    ASSERT_OK(connection->render(with({"hits"})));
    EXPECT_EQ(served.renderer.meshCalls, 1) << "asked for once, then kept";
}

/// The published program throws its heat map away as soon as a pixel is clicked.
TEST(SurfaceLayers, TracesAndPlainRendersLeaveThemAlone) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    const auto render = connection->render(with({"hits", "colors"}));
    ASSERT_OK(render);
    const auto before = connection->surface(render->id);
    ASSERT_OK(before);
    for (std::uint32_t x = 0; x < 8; ++x) ASSERT_OK(connection->tracePixel({x, 3}));
    for (int i = 0; i < 6; ++i) ASSERT_OK(connection->render());
    const auto after = connection->surface(render->id);
    ASSERT_OK(after);
    EXPECT_EQ(after->counts, before->counts) << "no trace added a sample";
    EXPECT_TRUE(std::ranges::equal(after->points, before->points));
    EXPECT_TRUE(std::ranges::equal(after->layers[0].values, before->layers[0].values));
    const auto newest = connection->surface();
    ASSERT_OK(newest);
    EXPECT_EQ(newest->layers.size(), 2u);
}

TEST(SurfaceLayers, TheNewestTwoAreKept) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    const auto first = connection->render(with({"hits"})), second = connection->render(with({"colors"})),
               third = connection->render(with({"column"}));
    ASSERT_OK(first);
    ASSERT_OK(second);
    ASSERT_OK(third);
    const auto forgotten = connection->surface(first->id);
    EXPECT_CODE(forgotten, invalidArgument);
    EXPECT_NE(forgotten.error().message.find(std::to_string(second->id)), std::string::npos) << forgotten.error().message;
    EXPECT_TRUE(connection->surface(second->id, {"colors"}).ok());
    const auto newest = connection->surface();
    ASSERT_OK(newest);
    EXPECT_EQ(newest->layers.at(0).description.name, "column");
}

TEST(SurfaceLayers, LayersOfTheRenderersOwnAreKeptToo) {
    LayersServed served;
    served.renderer.addsItsOwn = true;
    served.start();
    const auto connection = served.connect();
    const auto render = connection->render(with({"hits"}));
    ASSERT_OK(render);
    ASSERT_EQ(render->layers.size(), 2u);
    EXPECT_EQ(render->layers[1].name, "own");
    const auto field = connection->surface(0, {"own"});
    ASSERT_OK(field);
    EXPECT_EQ(field->layers.at(0).total, 2. * kPoints);
}

TEST(SurfaceLayers, BudgetsAreKept) {
    LayersServed served;
    ServerOptions options;
    options.surfaceBudget = 8u << 20;
    options.maximumSurfaceBudget = 16u << 20;
    served.start(options);
    const auto connection = served.connect();
    RenderOptions render = with({"hits"});
    render.surfaceBudget = options.maximumSurfaceBudget + 1;
    EXPECT_CODE(connection->render(render), tooLarge);
    EXPECT_EQ(served.renderer.layeredRenders, 0);
    render.surfaceBudget = options.maximumSurfaceBudget;
    const auto most = connection->render(render);
    ASSERT_OK(most);
    EXPECT_EQ(most->surfaceCounts.budgetBytes, 16u << 20);
    const auto unsaid = connection->render(with({"hits"}));
    ASSERT_OK(unsaid);
    EXPECT_EQ(unsaid->surfaceCounts.budgetBytes, 8u << 20);
    EXPECT_EQ(unsaid->surfaceCounts.points, kPoints);
    render.surfaceBudget = 1;
    const auto tiny = connection->render(render);
    ASSERT_OK(tiny);
    EXPECT_EQ(tiny->surfaceCounts.points, kPoints) << "coarser, but no sample is lost";
    EXPECT_EQ(tiny->layerSamples.at(0), kPoints);
}

TEST(SurfaceLayers, ACancelledRenderLeavesNothing) {
    LayersServed served;
    Gate running;
    std::atomic<bool> block{true};
    served.renderer.duringImage = [&](RequestMonitor& monitor) {
        if (!block) return;
        running.open();
        while (!monitor.cancelled()) std::this_thread::yield();
    };
    served.start();
    const auto connection = served.connect();
    RequestObserver observer;
    observer.cancel = std::make_shared<std::atomic<bool>>(false);
    std::thread canceller([&] {
        running.wait();
        *observer.cancel = true;
    });
    const auto render = connection->render(with({"hits"}), observer);
    canceller.join();
    EXPECT_CODE(render, cancelled);
    block = false;
    EXPECT_CODE(connection->surface(), invalidArgument);
    EXPECT_TRUE(connection->render(with({"hits"})).ok());
    EXPECT_TRUE(connection->surface().ok());
}

/// One client fetches what the other had rendered, while the renderer is busy: no fetch waits for a render.
TEST(SurfaceLayers, TwoClientsShareThemAndNobodyWaits) {
    LayersServed served;
    Gate running, goOn;
    std::atomic<bool> block{false};
    served.renderer.description.concurrent = false;
    served.renderer.duringImage = [&](RequestMonitor&) {
        if (!block) return;
        running.open();
        EXPECT_TRUE(goOn.wait());
    };
    served.start();
    const auto one = served.connect(), two = served.connect();
    const auto render = one->render(with({"hits", "colors"}));
    ASSERT_OK(render);
    block = true;
    std::thread busy([&] { EXPECT_TRUE(one->render(with({"column"})).ok()); });
    EXPECT_TRUE(running.wait());
    std::vector<std::thread> fetchers;
    std::atomic<int> fetched{0};
    for (int i = 0; i < 4; ++i) {
        fetchers.emplace_back([&, i] {
            const auto field = (i % 2 ? one : two)->surface(render->id, i < 2 ? std::vector<std::string>{} : std::vector<std::string>{"colors"});
            EXPECT_TRUE(field.ok()) << field.error().message;
            if (field && field->counts.points == kPoints) ++fetched;
        });
    }
    for (auto& fetcher : fetchers) fetcher.join();
    EXPECT_EQ(fetched, 4) << "while the render still runs";
    goOn.open();
    busy.join();
}

TEST(SurfaceLayers, ChunksHaveTheWantedSize) {
    LayersServed served;
    served.renderer.pointsPerPixel = 2000;
    served.start();
    const auto connection = served.connect();
    ASSERT_OK(connection->render(with({"hits", "colors", "column", "row sum"})));
    const auto whole = connection->surface();
    ASSERT_OK(whole);
    RawClient raw(served.server->port());
    ASSERT_TRUE(raw.isWelcome());
    protocol::SurfaceRequest request;
    request.maximumChunkBytes = 4096;
    raw.send(3, request);
    ASSERT_TRUE(raw.receives<protocol::SurfaceResult>());
    std::size_t chunks = 0, floats = 0, bits = 0;
    for (bool last = false; !last;) {
        const auto message = raw.receive();
        ASSERT_TRUE(message);
        const auto* chunk = std::get_if<protocol::SurfaceChunk>(&message->body);
        if (!chunk) continue;
        const auto frame = protocol::encode(*message);
        EXPECT_LE(frame->size(), 4096u + 512u);
        for (const auto& part : chunk->arrays) floats += part.values.size();
        for (const auto& part : chunk->meshes) bits += part.bits.size();
        last = chunk->last;
        ++chunks;
    }
    EXPECT_GT(chunks, 3u);
    EXPECT_EQ(floats, whole->faceCount() * 7) << "points, density, colour, mean, sum";
    EXPECT_EQ(bits, whole->meshes[1].subdivision.bits.size());
}

TEST(SurfaceLayers, HostileNamesAreRefused) {
    LayersServed served;
    served.start();
    const auto connection = served.connect();
    EXPECT_CODE(connection->render(with(std::vector<std::string>(5000, "hits"))), tooLarge);
    ASSERT_OK(connection->render(with({"hits"})));
    EXPECT_CODE(connection->surface(0, std::vector<std::string>(5000, "hits")), tooLarge);
    const auto longName = connection->surface(0, {std::string(1u << 20, 'x')});
    EXPECT_CODE(longName, invalidArgument);
    EXPECT_LT(longName.error().message.size(), 500u);
    EXPECT_TRUE(connection->surface().ok());
}

TEST(SurfaceLayers, ARendererThatAnnouncesNonsenseIsNotServed) {
    for (const auto& wrong : {std::vector<LayerDescription>{{"a", LayerKind::sum, "", ""}, {"a", LayerKind::mean, "", ""}},
                              std::vector<LayerDescription>{{"", LayerKind::sum, "", ""}},
                              std::vector<LayerDescription>{{"a", static_cast<LayerKind>(9), "", ""}}}) {
        LayeredRenderer renderer;
        renderer.offered = wrong;
        EXPECT_CODE(Server::start(renderer), rendererFailed);
    }
}

/// Announces layers, but does not implement their collection: the default says so.
TEST(SurfaceLayers, TheDefaultRefuses) {
    struct Announcing : FakeRenderer {
        std::vector<LayerDescription> surfaceLayers() const override { return {{"hits", LayerKind::sum, "", ""}}; }
    } renderer;
    auto server = Server::start(renderer);
    ASSERT_OK(server);
    const auto connection = client::Connection::open({"127.0.0.1", (*server)->port()});
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->render(with({"hits"})), notSupported);
    EXPECT_TRUE((*connection)->render().ok());
}

}  // namespace
}  // namespace emca::test
