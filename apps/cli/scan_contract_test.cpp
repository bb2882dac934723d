// Queries from the command line: the built program against a served renderer whose paths are known.
#include <algorithm>
#include <cmath>

#include "emca/client/session.h"
#include "emca/imageio/imageio.h"
#include "program_for_tests.h"
#include "served.h"

namespace emca::cli {
namespace {

class Scans : public ProgramTest {
  protected:
    void SetUp() override { served.start(); }
    std::string address() const { return served.server->address(); }

    /// Samples of the whole image, 8 per pixel, whose luminance exceeds a limit, brightest first.
    std::vector<std::pair<float, Pixel>> above(float limit) const {
        std::vector<std::pair<float, Pixel>> found;
        for (std::uint32_t y = 0; y < 12; ++y)
            for (std::uint32_t x = 0; x < 16; ++x)
                for (std::uint32_t i = 0; i < 8; ++i) {
                    const float value = luminance(test::FakeRenderer::sample({x, y}, i, 7));
                    if (value > limit) found.push_back({value, {x, y}});
                }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        return found;
    }
    test::Served served;
};

TEST_F(Scans, FindWhatALoopOverTheImageFinds) {
    const auto expected = above(0.8f);
    ASSERT_GT(expected.size(), 20u);
    const Json found = json({"scan", address(), "--where", "luminance > 0.8", "--spp", "8", "--top", "5", "--json"});
    EXPECT_EQ(found["paths"], 16 * 12 * 8);
    EXPECT_EQ(found["matched"], expected.size());
    EXPECT_EQ(found["unknown"], 0);
    EXPECT_EQ(found["query"], "luminance > 0.8");
    ASSERT_EQ(found["top"].size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_FLOAT_EQ(found["top"][i]["luminance"].get<float>(), expected[i].first);
        EXPECT_EQ(found["top"][i]["pixel"], (Json{expected[i].second.x, expected[i].second.y}));
        EXPECT_EQ(found["top"][i]["depth"], 3) << "recorded again with all that is shown";
    }
    const Finished text = run({"scan", address(), "--where", "luminance > 0.8", "--spp", "8"});
    EXPECT_EQ(text.exitCode, Exit::ok);
    EXPECT_NE(text.out.find(std::to_string(expected.size()) + " of 1536 paths match"), std::string::npos) << text.out;
    const Finished csv = run({"scan", address(), "--where", "luminance > 0.8", "--spp", "8", "--top", "3", "--csv"});
    EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 4);
    EXPECT_EQ(csv.out.rfind("x,y,sample,part,depth,luminance,r,g,b,events\n", 0), 0u);
}

TEST_F(Scans, PerPixelImageAddsUpToTheImage) {
    // Both halves of all paths bring what the whole brings.
    for (const char* half : {"luminance > 0.5", "not (luminance > 0.5)"})
        ASSERT_EQ(run({"scan", address(), "--where", half, "--spp", "8", "--per-pixel", half[0] == 'l' ? "a.exr" : "b.exr"}).exitCode, Exit::ok);
    ASSERT_EQ(run({"render", address(), "-o", "all.exr", "--spp", "8"}).exitCode, Exit::ok);
    const auto a = imageio::read(program.file("a.exr")), b = imageio::read(program.file("b.exr")), all = imageio::read(program.file("all.exr"));
    ASSERT_TRUE(a && b && all);
    const auto count = std::find(a->channels().begin(), a->channels().end(), "count") - a->channels().begin();
    ASSERT_LT(count, static_cast<std::ptrdiff_t>(a->channelCount()));
    for (std::uint32_t y = 0; y < 12; ++y)
        for (std::uint32_t x = 0; x < 16; ++x) {
            const Color sum = a->color({x, y}) + b->color({x, y}), whole = all->color({x, y});
            EXPECT_NEAR(sum.r, whole.r, 1e-5f);
            EXPECT_NEAR(sum.b, whole.b, 1e-5f);
            const std::size_t at = (y * 16 + x) * a->channelCount() + static_cast<std::size_t>(count);
            EXPECT_EQ(a->data()[at] + b->data()[at], 8.f);
        }
}

TEST_F(Scans, SavedSessionHoldsTheMatchesWhole) {
    const auto expected = above(0.9f);
    const Finished f = run({"scan", address(), "--where", "luminance > 0.9", "--spp", "8", "--save", "found.emca"});
    ASSERT_EQ(f.exitCode, Exit::ok) << f.err;
    const auto opened = client::openSession(program.file("found.emca"));
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_TRUE(opened->whole);
    ASSERT_EQ(opened->session.traces.size(), 1u);
    const PathSet& paths = opened->session.traces[0]->paths;
    EXPECT_EQ(paths.pathCount(), expected.size());
    EXPECT_EQ(paths.vertexCount(), 3 * expected.size());
    EXPECT_EQ(paths.find(Scope::vertex, "name").size(), 1u) << "with all that was recorded";
    EXPECT_TRUE(opened->session.camera.has_value());
    EXPECT_TRUE(opened->session.meshes != nullptr);
}

TEST_F(Scans, ASavedPixelAnswersAsTheRendererDid) {
    const auto brightest = above(0.f)[0].second;
    const std::string x = std::to_string(brightest.x), y = std::to_string(brightest.y);
    ASSERT_EQ(run({"scan", address(), "--where", "luminance >= 0", "--spp", "8", "--save", "all.emca"}).exitCode, Exit::ok);
    Json live = json({"pixel", address(), x, y, "--spp", "8", "--json"}), saved = json({"pixel", "all.emca", x, y, "--json"});
    for (const char* member : {"pixel", "spp", "seed", "integrator", "paths"}) EXPECT_EQ(saved[member], live[member]) << member;
    EXPECT_EQ(saved["replay"]["replayed"], live["replay"]["replayed"]);
    const Json some = json({"pixel", "all.emca", x, y, "--where", "luminance > 0.5", "--json"});
    EXPECT_EQ(some["paths"], json({"pixel", address(), x, y, "--spp", "8", "--where", "luminance > 0.5", "--json"})["paths"]);
    EXPECT_EQ(some["where"]["paths"], 8);
    EXPECT_EQ(json({"stats", "all.emca", x, y, "--json"})["summary"], json({"stats", address(), x, y, "--spp", "8", "--json"})["summary"]);
    EXPECT_EQ(json({"outliers", "all.emca", x, y, "--json"})["outliers"], json({"outliers", address(), x, y, "--spp", "8", "--json"})["outliers"]);
    const Json region = json({"outliers", "all.emca", "--rect", "2,3,5,6", "--per-pixel", "--deviations", "1", "--json"});
    EXPECT_GT(region["outliers"].size(), 9u);
    EXPECT_EQ(region["outliers"], json({"outliers", address(), "--rect", "2,3,5,6", "--per-pixel", "--deviations", "1", "--spp", "8", "--json"})["outliers"]);
    expectError({"pixel", "all.emca", "999", "0"}, Exit::input, "was not traced");
    expectError({"pixel", "all.emca", x, y, "--spp", "8"}, Exit::usage, "session");
}

TEST_F(Scans, APixelCanBeAskedTheSame) {
    const Json pixel = json({"pixel", address(), "3", "4", "--spp", "64", "--where", "luminance > 0.5", "--json"});
    EXPECT_EQ(pixel["where"]["paths"], 64);
    EXPECT_EQ(pixel["where"]["matched"], pixel["paths"].size());
    EXPECT_LT(pixel["paths"].size(), 64u);
    EXPECT_GT(pixel["paths"].size(), 10u);
    EXPECT_FALSE(json({"pixel", address(), "3", "4", "--json"}).contains("where"));
}

TEST_F(Scans, AssertionsDecideTheExitCode) {
    EXPECT_EQ(run({"assert", address(), "none(nan(estimate))"}).exitCode, Exit::ok);
    EXPECT_EQ(run({"assert", address(), "luminance < 2 and all(v.position.x <= 3)"}).exitCode, Exit::ok);
    const Finished no = run({"assert", address(), "luminance < 0.9", "--spp", "8"});
    EXPECT_EQ(no.exitCode, Exit::assertionFalse);
    EXPECT_EQ(no.out.rfind("false:", 0), 0u);
    const auto expected = above(0.9f);
    EXPECT_NE(no.out.find("for " + std::to_string(expected.size()) + " of 1536 paths"), std::string::npos) << no.out;
    const Finished f = run({"assert", address(), "luminance < 0.9", "--spp", "8", "--json"});
    EXPECT_EQ(f.exitCode, Exit::assertionFalse);
    const Json said = Json::parse(f.out);
    EXPECT_EQ(said["holds"], false);
    EXPECT_EQ(said["false"], expected.size());
    ASSERT_FALSE(said["examples"].empty());
    // A name that nobody recorded proves nothing.
    const Finished unknown = run({"assert", address(), "all(v.pfd < 2)"});
    EXPECT_EQ(unknown.exitCode, Exit::assertionFalse);
    EXPECT_NE(unknown.err.find("pfd"), std::string::npos);
}

TEST_F(Scans, MistakesArePointedAt) {
    const Finished f = run({"scan", address(), "--where", "luminance > 1 an depth > 2"});
    EXPECT_EQ(f.exitCode, Exit::usage);
    EXPECT_NE(f.err.find("\nluminance > 1 an depth > 2\n              ^"), std::string::npos) << f.err;
    EXPECT_EQ(run({"pixel", address(), "1", "1", "--where", "any("}).exitCode, Exit::usage);
    EXPECT_EQ(run({"assert", address(), "luminance <"}).exitCode, Exit::usage);
    expectError({"assert", address(), "any(v.name > 3)"}, Exit::input, "At character");
    expectError({"scan", address(), "--where", "luminance > 1", "--rect", "1,2,3"}, Exit::usage, "--rect");
    expectError({"scan", address(), "--where", "luminance > 1", "--rect", "0,0,17,3"}, Exit::input, "16 x 12");
    expectError({"scan", address(), "--where", "luminance > 1", "--save", "no/such/folder.emca"}, Exit::input, "folder");
    expectError({"scan", address(), "--where", "luminance > 1", "--per-pixel", "a.xyz"}, Exit::input, "xyz");
}

}  // namespace
}  // namespace emca::cli
