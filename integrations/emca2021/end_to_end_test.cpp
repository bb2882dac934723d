// From a published server through the bridge to what a person sees: our client and our command line.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

#include "bridge_renderer.h"
#include "emca/client/connection.h"
#include "emca/imageio/imageio.h"
#include "emca/server/server.h"
#include "heat_map.h"
#include "nlohmann/json.hpp"
#include "process.h"
#include "published_for_tests.h"

namespace emca::bridge {
namespace {

namespace fs = std::filesystem;
using namespace test;
using emca::test::run;
using emca::test::ServingProcess;
using std::chrono::milliseconds;

constexpr std::uint32_t kWidth = 6, kHeight = 5, kSamples = 6;

/// The image that fits examplePaths(): means over kSamples, as a film in double precision computes them.
Image exampleImage(std::uint32_t samples) {
    Image image(kWidth, kHeight);
    for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            double sum[3] = {};
            for (const PublishedPath& path : examplePaths({x, y}, samples)) {
                if (!path.estimate) continue;
                sum[0] += double(path.estimate->r), sum[1] += double(path.estimate->g), sum[2] += double(path.estimate->b);
            }
            image.setColor({x, y}, {float(sum[0] / samples), float(sum[1] / samples), float(sum[2] / samples)});
        }
    return image;
}

class EndToEnd : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "emca-bridge-XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
        show = exampleShow();
        show.imagePath = (folder / "out.pfm").string();
        ASSERT_TRUE(imageio::write(folder / "out.pfm", exampleImage(kSamples)).ok());
    }
    void TearDown() override {
        connection.reset();
        server.reset();
        renderer.reset();
        published.reset();
        there.reset();
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }

    /// Errors: those of BridgeRenderer::make.
    Result<void> bridge(BridgeOptions options = {kWidth, kHeight, FieldOfViewAxis::automatic, {}, {}}) {
        there = std::make_unique<PublishedServerForTests>(show);
        PublishedServerOptions to;
        to.port = there->port();
        auto opened = PublishedServer::open(to);
        if (!opened) return opened.error();
        published = std::move(opened).value();
        options.log = [this](const std::string& remark) { remarks += remark + "\n"; };
        auto made = BridgeRenderer::make(*published, options);
        if (!made) return made.error();
        renderer = std::move(made).value();
        return {};
    }
    void serve() {
        const auto bridged = bridge();
        ASSERT_TRUE(bridged.ok()) << bridged.error().message;
        auto started = Server::start(*renderer);
        ASSERT_TRUE(started.ok()) << started.error().message;
        server = std::move(started).value();
        auto connected = client::Connection::open({"127.0.0.1", server->port()});
        ASSERT_TRUE(connected.ok()) << connected.error().message;
        connection = std::move(connected).value();
    }

    fs::path folder;
    Show show;
    std::string remarks;
    std::unique_ptr<PublishedServerForTests> there;
    std::unique_ptr<PublishedServer> published;
    std::unique_ptr<BridgeRenderer> renderer;
    std::unique_ptr<Server> server;
    std::unique_ptr<client::Connection> connection;
};

