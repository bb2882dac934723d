// What the command line says of a session file.
#include "emca/client/session.h"
#include "program_for_tests.h"

namespace emca::cli {
namespace {

class SessionFiles : public ProgramTest {
  protected:
    /// \return the name under which the program finds it
    std::string saved() const {
        client::Session session;
        session.info.emplace();
        session.info->renderer = "fake 1.0";
        session.info->scene = "hash";
        auto meshes = std::make_shared<std::vector<Mesh>>(2);
        (*meshes)[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        (*meshes)[0].triangles = {{0, 1, 2}};
        session.meshes = meshes;
        auto image = std::make_shared<RenderedImage>();
        image->color = Image(16, 12);
        session.images = {{"render 1", image, 3, 64}};
        client::Trace trace;
        trace.pixels = {{5, 6}};
        trace.replays.resize(1);
        trace.samplesPerPixel = 64;
        session.traces = {std::make_shared<const client::Trace>(trace)};
        session.shown = {0};
        session.notes = "a firefly\x1b[31m";
        session.pixelNotes = {{{5, 6}, "here"}};
        EXPECT_TRUE(client::saveSession(program.file("a.emca"), session).ok());
        return "a.emca";
    }
};

TEST_F(SessionFiles, InfoListsWhatASessionHolds) {
    const Json info = json({"info", saved(), "--json"});
    EXPECT_EQ(info["whole"], true);
    EXPECT_EQ(info["notices"], Json::array());
    EXPECT_EQ(info["images"][0]["title"], "render 1");
    EXPECT_EQ(info["images"][0]["width"], 16);
    EXPECT_EQ(info["images"][0]["render"], 3);
    EXPECT_EQ(info["traces"][0]["first"].dump(), "[5,6]");
    EXPECT_EQ(info["traces"][0]["shown"], true);
    EXPECT_EQ(info["scene"]["triangles"], 1);
    EXPECT_EQ(info["renderer"]["renderer"], "fake 1.0");
    EXPECT_EQ(info["pixelNotes"][0]["text"], "here");
    const Finished f = run({"info", "a.emca"});
    EXPECT_EQ(f.exitCode, Exit::ok);
    EXPECT_NE(f.out.find("render 1: 16 x 12 pixels"), std::string::npos) << f.out;
    EXPECT_NE(f.out.find("a firefly?[31m"), std::string::npos) << "notes cannot command a terminal: " << f.out;
}

TEST_F(SessionFiles, ACutSessionIsListedWithAWarning) {
    saved();
    std::filesystem::resize_file(program.file("a.emca"), std::filesystem::file_size(program.file("a.emca")) / 2);
    const Finished f = run({"info", "a.emca"});
    EXPECT_EQ(f.exitCode, Exit::ok);
    EXPECT_NE(f.err.find("warning: The file ends early"), std::string::npos) << f.err;
    const Json info = json({"info", "a.emca", "--json"});
    EXPECT_EQ(info["whole"], false);
    EXPECT_FALSE(info["notices"].empty());
}

TEST_F(SessionFiles, WhatIsNoSessionIsInputThatIsWrong) {
    std::ofstream(program.file("b.emca")) << "something else, and long enough";
    expectError({"info", "b.emca"}, Exit::input, "no EMCA session");
    expectError({"info", "none.emca"}, Exit::input, "no such file");
}

}  // namespace
}  // namespace emca::cli
