// Surface layers from the command line: the built program against a served renderer that collects them.
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>

#include "command.h"
#include "json.h"
#include "layered_renderer.h"
#include "ply_for_tests.h"
#include "program_for_tests.h"
#include "served.h"

namespace emca::cli {
namespace {

constexpr std::uint64_t kPoints = 16 * 12 * 20;  // of LayeredRenderer

class Layers : public ProgramTest {
  protected:
    void SetUp() override { start({}); }
    void start(ServerOptions options) {
        server.reset();
        auto started = Server::start(renderer, std::move(options));
        ASSERT_TRUE(started.ok()) << started.error().message;
        server = std::move(started).value();
    }
    std::string address() const { return server->address(); }
    test::LayeredRenderer renderer;
    std::unique_ptr<Server> server;
};

TEST_F(Layers, InfoNamesThem) {
    const Json info = json({"info", address(), "--json"});
    ASSERT_EQ(info["layers"].size(), 4u);
    EXPECT_EQ(info["layers"][1]["name"], "colors");
    EXPECT_EQ(info["layers"][1]["kind"], "mean color");
    EXPECT_EQ(info["layers"][1]["unit"], "W/(sr m^2)");
    EXPECT_EQ(info["layers"][1]["description"], "Adds the pixel's colour.");
    EXPECT_NE(run({"info", address()}).out.find("hits, colors, column, row sum"), std::string::npos);
}

TEST_F(Layers, ListSaysWhatWasCollected) {
    Json list = json({"layers", address(), "--list", "--json"});
    EXPECT_TRUE(list["render"].is_null());
    ASSERT_EQ(list["layers"].size(), 4u);
    EXPECT_EQ(list["layers"][0]["name"], "hits");
    EXPECT_EQ(list["layers"][0]["kind"], "density");
    EXPECT_EQ(list["layers"][0]["unit"], "1/m^2");
    EXPECT_EQ(list["layers"][0]["description"], "Adds 1 for each pixel.");
    EXPECT_EQ(list["layers"][0]["collected"], false);
    EXPECT_TRUE(list["layers"][0]["samples"].is_null());
    renderer.addsItsOwn = true;
    const Json render = json({"render", address(), "-o", "a.exr", "--layers", "hits,row sum", "--json"});
    list = json({"layers", address(), "--list", "--json"});
    EXPECT_EQ(list["render"], render["render"]);
    ASSERT_EQ(list["layers"].size(), 5u) << "the renderer's own comes too";
    EXPECT_EQ(list["layers"][0]["samples"], kPoints);
    EXPECT_EQ(list["layers"][1]["collected"], false);
    EXPECT_EQ(list["layers"][3]["collected"], true);
    EXPECT_EQ(list["layers"][4]["name"], "own");
    const Finished text = run({"layers", address(), "--list"});
    EXPECT_NE(text.out.find("hits"), std::string::npos);
    EXPECT_NE(text.out.find(std::to_string(kPoints)), std::string::npos) << text.out;
}

TEST_F(Layers, RenderSaysWhatItCollected) {
    const Json render = json({"render", address(), "-o", "a.exr", "--layers", "all", "--json"});
    ASSERT_EQ(render["layers"].size(), 4u);
    EXPECT_EQ(render["layers"][2]["name"], "column");
    EXPECT_EQ(render["layers"][2]["samples"], kPoints);
    EXPECT_EQ(render["surface"]["points"], kPoints);
    EXPECT_GT(render["surface"]["faces"], 2);
    EXPECT_EQ(render["surface"]["coarse"], 0);
    EXPECT_EQ(render["surface"]["budget"], 256u << 20);
    const Finished text = run({"render", address(), "-o", "a.exr", "--layers", "hits, colors", "--surface-budget", "8"});
    EXPECT_EQ(text.exitCode, Exit::ok);
    EXPECT_EQ(text.err, "");
    EXPECT_NE(text.out.find("3840 points on "), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("of 8.000 MiB"), std::string::npos) << text.out;
    const Json without = json({"render", address(), "-o", "a.exr", "--json"});
    EXPECT_EQ(without["layers"].size(), 0u);
    EXPECT_FALSE(without.contains("surface"));
}

TEST_F(Layers, CoarsePointsAreWarnedOf) {
    ServerOptions options;
    options.surfaceBudget = 1;
    start(options);
    const Finished f = run({"render", address(), "-o", "a.exr", "--layers", "hits"});
    EXPECT_EQ(f.exitCode, Exit::ok);
    EXPECT_NE(f.err.find("3840 of 3840 points"), std::string::npos) << f.err;
}

TEST_F(Layers, ExportIsTheRefinedMeshWithItsValues) {
    json({"render", address(), "-o", "a.exr", "--layers", "all", "--json"});
    const Json exported = json({"layers", address(), "--export", "hits", "hits.ply", "--json"});
    EXPECT_EQ(exported["samples"], kPoints);
    const Ply ply = readPly(program.file("hits.ply"));
    EXPECT_EQ(ply.faces.size(), exported["faces"]);
    EXPECT_NE(ply.header.find("comment EMCA surface layer: hits\n"), std::string::npos) << ply.header;
    EXPECT_NE(ply.header.find("comment unit: 1/m^2\n"), std::string::npos);
    EXPECT_NE(ply.header.find("comment range of colours: "), std::string::npos);
    EXPECT_NE(ply.header.find("comment scene: hash\n"), std::string::npos);
    double events = 0, area = 0;
    for (const Ply::Face& face : ply.faces) {
        const Vec3f a = ply.vertices.at(face.vertices[0]), b = ply.vertices.at(face.vertices[1]), c = ply.vertices.at(face.vertices[2]);
        const double faceArea = static_cast<double>(length(cross(b - a, c - a))) / 2;
        area += faceArea;
        events += faceArea * static_cast<double>(face.quality);
        EXPECT_GE(face.quality, 0);
    }
    EXPECT_NEAR(area, 1.5, 1e-5) << "the square, and the triangle that nothing landed on";
    EXPECT_NEAR(events, kPoints, 0.01) << "a density times area is a number of points";

    json({"layers", address(), "--export", "colors", "colors.ply", "--json"});
    const Ply colors = readPly(program.file("colors.ply"));
    ASSERT_EQ(colors.faces.size(), ply.faces.size());
    EXPECT_TRUE(std::isnan(colors.faces[0].quality)) << "nothing landed on the first triangle";
    EXPECT_EQ(colors.faces[0].color, (std::array<std::uint8_t, 3>{112, 112, 112}));
    for (std::size_t f = 1; f < colors.faces.size(); ++f) {
        EXPECT_EQ(colors.faces[f].rgb, (std::array<float, 3>{0.25f, 0.5f, 1}));
        EXPECT_GT(colors.faces[f].color[2], colors.faces[f].color[1]);
    }
}

TEST_F(Layers, ExportNamesARender) {
    const Json first = json({"render", address(), "-o", "a.exr", "--layers", "hits", "--json"});
    json({"render", address(), "-o", "a.exr", "--layers", "colors", "--json"});
    json({"pixel", address(), "1", "2", "--json"});
    expectError({"layers", address(), "--export", "hits", "a.ply"}, Exit::input, "colors");
    EXPECT_EQ(json({"layers", address(), "--export", "hits", "a.ply", "--render", first["render"].dump(), "--json"})["layer"], "hits");
    expectError({"layers", address(), "--export", "hits", "b.ply", "--render", "12"}, Exit::input, "12");
    EXPECT_FALSE(std::filesystem::exists(program.file("b.ply")));
}

TEST_F(Layers, ErrorsHaveTheirExitCodes) {
    expectError({"layers", address()}, Exit::usage, "--list");
    expectError({"layers", address(), "--list", "--export", "hits", "a.ply"}, Exit::usage, "--list");
    expectError({"layers", address(), "--list", "--render", "5"}, Exit::usage, "--render");
    expectError({"layers", address(), "--export", "hits", "a.ply", "--render", "x"}, Exit::usage, "--render");
    expectError({"render", address(), "-o", "a.exr", "--surface-budget", "5"}, Exit::usage, "--layers");
    expectError({"render", address(), "-o", "a.exr", "--layers", "all", "--surface-budget", "0"}, Exit::usage, "--surface-budget");
    EXPECT_EQ(run({"layers", address(), "--export", "hits"}).exitCode, Exit::usage);
    expectError({"layers", address(), "--export", "hits", "a.ply"}, Exit::input, "no image was rendered with layers");
    expectError({"layers", address(), "--export", "hits", "a.obj"}, Exit::input, ".ply");
    expectError({"layers", address(), "--export", "hits", "nowhere/a.ply"}, Exit::input, "nowhere");
    expectError({"render", address(), "-o", "a.exr", "--layers", "hits,nonsense"}, Exit::input, "\"row sum\"");
    expectError({"render", address(), "-o", "a.exr", "--layers", "all", "--surface-budget", "5000"}, Exit::input, "allows at most");
    const std::string gone = address();
    server.reset();
    expectError({"layers", gone, "--list"}, Exit::connection, gone);
    expectError({"layers", gone, "--export", "hits", "a.ply"}, Exit::connection, gone);
    for (const auto& entry : std::filesystem::directory_iterator(program.file(""))) {
        EXPECT_EQ(entry.path().string().find(".ply"), std::string::npos) << "nothing is left behind: " << entry.path();
    }
}

TEST_F(Layers, AFailedExportLeavesTheOldFile) {
    json({"render", address(), "-o", "a.exr", "--layers", "hits", "--json"});
    json({"layers", address(), "--export", "hits", "a.ply", "--json"});
    const auto size = std::filesystem::file_size(program.file("a.ply"));
    expectError({"layers", address(), "--export", "colors", "a.ply"}, Exit::input, "\"hits\"");
    EXPECT_EQ(std::filesystem::file_size(program.file("a.ply")), size);
}

TEST(LayersWithout, ARendererThatHasNoneSaysSo) {
    test::Served served;
    served.start();
    const Program program;
    const std::string address = served.address().text();
    EXPECT_NE(program.run({"layers", address, "--list"}).out.find("no surface layers"), std::string::npos);
    EXPECT_EQ(program.run({"layers", address, "--export", "a", "a.ply"}).exitCode, Exit::input);
    EXPECT_EQ(program.run({"render", address, "-o", "a.exr", "--layers", "all"}).exitCode, Exit::input);
}

}  // namespace
}  // namespace emca::cli
