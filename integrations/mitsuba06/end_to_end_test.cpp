#include <gtest/gtest.h>
#include <process.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <thread>

#include "emca/client/connection.h"
#include "emca/imageio/imageio.h"

// The person's own Mitsuba with these plugins, as in docs/integrations/mitsuba06.md.
namespace emca::mitsuba06 {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> mitsuba(const fs::path& image, const std::string& option) {
    return {EMCA_MITSUBA06_PROGRAM, "-q", "-a", EMCA_MITSUBA06_PLUGINS, "-D", option, "-o", image.string(),
            EMCA_SOURCE_DIR "/integrations/mitsuba06/testing/scene.xml"};
}

bool sameBits(const Image& a, const Image& b) {
    return a.width() == b.width() && a.height() == b.height() && a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class Mitsuba06 : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        fs::create_directories(EMCA_WORK_DIR);
        image_ = fs::path(EMCA_WORK_DIR) / (std::string(GetParam()) + ".exr");
        fs::remove(image_);
        server_ = std::make_unique<test::ServingProcess>(mitsuba(image_, std::string("integrator=") + GetParam()));
        ASSERT_FALSE(server_->address().empty());
        auto connection =
            client::Connection::open({.host = "127.0.0.1", .port = static_cast<std::uint16_t>(server_->port())});
        ASSERT_TRUE(connection) << connection.error().message;
        connection_ = std::move(*connection);
    }

    Image render(client::RenderOptions options = {}) {
        const auto render = connection_->render(options);
        EXPECT_TRUE(render) << render.error().message;
        return render ? render->image.color : Image();
    }

    std::vector<Pixel> somePixels() const {
        std::vector<Pixel> pixels;
        for (std::uint32_t i = 0; i < 40; ++i) pixels.push_back({i * 7 % 48, i * 5 % 32});
        return pixels;
    }

    fs::path image_;
    std::unique_ptr<test::ServingProcess> server_;
    std::unique_ptr<client::Connection> connection_;
};

TEST_P(Mitsuba06, ItsImageIsThatOfMitsubaBitByBit) {
    const auto file = imageio::read(image_);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(sameBits(*file, render()));
}

TEST_P(Mitsuba06, LayersAndMoreThreadsOfClientsChangeNoBit) {
    const Image plain = render();
    client::RenderOptions options;
    options.layers = {"intersection density", "next-event density", "path depth"};
    bool traced = true;
    std::thread clicks([&] {
        for (const Pixel pixel : somePixels()) traced = traced && bool(connection_->tracePixel(pixel));
    });
    const Image withLayers = render(options);
    clicks.join();
    EXPECT_TRUE(traced);
    EXPECT_TRUE(sameBits(plain, withLayers));
}

TEST_P(Mitsuba06, PixelsReplayExactlyAndTheirEstimatesAddUp) {
    render();
    const auto trace = connection_->tracePixels(somePixels());
    ASSERT_TRUE(trace) << trace.error().message;
    ASSERT_EQ(trace->paths.pathCount(), 40u * 8u);
    for (const Replay& replay : trace->replays) {
        EXPECT_EQ(replay.verdict, Verdict::exact);
        EXPECT_EQ(replay.sums, SumCheck::matches);
    }
}

/// Every path ends somewhere that is known: on a surface of the meshes or in the environment.
TEST_P(Mitsuba06, EveryVertexIsOnAMeshOrInTheEnvironment) {
    const auto meshes = connection_->meshes();
    ASSERT_TRUE(meshes) << meshes.error().message;
    const auto trace = connection_->tracePixels(somePixels());
    ASSERT_TRUE(trace) << trace.error().message;
    const PathSet& paths = trace->paths;
    std::size_t ends = 0;
    for (Index path = 0; path < paths.pathCount(); ++path) {
        for (Index v = paths.vertices(path).first; v < paths.vertices(path).last; ++v) {
            if (paths.isEnvironment(v)) {
                ++ends;
                EXPECT_EQ(paths.emission(v), Color(0.1f, 0.15f, 0.2f));
                continue;
            }
            const auto surface = paths.surface(v);
            ASSERT_TRUE(surface) << "path " << path << ", vertex " << v;
            ASSERT_LT(static_cast<std::size_t>(surface->mesh), meshes->size());
            const Mesh& mesh = (*meshes)[static_cast<std::size_t>(surface->mesh)];
            ASSERT_LT(static_cast<std::size_t>(surface->face), mesh.triangles.size());
            EXPECT_TRUE(paths.scattering(v)) << "path " << path << ", vertex " << v;
        }
    }
    EXPECT_GT(ends, 0u);
}

TEST_P(Mitsuba06, AQuitRequestEndsMitsuba) {
    ASSERT_TRUE(connection_->quitServer());
    for (int i = 0; i < 1000 && server_->alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_FALSE(server_->alive());
    EXPECT_TRUE(imageio::read(image_));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Mitsuba06, testing::Values("emcapath", "emca"),
                         [](const auto& about) { return std::string(about.param); });

}  // namespace
}  // namespace emca::mitsuba06
