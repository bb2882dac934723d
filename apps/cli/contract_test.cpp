// The command line as scripts see it: the built program against a served renderer.
#include <cmath>

#include "command.h"
#include "emca/imageio/imageio.h"
#include "json.h"
#include "program_for_tests.h"
#include "served.h"

namespace emca::cli {
namespace {

using test::FakeRenderer;
using test::Gate;

class CommandLine : public ProgramTest {
  protected:
    void SetUp() override { served.start(); }
    std::string address() const { return served.address().text(); }
    test::Served served;
};

TEST_F(CommandLine, Info) {
    const Json info = json({"info", address(), "--json"});
    EXPECT_EQ(info["renderer"], "fake 1.0");
    EXPECT_EQ(info["scene"], "hash");
    EXPECT_EQ(info["width"], 16);
    EXPECT_EQ(info["height"], 12);
    EXPECT_EQ(info["spp"], 4);
    EXPECT_EQ(info["triangles"], 1);
    EXPECT_TRUE(info["capabilities"].is_array());
    const Finished table = run({"info", address()});
    EXPECT_NE(table.out.find("16 x 12 pixels, 4 spp"), std::string::npos) << table.out;
}

TEST_F(CommandLine, RenderWritesWhatWasRendered) {
    const Finished f = run({"render", address(), "-o", "a.exr", "--spp", "8", "--seed", "3"});
    ASSERT_EQ(f.exitCode, Exit::ok) << f.err;
    EXPECT_NE(f.out.find("a.exr: 16 x 12 pixels, 8 spp"), std::string::npos) << f.out;
    const Result<Image> image = imageio::read(program.file("a.exr"));
    ASSERT_TRUE(image.ok());
    RenderSettings settings;
    settings.samplesPerPixel = 8;
    settings.seed = 3;
    Color sum;
    for (std::uint32_t i = 0; i < 8; ++i) sum += FakeRenderer::sample({5, 6}, i, 3);
    EXPECT_EQ(image->color({5, 6}), sum / 8.f);
    EXPECT_GE(image->channelIndex("variance.R"), 0);
    EXPECT_GE(image->channelIndex("samples"), 0);
    const Json again = json({"render", address(), "-o", "b.png", "--json"});
    EXPECT_EQ(again["spp"], 4);
    EXPECT_EQ(again["faultyPixels"], 0);
}

TEST_F(CommandLine, PixelFollowsTheContract) {
    EXPECT_EQ(json({"pixel", address(), "5", "6", "--json"})["replay"]["verdict"], "unknown");
    json({"render", address(), "-o", "a.exr", "--json"});
    const Json pixel = json({"pixel", address(), "5", "6", "--json"});
    EXPECT_EQ(pixel["pixel"].dump(), "[5,6]");
    EXPECT_EQ(pixel["spp"], 4);
    EXPECT_EQ(pixel["replay"]["verdict"], "exact");
    EXPECT_EQ(pixel["replay"]["rendered"], pixel["replay"]["replayed"]);
    ASSERT_EQ(pixel["paths"].size(), 4u);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Json& path = pixel["paths"][i];
        const Color value = FakeRenderer::sample({5, 6}, i, 7);
        EXPECT_EQ(path["sample"], i);
        EXPECT_EQ(path["origin"], toJson(Vec3f{1, 2, 3}));
        EXPECT_EQ(path["depth"], 3);
        EXPECT_EQ(path["estimate"], toJson(value));
        ASSERT_EQ(path["vertices"].size(), 3u);
        const Json& vertex = path["vertices"][1];
        EXPECT_EQ(vertex["depth"], 2);
        EXPECT_EQ(vertex["position"], toJson(Vec3f{2, value.r, value.g}));
        EXPECT_EQ(vertex["nee"][0]["visible"], true);
        EXPECT_EQ(vertex["data"]["value"], toJson(value));
        EXPECT_EQ(vertex["data"]["name"], "vertex 2");
    }
}

TEST_F(CommandLine, PixelAgainstAnImageOfOnesOwn) {
    json({"render", address(), "-o", "mine.exr", "--json"});
    Result<Image> image = imageio::read(program.file("mine.exr"));
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(json({"pixel", address(), "1", "2", "--json", "--against", "mine.exr"})["replay"]["verdict"], "exact");
    image->setColor({1, 2}, image->color({1, 2}) * 1.00001f);
    ASSERT_TRUE(imageio::write(program.file("mine.exr"), *image).ok());
    EXPECT_EQ(json({"pixel", address(), "1", "2", "--json", "--against", "mine.exr"})["replay"]["verdict"], "close");
    image->setColor({1, 2}, Color(9));
    ASSERT_TRUE(imageio::write(program.file("mine.exr"), *image).ok());
    const Json different = json({"pixel", address(), "1", "2", "--json", "--against", "mine.exr"});
    EXPECT_EQ(different["replay"]["verdict"], "different");
    EXPECT_EQ(different["replay"]["rendered"], toJson(Color(9)));
    ASSERT_TRUE(imageio::write(program.file("other.exr"), Image(3, 3)).ok());
    expectError({"pixel", address(), "1", "2", "--against", "other.exr"}, Exit::input, "3 x 3");
    expectError({"pixel", address(), "1", "2", "--against", "absent.exr"}, Exit::input, "absent.exr");
}

TEST_F(CommandLine, IndicesStartAnywhere) {
    served.renderer.firstSample = 1;  // as in the paper's Algorithm 1
    const Json pixel = json({"pixel", address(), "0", "0", "--json"});
    ASSERT_EQ(pixel["paths"].size(), 4u);
    EXPECT_EQ(pixel["paths"][0]["sample"], 1);
    EXPECT_EQ(pixel["paths"][3]["sample"], 4);
}

TEST_F(CommandLine, NonFiniteNumbersAreWords) {
    served.renderer.disturbReplay = [](Pixel, Color) { return Color(std::nanf(""), -INFINITY, 1); };
    EXPECT_EQ(json({"pixel", address(), "0", "0", "--json"})["replay"]["replayed"].dump(),
              R"(["NaN","-Infinity",1.0])");
    const Finished table = run({"pixel", address(), "0", "0"});
    EXPECT_NE(table.out.find("(NaN, -Infinity, 1.000)"), std::string::npos) << table.out;
}

TEST_F(CommandLine, WrongUseIsTwo) {
    expectError({"pixel", address(), "-1", "0"}, Exit::usage, "-1");
    expectError({"pixel", address(), "1", "north"}, Exit::usage, "north");
    expectError({"pixel", address(), "1.5", "0"}, Exit::usage, "1.5");
    expectError({"pixel", address(), "1", "2", "--spp", "0"}, Exit::usage, "--spp");
    expectError({"pixel", address(), "1", "2", "--spp", "many"}, Exit::usage, "many");
    expectError({"pixel", address(), "1", "2", "--limit", "x"}, Exit::usage, "--limit");
    expectError({"render", address(), "-o", "a.exr", "--seed", "-3"}, Exit::usage, "-3");
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"frobnicate"},
                                                      {"pixel", address()},
                                                      {"render", address()},
                                                      {"info", address(), "--colour"}}) {
        const Finished f = run(arguments);
        EXPECT_EQ(f.exitCode, Exit::usage) << testing::PrintToString(arguments);
        EXPECT_NE(f.err, "");
        EXPECT_EQ(f.out, "");
    }
}