/// All that a path says, in the terms of the test's server; order of user data aside.
void expectSame(const PathSet& paths, Index index, const PublishedPath& sent) {
    SCOPED_TRACE("sample " + std::to_string(sent.sample));
    EXPECT_EQ(paths.sample(index), std::int64_t(sent.sample));
    EXPECT_EQ(paths.origin(index), std::optional(sent.origin));
    const auto opaque = [](const std::optional<ColorA>& c) { return c ? std::optional(Color(c->r, c->g, c->b)) : std::nullopt; };
    EXPECT_EQ(paths.estimate(index), opaque(sent.estimate));
    const auto expectData = [&](Scope scope, Index owner, const PublishedData& data) {
        std::size_t found = 0;
        for (const auto& [key, value] : data) {
            for (const Column* column : paths.find(scope, key)) {
                if (column->type != typeOf(value)) continue;
                EXPECT_EQ(paths.last(*column, owner), std::optional(value)) << key;
                ++found;
            }
        }
        EXPECT_EQ(found, data.size());
    };
    expectData(Scope::path, index, sent.data);
    ASSERT_EQ(paths.vertices(index).size(), sent.intersections.size());
    for (std::size_t i = 0; i < sent.intersections.size(); ++i) {
        const PublishedIntersection& at = sent.intersections[i];
        const Index vertex = paths.vertices(index).first + static_cast<Index>(i);
        EXPECT_EQ(paths.depthIndex(vertex), std::int32_t(at.depth));
        EXPECT_EQ(paths.position(vertex), at.position);
        EXPECT_EQ(paths.vertexEstimate(vertex), opaque(at.estimate));
        EXPECT_EQ(paths.emission(vertex), opaque(at.emission));
        ASSERT_EQ(paths.nextEvents(vertex).size(), at.nextEvent ? 1u : 0u);
        if (at.nextEvent) {
            EXPECT_EQ(paths.nextEvent(paths.nextEvents(vertex).first).position, at.nextEvent->position);
            EXPECT_EQ(paths.nextEvent(paths.nextEvents(vertex).first).visible, at.nextEvent->visible ? 1u : 0u);
        }
        expectData(Scope::vertex, vertex, at.data);
    }
}

TEST_F(EndToEnd, WhatThePublishedServerSaysArrivesAtOurClient) {
    serve();
    const auto info = connection->info();
    ASSERT_TRUE(info.ok());
    EXPECT_EQ(info->renderer, "in-test renderer (published EMCA, through the bridge)");
    EXPECT_EQ(info->scene, "two triangles");
    EXPECT_EQ(info->samplesPerPixel, kSamples);
    EXPECT_EQ(info->width, kWidth);
    for (const char* plugin : {"published-plugin-17", "published-plugin--3"})
        EXPECT_NE(std::find(info->capabilities.begin(), info->capabilities.end(), plugin), info->capabilities.end());
    const auto camera = connection->camera();
    ASSERT_TRUE(camera.ok());
    EXPECT_EQ(camera->position, (Vec3f{0, 0, 5}));
    EXPECT_EQ(camera->verticalFieldOfView, 40.f);
    const auto meshes = connection->meshes();
    ASSERT_TRUE(meshes.ok());
    ASSERT_EQ(meshes->size(), 2u);
    EXPECT_EQ((*meshes)[0].positions, show.scene.shapes[0].positions);
    EXPECT_EQ((*meshes)[0].diffuse, Color(0.8f, 0.4f, 0.2f));

    const auto trace = connection->tracePixel({3, 4}, {.samplesPerPixel = kSamples});
    ASSERT_TRUE(trace.ok()) << trace.error().message;
    const auto sent = examplePaths({3, 4}, kSamples);
    ASSERT_EQ(trace->paths.pathCount(), sent.size());
    for (Index i = 0; i < sent.size(); ++i) expectSame(trace->paths, i, sent[i]);
    // What has no place of its own in ours.
    const auto alpha = trace->paths.find(Scope::vertex, "alpha of the emission");
    ASSERT_EQ(alpha.size(), 1u);
    EXPECT_EQ(std::get<float>(trace->paths.value(*alpha[0], 0)), 0.5f);
    EXPECT_TRUE(trace->paths.find(Scope::path, "remark of the bridge").empty());
    EXPECT_EQ(there->pixels().back(), (std::array<std::uint32_t, 3>{3, 4, kSamples}));
}

