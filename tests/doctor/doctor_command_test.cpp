// `emca doctor` finds nothing wrong with what we ship.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "process.h"

namespace emca {
namespace {

using test::Outcome;
using test::run;
using test::ServingProcess;
using Json = nlohmann::json;

/// Nothing but "ok", and "skipped" for what the renderer does not offer.
void expectWell(const std::string& address, const std::vector<std::string>& skipped) {
    const Outcome outcome = run({EMCA_CLI, "doctor", address, "--json", "--pixels", "40", "--spp", "4"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const Json report = Json::parse(outcome.out);
    std::vector<std::string> left;
    for (const Json& check : report["checks"]) {
        if (check["outcome"] == "skipped") left.push_back(check["check"]);
        else EXPECT_EQ(check["outcome"], "ok") << check["check"] << ": " << check["sentence"];
    }
    EXPECT_EQ(left, skipped);
    EXPECT_EQ(report["checks"].size(), 19u);
    EXPECT_TRUE(report["complete"]);
    for (const Json& check : report["checks"])
        if (check["check"] == "replay") EXPECT_EQ(check["figures"]["exact"], 40);
}

TEST(DoctorCommand, TheMinimalRendererIsWell) {
    const ServingProcess server({EMCA_MINIMAL, "0"});
    ASSERT_FALSE(server.address().empty());
    expectWell(server.address(), {"surfaces", "layers", "light-probe"});
}

TEST(DoctorCommand, TheReferenceRendererIsWellOnItsScenes) {
    for (const char* scene : {"cornell-box", "cornell-glass", "door-ajar", "firefly", "light-sampling-bug"}) {
        SCOPED_TRACE(scene);
        const ServingProcess server({EMCA_RENDER, std::string(EMCA_SOURCE_DIR) + "/scenes/" + scene + "/scene.xml", "--size", "64x48", "--serve", "0"});
        ASSERT_FALSE(server.address().empty());
        expectWell(server.address(), {});
    }
}

TEST(DoctorCommand, TheReportIsOneLineForEachCheck) {
    const ServingProcess server({EMCA_RENDER, std::string(EMCA_SOURCE_DIR) + "/scenes/cornell-box/scene.xml", "--size", "32x24", "--serve", "0"});
    const Outcome outcome = run({EMCA_CLI, "doctor", server.address(), "--quick", "--spp", "4"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    std::istringstream text(outcome.out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 17u) << outcome.out;
    EXPECT_EQ(lines[0].rfind("handshake     ok       ", 0), 0u) << lines[0];
    EXPECT_EQ(lines[5], "replay        ok       20 of 20 random pixels are replayed exactly, 4 spp.");
    EXPECT_EQ(lines.back(), "15 ok, 0 skipped, 0 warnings, 0 failed");
}

}  // namespace
}  // namespace emca
