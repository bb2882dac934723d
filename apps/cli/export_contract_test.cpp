// `emca export` as scripts see it: the page, what it holds, and what it says about itself.
#include "emca/client/session.h"
#include "export_for_tests.h"

namespace emca::cli {
namespace {

class Export : public ProgramTest {
  protected:
    void SetUp() override { served.start(); }
    std::string address() const { return served.address().text(); }
    Json dataOf(const std::string& name) const { return pageData(pageText(program.file(name))); }

    /// A session of the fake renderer with two traces: one of a pixel, one of two.
    void saveSession(const std::string& name) {
        const auto connection = served.connect();
        client::Session session;
        session.info = *connection->info();
        session.camera = *connection->camera();
        session.meshes = std::make_shared<const std::vector<Mesh>>(*connection->meshes());
        session.traces.push_back(std::make_shared<const client::Trace>(*connection->tracePixel({5, 6})));
        session.traces.push_back(std::make_shared<const client::Trace>(*connection->tracePixels({{1, 2}, {3, 4}})));
        ASSERT_OK(client::saveSession(program.file(name), session));
    }
    test::Served served;
};

TEST_F(Export, ValuesAreThoseOfThePixelCommand) {
    const Json said = json({"export", address(), "5", "6", "--html", "a.html", "--json"});
    const Json pixel = json({"pixel", address(), "5", "6", "--json"});
    const std::string page = pageText(program.file("a.html"));
    const Json data = pageData(page);
    EXPECT_EQ(data["pixel"].dump(), pixel.dump());
    EXPECT_EQ(data["sceneName"], "hash");
    EXPECT_EQ(data["camera"]["verticalFieldOfView"], 33);
    EXPECT_EQ(said["paths"], 4);
    EXPECT_EQ(said["triangles"], 1);
    EXPECT_EQ(said["bytes"], page.size());
    EXPECT_LT(page.size(), 200'000u);  // what a page costs besides its data
}

TEST_F(Export, PathsAreChosenByBrightnessAndQuery) {
    const Json two = json({"export", address(), "5", "6", "--html", "a.html", "--spp", "64", "--limit", "2", "--json"});
    EXPECT_EQ(two["paths"], 2);
    EXPECT_EQ(two["ofPaths"], 64);
    const Json all = json({"pixel", address(), "5", "6", "--spp", "64", "--json"});
    const auto brightness = [](const Json& path) { return 0.2126 * path["estimate"][0].get<double>() + 0.7152 * path["estimate"][1].get<double>() + 0.0722 * path["estimate"][2].get<double>(); };
    double least = 1e9;
    const Json page = dataOf("a.html");
    for (const Json& path : page["pixel"]["paths"]) least = std::min(least, brightness(path));
    int brighter = 0;
    for (const Json& path : all["paths"]) brighter += brightness(path) >= least ? 1 : 0;
    EXPECT_EQ(brighter, 2);
    json({"export", address(), "5", "6", "--html", "b.html", "--spp", "64", "--where", "sample == 3", "--json"});
    const Json chosen = dataOf("b.html");
    ASSERT_EQ(chosen["pixel"]["paths"].size(), 1u);
    EXPECT_EQ(chosen["pixel"]["paths"][0]["sample"], 3);
    EXPECT_EQ(chosen["query"], "sample == 3");
}

TEST_F(Export, TheSceneHasItsBudget) {
    EXPECT_TRUE(json({"export", address(), "0", "0", "--html", "a.html", "--no-scene", "--json"})["triangles"].is_null());
    EXPECT_TRUE(dataOf("a.html")["scene"].is_null());
    served.renderer.scene.assign(50, served.renderer.scene[0]);
    const Json said = json({"export", address(), "0", "0", "--html", "a.html", "--max-triangles", "20", "--json"});
    EXPECT_LE(said["triangles"], 20);
    EXPECT_EQ(said["ofTriangles"], 50);
}

TEST_F(Export, NamesOfOthersAreText) {
    served.renderer.scene = {hostileWall()};
    served.renderer.description.scene = "</title><script>";
    json({"export", address(), "0", "0", "--html", "a.html", "--json"});
    const std::string page = pageText(program.file("a.html"));
    EXPECT_EQ(page.find("<script>document"), std::string::npos);
    EXPECT_EQ(page.find("<img"), std::string::npos);
    EXPECT_EQ(page.find('\x1b'), std::string::npos);
    EXPECT_EQ(pageData(page)["scene"]["meshes"][0]["name"], hostileWall().name);
}

TEST_F(Export, SessionsGiveTheSamePage) {
    saveSession("a.emca");
    json({"export", address(), "5", "6", "--html", "live.html", "--json"});
    served.server.reset();
    json({"export", "a.emca", "5", "6", "--html", "kept.html", "--json"});
    EXPECT_EQ(pageText(program.file("live.html")), pageText(program.file("kept.html")));
    json({"export", "a.emca", "3", "4", "--html", "b.html", "--where", "sample > 1", "--json"});
    const Json data = dataOf("b.html");
    EXPECT_EQ(data["pixel"]["pixel"].dump(), "[3,4]");
    EXPECT_EQ(data["pixel"]["paths"].size(), 2u);
    expectError({"export", "a.emca", "9", "9", "--html", "c.html"}, Exit::input, "(5, 6), (1, 2), (3, 4)");
    expectError({"export", "a.emca", "5", "6", "--html", "c.html", "--spp", "8"}, Exit::usage, "--spp");
    EXPECT_FALSE(std::filesystem::exists(program.file("c.html")));
}

TEST_F(Export, WhatIsWrongIsSaid) {
    expectError({"export", address(), "16", "0", "--html", "a.html"}, Exit::input, "16 x 12");
    expectError({"export", address(), "0", "0", "--html", "nowhere/a.html"}, Exit::input, "nowhere");
    expectError({"export", address(), "0", "0", "--html", "a.html", "--max-triangles", "0"}, Exit::usage, "--max-triangles");
    expectError({"export", address(), "0", "0", "--html", "a.html", "--limit", "x"}, Exit::usage, "--limit");
    EXPECT_EQ(run({"export", address(), "0", "0"}).exitCode, Exit::usage);
    EXPECT_EQ(run({"export", address(), "0", "0", "--html", "a.html", "--where", "luminance >"}).exitCode, Exit::usage);
    EXPECT_FALSE(std::filesystem::exists(program.file("a.html")));
    const std::string gone = address();
    served.server.reset();
    expectError({"export", gone, "0", "0", "--html", "a.html"}, Exit::connection, gone);
}

}  // namespace
}  // namespace emca::cli