TEST_F(EndToEnd, ImagesAreReadFromTheServersDiskAndReplaysAreJudgedByThem) {
    serve();
    const auto render = connection->render({.samplesPerPixel = kSamples});
    ASSERT_TRUE(render.ok()) << render.error().message;
    const Image expected = exampleImage(kSamples);
    for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) EXPECT_EQ(render->image.color.color({x, y}), expected.color({x, y}));
    const auto rect = connection->traceRect({0, 0, kWidth, kHeight});
    ASSERT_TRUE(rect.ok()) << rect.error().message;
    for (const Replay& replay : rect->replays) {
        EXPECT_EQ(replay.verdict, Verdict::exact);
        EXPECT_EQ(replay.sums, SumCheck::matches);
    }
    EXPECT_EQ(connection->render({.integrator = "bdpt"}).error().code, ErrorCode::invalidArgument);
    EXPECT_EQ(connection->render({.seed = 5, .hasSeed = true}).error().code, ErrorCode::invalidArgument);

    // The renderer writes 16 bits a value: exact still means exact.
    Image half = expected;
    for (std::size_t i = 0; i < half.size(); ++i) half.data()[i] = std::ldexp(std::nearbyint(std::ldexp(half.data()[i], 10 - std::ilogb(half.data()[i]))), std::ilogb(half.data()[i]) - 10);
    ASSERT_TRUE(imageio::write(folder / "out.pfm", half).ok());
    ASSERT_TRUE(connection->render({.samplesPerPixel = kSamples}).ok());
    const auto again = connection->tracePixel({2, 2});
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->replays[0].verdict, Verdict::exact);

    // And a renderer that does not render the same twice is found out.
    half.setColor({2, 2}, {7, 7, 7});
    ASSERT_TRUE(imageio::write(folder / "out.pfm", half).ok());
    ASSERT_TRUE(connection->render({.samplesPerPixel = kSamples}).ok());
    EXPECT_EQ(connection->tracePixel({2, 2})->replays[0].verdict, Verdict::different);

    ASSERT_TRUE(imageio::write(folder / "out.pfm", Image(3, 3)).ok());
    const auto wrongSize = connection->render();
    ASSERT_FALSE(wrongSize.ok());
    EXPECT_NE(wrongSize.error().message.find("3 x 3 pixels instead of 6 x 5"), std::string::npos) << wrongSize.error().message;
    fs::remove(folder / "out.pfm");
    const auto gone = connection->render();
    ASSERT_FALSE(gone.ok());
    EXPECT_NE(gone.error().message.find("--image-folder"), std::string::npos) << gone.error().message;
    EXPECT_TRUE(connection->tracePixel({0, 0}).ok()) << "the rest still works";
}

TEST_F(EndToEnd, HeatMapsAreLayersOnTheSceneAsItWasBeforeTheRender) {
    serve();
    const auto info = connection->info();
    ASSERT_EQ(info->layers.size(), 2u);
    const auto render = connection->render({.samplesPerPixel = 3, .layers = {heatMapNumbers().name}});
    ASSERT_TRUE(render.ok()) << render.error().message;
    const auto field = connection->surface(render->id);
    ASSERT_TRUE(field.ok()) << field.error().message;
    ASSERT_EQ(field->layers.size(), 1u);
    EXPECT_EQ(field->layers[0].description, heatMapNumbers());
    ASSERT_EQ(field->faceCount(), 8u);
    std::vector<float> values(field->layers[0].values.begin(), field->layers[0].values.end());
    // Pre-order: the first triangle's four, the one in the middle divided; then the second triangle.
    EXPECT_EQ(values, (std::vector<float>{2, 3, luminance({1, 2, 3}), 5, 6, 7, 8, 1}));
    EXPECT_EQ(connection->meshes()->at(0).triangles.size(), 2u) << "the server sends its divided one by now";
    EXPECT_NE(remarks.find("Heat map \"samples\" with 8 faces"), std::string::npos) << remarks;
}

TEST_F(EndToEnd, FaceColoursOfTheSceneAreALayerAndNoHeatMapIsSaid) {
    show.heatMap.reset();
    show.scene.shapes[0].faceColors = {{1, 0, 0}, {0, 1, 0}};
    serve();
    auto render = connection->render({.samplesPerPixel = 3, .layers = {heatMapColors().name}});
    ASSERT_TRUE(render.ok()) << render.error().message;
    const auto field = connection->surface(render->id);
    ASSERT_EQ(field->faceCount(), 2u);
    EXPECT_EQ(field->value(field->layers[0], 0, 1, 1), 1.f);
    connection.reset();
    server.reset();
    show.scene.shapes[0].faceColors.clear();
    serve();
    render = connection->render({.samplesPerPixel = 3, .layers = {heatMapColors().name}});
    ASSERT_TRUE(render.ok()) << render.error().message;
    EXPECT_EQ(connection->surface(render->id)->faceCount(), 0u);
    EXPECT_NE(remarks.find("the published server sent none"), std::string::npos) << remarks;
}

