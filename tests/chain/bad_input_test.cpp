// Bad input gives one clear sentence and the right exit code, and harms nobody.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "process.h"

namespace emca {
namespace {

using test::Outcome;
using test::run;
using test::ServingProcess;

const std::string kBox = std::string(EMCA_SOURCE_DIR) + "/scenes/cornell-box/scene.xml";
const std::string kWork = std::string(EMCA_WORK_DIR) + "/";

std::string written(const std::string& name, const std::string& text) {
    std::ofstream(kWork + name) << text;
    return kWork + name;
}

/// A sentence on stderr that contains the words, and no other noise such as a stack trace.
void expectSentence(const Outcome& outcome, int exitCode, std::initializer_list<const char*> words) {
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.out << outcome.err;
    for (const char* word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << "\"" << word << "\" is not in: " << outcome.err;
    EXPECT_EQ(outcome.err.find("terminate called"), std::string::npos) << outcome.err;
}

const char* kSceneWith = R"(<scene version="3.0.0"><integrator type="path"/>
<sensor type="perspective"><transform name="to_world"><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/></film></sensor>
<emitter type="constant"/>
)";

TEST(BadInput, MissingScene) { expectSentence(run({EMCA_RENDER, kWork + "no-such.xml", "-o", kWork + "x.exr"}), 3, {"no-such.xml"}); }

TEST(BadInput, BrokenXmlIsNamedWithItsLine) {
    const std::string file = written("broken.xml", "<scene version=\"3.0.0\">\n  <shape type=\"sphere\">\n</scene>\n");
    expectSentence(run({EMCA_RENDER, file, "-o", kWork + "x.exr"}), 3, {"broken.xml:"});
}

TEST(BadInput, AnAbsentTextureIsNamedAndTheRestRenders) {
    const std::string file = written("absent-texture.xml", std::string(kSceneWith) +
        R"(<shape type="sphere"><bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="nowhere.png"/></texture></bsdf></shape></scene>)");
    const Outcome outcome = run({EMCA_RENDER, file, "--spp", "4", "-o", kWork + "absent-texture.exr"});
    expectSentence(outcome, 0, {"nowhere.png", "absent-texture.xml:"});
    EXPECT_TRUE(std::filesystem::exists(kWork + "absent-texture.exr"));
}

TEST(BadInput, AnUnknownPluginIsNamedAndTheRestRenders) {
    const std::string file = written("unknown.xml", std::string(kSceneWith) +
        R"(<shape type="sphere"><bsdf type="velvet"><float name="fuzz" value="1"/></bsdf></shape><shape type="teapot"/></scene>)");
    expectSentence(run({EMCA_RENDER, file, "--spp", "4", "-o", kWork + "unknown.exr"}), 0, {"velvet", "teapot", "unknown.xml:"});
}

TEST(BadInput, ANanVertexIsNamedAndTheRestRenders) {
    written("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
    const std::string file = written("nan.xml", std::string(kSceneWith) + R"(<shape type="obj"><string name="filename" value="nan.obj"/></shape></scene>)");
    expectSentence(run({EMCA_RENDER, file, "--spp", "4", "-o", kWork + "nan.exr"}), 0, {"nan.obj"});
}

TEST(BadInput, SamplesPerPixelHaveLimits) {
    expectSentence(run({EMCA_RENDER, kBox, "--spp", "0", "-o", kWork + "x.exr"}), 2, {"0"});
    expectSentence(run({EMCA_RENDER, kBox, "--spp", "1000000000", "-o", kWork + "x.exr"}), 2, {"1000000000"});
    expectSentence(run({EMCA_RENDER, kBox, "--spp", "many", "-o", kWork + "x.exr"}), 2, {"many"});
}

TEST(BadInput, NobodyListens) { expectSentence(run({EMCA_CLI, "info", "127.0.0.1:1"}), 4, {"127.0.0.1:1"}); }

class BadRequests : public testing::Test {
  protected:
    static void SetUpTestSuite() { server_ = new ServingProcess({EMCA_RENDER, kBox, "--size", "32x24", "--spp", "4", "--serve", "0"}); }
    static void TearDownTestSuite() { delete server_; }
    void SetUp() override { ASSERT_FALSE(server_->address().empty()); }
    void TearDown() override {
        EXPECT_TRUE(server_->alive());
        EXPECT_EQ(run({EMCA_CLI, "pixel", server_->address(), "3", "4"}).exitCode, 0) << "others are served as before";
    }
    int connected() const {
        const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(std::uint16_t(server_->port()));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
        return descriptor;
    }
    static ServingProcess* server_;
};
ServingProcess* BadRequests::server_ = nullptr;

TEST_F(BadRequests, APixelOutsideTheImage) {
    expectSentence(run({EMCA_CLI, "pixel", server_->address(), "32", "0"}), 3, {"32"});
    expectSentence(run({EMCA_CLI, "pixel", server_->address(), "-1", "0"}), 2, {"-1"});
}

TEST_F(BadRequests, SamplesPerPixelHaveLimits) {
    expectSentence(run({EMCA_CLI, "pixel", server_->address(), "1", "1", "--spp", "0"}), 2, {"0"});
    EXPECT_NE(run({EMCA_CLI, "pixel", server_->address(), "1", "1", "--spp", "1000000000"}).exitCode, 0);
    EXPECT_NE(run({EMCA_CLI, "render", server_->address(), "-o", kWork + "x.exr", "--spp", "1000000000"}).exitCode, 0);
}

TEST_F(BadRequests, ThePortIsInUse) {
    expectSentence(run({EMCA_RENDER, kBox, "--serve", std::to_string(server_->port())}), 4, {std::to_string(server_->port()).c_str()});
}

TEST_F(BadRequests, GarbageOnThePort) {
    for (const std::string& garbage : {std::string("GET / HTTP/1.1\r\nHost: x\r\n\r\n"), std::string(100000, '\xff'), std::string(64, '\0')}) {
        const int descriptor = connected();
        (void)!send(descriptor, garbage.data(), garbage.size(), MSG_NOSIGNAL);
        close(descriptor);
    }
}

TEST_F(BadRequests, ClientsThatSayNothingOrVanish) {
    std::vector<int> silent;
    for (int i = 0; i < 4; ++i) silent.push_back(connected());
    EXPECT_EQ(run({EMCA_CLI, "info", server_->address()}).exitCode, 0);
    for (const int descriptor : silent) close(descriptor);
    // A command killed while its reply is on the way.
    for (int i = 0; i < 3; ++i)
        run({"timeout", "-s", "KILL", "0.05", EMCA_CLI, "render", server_->address(), "--spp", "4096", "-o", kWork + "x.exr"});
}

}  // namespace
}  // namespace emca
