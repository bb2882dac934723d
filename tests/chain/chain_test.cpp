// From a scene file to the light path behind a firefly, by the commands that a person types.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "emca/imageio/imageio.h"
#include "process.h"

namespace emca {
namespace {

using test::Outcome;
using test::run;
using test::ServingProcess;
using Json = nlohmann::json;

const std::string kScenes = std::string(EMCA_SOURCE_DIR) + "/scenes/";
const std::string kWork = std::string(EMCA_WORK_DIR) + "/";

double luminanceOf(const Json& color) {
    return 0.2126 * color.at(0).get<double>() + 0.7152 * color.at(1).get<double>() + 0.0722 * color.at(2).get<double>();
}

Pixel brightest(const Image& image) {
    Pixel best;
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            if (luminance(image.color({x, y})) > luminance(image.color(best))) best = {x, y};
    return best;
}

TEST(Chain, InfoRenderPixel) {
    const ServingProcess server({EMCA_RENDER, kScenes + "cornell-glass/scene.xml", "--size", "64x48", "--spp", "8", "--serve", "0"});
    ASSERT_FALSE(server.address().empty());
    EXPECT_EQ(server.address().substr(0, 10), "127.0.0.1:");

    const Outcome info = run({EMCA_CLI, "info", server.address(), "--json"});
    ASSERT_EQ(info.exitCode, 0) << info.err;
    const Json said = Json::parse(info.out);
    EXPECT_EQ(said.at("width"), 64);
    EXPECT_EQ(said.at("height"), 48);
    EXPECT_EQ(said.at("spp"), 8);
    EXPECT_GT(said.at("triangles").get<int>(), 100);
    for (const char* key : {"renderer", "scene", "capabilities"}) EXPECT_TRUE(said.contains(key)) << key;

    const Outcome rendered = run({EMCA_CLI, "render", server.address(), "-o", kWork + "served.exr"});
    ASSERT_EQ(rendered.exitCode, 0) << rendered.err;
    const Outcome alone = run({EMCA_RENDER, kScenes + "cornell-glass/scene.xml", "--size", "64x48", "--spp", "8", "-o", kWork + "alone.exr"});
    ASSERT_EQ(alone.exitCode, 0) << alone.err;
    const auto served = imageio::read(kWork + "served.exr"), direct = imageio::read(kWork + "alone.exr");
    ASSERT_TRUE(served.ok() && direct.ok());
    for (std::uint32_t y = 0; y < 48; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) ASSERT_EQ(served->color({x, y}), direct->color({x, y}));

    const Outcome pixel = run({EMCA_CLI, "pixel", server.address(), "30", "40", "--json"});
    ASSERT_EQ(pixel.exitCode, 0) << pixel.err;
    const Json trace = Json::parse(pixel.out);
    EXPECT_EQ(trace.at("pixel"), Json({30, 40}));
    EXPECT_EQ(trace.at("spp"), 8);
    EXPECT_EQ(trace.at("replay").at("verdict"), "exact");
    EXPECT_EQ(trace.at("replay").at("rendered"), trace.at("replay").at("replayed"));
    ASSERT_EQ(trace.at("paths").size(), 8u);
    double sum = 0;
    for (const Json& path : trace.at("paths")) {
        for (const char* key : {"sample", "part", "origin", "depth", "estimate", "data", "contributions", "vertices"})
            ASSERT_TRUE(path.contains(key)) << key;
        sum += luminanceOf(path.at("estimate"));
        for (const Json& vertex : path.at("vertices"))
            for (const char* key : {"depth", "position", "event", "surface", "nee", "envmap", "estimate", "emission", "data"})
                ASSERT_TRUE(vertex.contains(key)) << key;
    }
    EXPECT_NEAR(sum / 8, luminanceOf(trace.at("replay").at("replayed")), 1e-4 * sum);
    EXPECT_TRUE(server.alive());
}

// Figure 1: the path hits the sun by a BSDF that chose this direction with a low probability, and every shadow ray from
// there was blocked.
TEST(Chain, TheCauseOfAFireflyIsInTheRecordedData) {
    const ServingProcess server({EMCA_RENDER, kScenes + "firefly/scene.xml", "--size", "160x120", "--serve", "0"});
    ASSERT_FALSE(server.address().empty());
    ASSERT_EQ(run({EMCA_CLI, "render", server.address(), "-o", kWork + "firefly.exr"}).exitCode, 0);
    const auto image = imageio::read(kWork + "firefly.exr");
    ASSERT_TRUE(image.ok());
    const Pixel firefly = brightest(*image);
    const Outcome pixel = run({EMCA_CLI, "pixel", server.address(), std::to_string(firefly.x), std::to_string(firefly.y), "--json"});
    ASSERT_EQ(pixel.exitCode, 0) << pixel.err;
    const Json trace = Json::parse(pixel.out);
    EXPECT_EQ(trace.at("replay").at("verdict"), "exact");
    const Json* outlier = nullptr;
    double rest = 0, most = 0;
    for (const Json& path : trace.at("paths")) {
        const double value = luminanceOf(path.at("estimate"));
        rest += value;
        if (value > most) most = value, outlier = &path;
    }
    rest -= most;
    ASSERT_NE(outlier, nullptr);
    EXPECT_GT(most, 100 * rest) << "one path carries the pixel";
    const Json& vertices = outlier->at("vertices");
    bool glass = false, sun = false;
    for (const Json& vertex : vertices) {
        if (vertex.at("data").value("material", "") == "tinted glass") glass = true;
        if (!vertex.at("emission").is_null() && luminanceOf(vertex.at("emission")) > 10000) sun = glass;
    }
    EXPECT_TRUE(sun) << "it hits the sun after the glass";
}

TEST(Chain, TheExampleRendererIsServedAndReplayedExactly) {
    const ServingProcess server({EMCA_MINIMAL, "0"});
    ASSERT_FALSE(server.address().empty());
    ASSERT_EQ(run({EMCA_CLI, "render", server.address(), "-o", kWork + "minimal.exr"}).exitCode, 0);
    const Outcome pixel = run({EMCA_CLI, "pixel", server.address(), "80", "60", "--json"});
    ASSERT_EQ(pixel.exitCode, 0) << pixel.err;
    const Json trace = Json::parse(pixel.out);
    EXPECT_EQ(trace.at("replay").at("verdict"), "exact");
    EXPECT_EQ(trace.at("paths").size(), 64u);
    EXPECT_TRUE(trace.at("paths")[0].at("vertices")[0].at("data").contains("PDF"));
}

}  // namespace
}  // namespace emca