TEST_F(EndToEnd, OnePathTooManyIsSaidInTheLogAndOnTheFirstPath) {
    show.tooMany = 1;
    serve();
    const auto trace = connection->tracePixel({3, 4}, {.samplesPerPixel = kSamples});
    ASSERT_TRUE(trace.ok()) << trace.error().message;
    EXPECT_EQ(trace->paths.pathCount(), 5u);
    const auto remark = trace->paths.find(Scope::path, "remark of the bridge");
    ASSERT_EQ(remark.size(), 1u);
    EXPECT_NE(std::get<std::string>(trace->paths.value(*remark[0], 0)).find("announced 6 paths and sent 5"), std::string::npos);
    EXPECT_NE(remarks.find("announced 6 paths and sent 5"), std::string::npos);
}

TEST_F(EndToEnd, AnIndexThatComesTwiceIsTwoPartsOfASample) {
    show.paths = [](Pixel, std::uint32_t) {
        PublishedPath a;
        a.sample = 7;
        a.depth = kNoDepth;
        a.estimate = ColorA{1, 1, 1, 1};
        PublishedPath b = a;
        b.estimate = ColorA{2, 2, 2, 0.25f};
        b.depth = 9;
        return std::vector{a, b};
    };
    serve();
    const auto trace = connection->tracePixel({0, 0}, {.samplesPerPixel = 2});
    ASSERT_TRUE(trace.ok());
    ASSERT_EQ(trace->paths.pathCount(), 2u);
    EXPECT_EQ(trace->paths.part(1), 1);
    EXPECT_EQ(trace->paths.estimate(1), Color(2.f));
    EXPECT_EQ(std::get<std::int64_t>(trace->paths.value(*trace->paths.find(Scope::path, "published depth").at(0), 0)), 9);
    EXPECT_EQ(std::get<float>(trace->paths.value(*trace->paths.find(Scope::path, "alpha of the final estimate").at(0), 0)), 0.25f);
}

TEST_F(EndToEnd, TheImagesSizeIsFoundByRenderingItOnce) {
    const auto bridged = bridge({});
    ASSERT_TRUE(bridged.ok()) << bridged.error().message;
    EXPECT_EQ(renderer->info().width, kWidth);
    EXPECT_EQ(renderer->info().height, kHeight);
    EXPECT_EQ(renderer->meshes()[0].triangles.size(), 2u) << "the scene was asked for first";
    EXPECT_EQ(there->requests(), (std::vector<std::int16_t>{MessageId::requestCamera, MessageId::requestScene, MessageId::requestImage}));
    renderer.reset();
    published.reset();
    fs::remove(folder / "out.pfm");
    const auto failed = bridge({});
    ASSERT_FALSE(failed.ok());
    EXPECT_NE(failed.error().message.find("give --size WIDTHxHEIGHT"), std::string::npos) << failed.error().message;
}

TEST_F(EndToEnd, ThePublishedServerMayVanishAndComeBack) {
    serve();
    const std::uint16_t port = there->port();
    there.reset();
    const auto alone = connection->tracePixel({0, 0});
    ASSERT_FALSE(alone.ok());
    EXPECT_EQ(alone.error().code, ErrorCode::connectionFailed);
    EXPECT_NE(alone.error().message.find(std::to_string(port)), std::string::npos) << alone.error().message;
    EXPECT_TRUE(connection->info().ok()) << "the bridge still stands";
}

// The programs.

nlohmann::json json(const std::vector<std::string>& command) {
    const auto outcome = run(command);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
}