TEST_F(CommandLine, WrongInputIsThree) {
    expectError({"pixel", address(), "16", "0"}, Exit::input, "16 x 12");
    expectError({"pixel", address(), "0", "12", "--json"}, Exit::input, "16 x 12");
    expectError({"pixel", address(), "0", "0", "--spp", "1000000000"}, Exit::input, "1000000000");
    expectError({"render", address(), "-o", "a.exr", "--spp", "1000000000"}, Exit::input, "1000000000");
    expectError({"render", address(), "-o", "a.jpg"}, Exit::input, ".jpg");
    expectError({"render", address(), "-o", "nowhere/a.exr"}, Exit::input, "nowhere");
    expectError({"info", "host:port"}, Exit::input, "host:port");
    EXPECT_EQ(served.renderer.calls, 0);
}

TEST_F(CommandLine, NoRendererIsFour) {
    const std::string gone = address();
    served.server.reset();
    expectError({"info", gone}, Exit::connection, gone);
    expectError({"pixel", gone, "0", "0"}, Exit::connection, gone);
    expectError({"render", gone, "-o", "a.exr"}, Exit::connection, gone);
    EXPECT_FALSE(std::filesystem::exists(program.file("a.exr")));
}

TEST_F(CommandLine, AFailingRendererIsFive) {
    served.renderer.duringPixel = [](Pixel, RequestMonitor&) { throw std::runtime_error("out of caffeine"); };
    expectError({"pixel", address(), "0", "0"}, Exit::server, "out of caffeine");
    served.renderer.duringImage = [](RequestMonitor&) { throw std::runtime_error("out of paint"); };
    expectError({"render", address(), "-o", "a.exr"}, Exit::server, "out of paint");
    EXPECT_FALSE(std::filesystem::exists(program.file("a.exr")));
    EXPECT_EQ(run({"info", address()}).exitCode, Exit::ok);
}

TEST_F(CommandLine, InterruptCancelsTheRender) {
    Gate begun;
    std::atomic<bool> cancelled{false};
    served.renderer.duringImage = [&](RequestMonitor& monitor) {
        begun.open();
        for (int i = 0; i < 60000 && !monitor.cancelled(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        cancelled = monitor.cancelled();
    };
    const pid_t child = program.start({"render", address(), "-o", "a.exr"});
    ASSERT_TRUE(begun.wait());
    ::kill(child, SIGINT);
    const Finished f = program.finish(child);
    EXPECT_EQ(f.exitCode, Exit::interrupted) << f.err;
    EXPECT_EQ(f.out, "");
    EXPECT_NE(f.err.find("cancelled"), std::string::npos) << f.err;
    EXPECT_FALSE(std::filesystem::exists(program.file("a.exr")));
    served.server.reset();  // waits for the renderer
    EXPECT_TRUE(cancelled);
}

TEST_F(CommandLine, HelpAndVersion) {
    const Finished version = run({"--version"});
    EXPECT_EQ(version.exitCode, Exit::ok);
    EXPECT_EQ(version.out.rfind("emca ", 0), 0u) << version.out;
    for (const char* command : {"info", "render", "pixel"}) {
        const Finished help = run({command, "--help"});
        EXPECT_EQ(help.exitCode, Exit::ok);
        EXPECT_NE(help.out.find("Example"), std::string::npos);
        EXPECT_NE(run({"--help"}).out.find(command), std::string::npos);
    }
}

}  // namespace
}  // namespace emca::cli