TEST_F(EndToEnd, TheCommandLineAsksThroughTheProgram) {
    there = std::make_unique<PublishedServerForTests>(show);
    const fs::path elsewhere = folder / "share";
    fs::create_directory(elsewhere);
    fs::rename(folder / "out.pfm", elsewhere / "out.pfm");
    {
        ServingProcess serving({EMCA_BRIDGE, "127.0.0.1:" + std::to_string(there->port()), "--serve", "0", "--size", "6x5", "--image-folder",
                                folder.string() + "=" + elsewhere.string()});
        ASSERT_FALSE(serving.address().empty());
        const auto pixel = json({EMCA_CLI, "pixel", serving.address(), "3", "4", "--json"});
        ASSERT_EQ(pixel["paths"].size(), 5u);
        EXPECT_EQ(pixel["paths"][0]["data"]["name"], "sample 0");
        EXPECT_EQ(pixel["paths"][0]["vertices"][0]["data"]["weight"], nlohmann::json::parse("[1.0, 0.5, 0.25, 0.75]"));
        EXPECT_EQ(pixel["replay"]["verdict"], "unknown");
        const auto rendered = run({EMCA_CLI, "render", serving.address(), "-o", (folder / "seen.exr").string(), "--layers", heatMapColors().name + "," + heatMapNumbers().name});
        EXPECT_EQ(rendered.exitCode, 0) << rendered.err;
        EXPECT_EQ(imageio::read(folder / "seen.exr")->color({2, 2}), exampleImage(kSamples).color({2, 2}));
        EXPECT_EQ(json({EMCA_CLI, "pixel", serving.address(), "3", "4", "--json"})["replay"]["verdict"], "exact");
    }
}

TEST_F(EndToEnd, AClientMayEndTheBridgeAndWithItThePublishedServerIfBothAreAskedFor) {
    for (const bool quits : {false, true}) {
        there = std::make_unique<PublishedServerForTests>(show);
        std::vector<std::string> command{EMCA_BRIDGE, std::to_string(there->port()), "--serve", "0", "--size", "6x5", "--allow-quit"};
        if (quits) command.emplace_back("--quit-server");
        const ServingProcess serving(command);
        const auto address = client::Address::parse(serving.address());
        ASSERT_TRUE(address.ok());
        const auto client = client::Connection::open(*address);
        ASSERT_TRUE(client.ok()) << client.error().message;
        EXPECT_TRUE((*client)->quitServer().ok());
        while (serving.alive()) std::this_thread::sleep_for(milliseconds(5));  // the test's own limit ends what hangs
        EXPECT_EQ(there->goodbyes(), 1) << "it took its leave";
        EXPECT_EQ(there->quit(), quits);
    }
}

TEST_F(EndToEnd, TheProgramSaysWhatIsWrongAndWithWhichCode) {
    there = std::make_unique<PublishedServerForTests>(show);
    const std::string address = "127.0.0.1:" + std::to_string(there->port());
    const auto usage = run({EMCA_BRIDGE, address});
    EXPECT_EQ(usage.exitCode, 2);
    fs::remove(folder / "out.pfm");
    const auto input = run({EMCA_BRIDGE, address, "--serve", "0"});
    EXPECT_EQ(input.exitCode, 3);
    EXPECT_NE(input.err.find("--size"), std::string::npos) << input.err;
    there.reset();
    const auto nobody = run({EMCA_BRIDGE, address, "--serve", "0"});
    EXPECT_EQ(nobody.exitCode, 4);
    EXPECT_NE(nobody.err.find("No published EMCA server answers at " + address), std::string::npos) << nobody.err;
}

/// What docs/integrations/emca2021.md tells to type is understood.
TEST(Page, ItsCommandsAreOnesThatTheProgramHas) {
    std::ifstream page(fs::path(EMCA_SOURCE_DIR) / "docs/integrations/emca2021.md");
    const std::string help = run({EMCA_BRIDGE, "--help"}).out;
    int commands = 0;
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("$ ", 0) != 0 || line.find("emca-bridge ") == std::string::npos) continue;
        ++commands;
        const std::regex option(R"(\s(--[a-z-]+))");
        for (std::sregex_iterator it(line.begin(), line.end(), option), end; it != end; ++it) {
            EXPECT_NE(help.find((*it)[1].str() + " "), std::string::npos) << line;
        }
    }
    EXPECT_GE(commands, 2);
    // And every option that it has is told of.
    std::ifstream again(fs::path(EMCA_SOURCE_DIR) / "docs/integrations/emca2021.md");
    std::stringstream text;
    text << again.rdbuf();
    const std::regex option(R"(--[a-z-]+)");
    for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it) {
        if (it->str() != "--help") {
            EXPECT_NE(text.str().find("`" + it->str()), std::string::npos) << it->str();
        }
    }
}

}  // namespace
}  // namespace emca::bridge
