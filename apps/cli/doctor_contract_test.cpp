// `emca doctor` as scripts see it: exit codes, text and JSON.
#include <thread>

#include "command.h"
#include "json.h"
#include "program_for_tests.h"
#include "served.h"

namespace emca::cli {
namespace {

class DoctorCommand : public ProgramTest {
  protected:
    void SetUp() override { served.start(); }
    std::string address() const { return served.address().text(); }
    test::Served served;
};

TEST_F(DoctorCommand, WarningsAreNoFailures) {
    const Finished f = run({"doctor", address(), "--only", "handshake,camera-rays", "--pixels", "6"});
    EXPECT_EQ(f.exitCode, Exit::ok) << f.err;
    EXPECT_NE(f.out.find("camera-rays   warning  "), std::string::npos) << f.out << "the fake renderer's paths are no paths of its camera";
    EXPECT_NE(f.out.find("\n1 ok, 0 skipped, 1 warning, 0 failed\n"), std::string::npos) << f.out;
    EXPECT_EQ(f.err, "");
}

TEST_F(DoctorCommand, AFailedCheckIsOneAndNamesThePixel) {
    served.renderer.disturbReplay = [](Pixel p, Color c) { return p.x % 2 == 0 ? c * 2.f : c; };
    const Finished f = run({"doctor", address(), "--only", "replay,sums", "--pixels", "30", "--spp", "2"});
    EXPECT_EQ(f.exitCode, Exit::assertionFalse) << f.err;
    EXPECT_NE(f.out.find("replay        failed   "), std::string::npos) << f.out;
    EXPECT_NE(f.out.find("\nreplay: emca pixel " + address() + " "), std::string::npos) << f.out;
    EXPECT_NE(f.out.find(" --spp 2\n"), std::string::npos) << f.out;

    const Finished asJson = run({"doctor", address(), "--only", "replay", "--pixels", "30", "--spp", "2", "--json"});
    EXPECT_EQ(asJson.exitCode, Exit::assertionFalse);
    const Json report = Json::parse(asJson.out);
    EXPECT_EQ(report["address"], address());
    EXPECT_EQ(report["renderer"], "fake 1.0");
    EXPECT_EQ(report["spp"], 2);
    EXPECT_EQ(report["protocol"], 1);
    EXPECT_EQ(report["counts"]["failed"], 1);
    ASSERT_EQ(report["checks"].size(), 1u);
    const Json& check = report["checks"][0];
    EXPECT_EQ(check["check"], "replay");
    EXPECT_EQ(check["outcome"], "failed");
    EXPECT_EQ(check["figures"]["pixels"], 30);
    EXPECT_EQ(int(check["figures"]["exact"]) + int(check["figures"]["different"]), 30);
    EXPECT_GT(check["figures"]["different"], 0);
    EXPECT_EQ(check["figures"]["largestDeviation"], 0.5);
    ASSERT_EQ(check["pixels"].size(), 5u);
    const Json& worst = check["pixels"][0];
    EXPECT_EQ(int(worst["pixel"][0]) % 2, 0);
    EXPECT_EQ(worst["command"], "emca pixel " + address() + " " + worst["pixel"][0].dump() + " " + worst["pixel"][1].dump() + " --spp 2");
}

TEST_F(DoctorCommand, TheSeedChoosesThePixels) {
    const auto pixels = [&](const char* seed) {
        served.renderer.disturbReplay = [](Pixel, Color c) { return c * 2.f; };
        const Finished f = run({"doctor", address(), "--only", "replay", "--pixels", "5", "--pixel-seed", seed, "--json"});
        return Json::parse(f.out)["checks"][0]["pixels"].dump();
    };
    EXPECT_EQ(pixels("3"), pixels("3"));
    EXPECT_NE(pixels("3"), pixels("4"));
}

TEST_F(DoctorCommand, WrongUseIsTwo) {
    expectError({"doctor", address(), "--pixels", "0"}, Exit::usage, "--pixels");
    expectError({"doctor", address(), "--only", "horoscope"}, Exit::usage, "horoscope");
    expectError({"doctor", address(), "--spp", "x"}, Exit::usage, "--spp");
    expectError({"doctor", "host:port"}, Exit::input, "host:port");
}

TEST_F(DoctorCommand, NoRendererIsFour) {
    const std::string gone = address();
    served.server.reset();
    const Finished f = run({"doctor", gone});
    EXPECT_EQ(f.exitCode, Exit::connection);
    EXPECT_EQ(f.out.rfind("handshake     failed   ", 0), 0u) << f.out;
    EXPECT_NE(f.err.find("error: "), std::string::npos);
    EXPECT_EQ(f.err.find('\n'), f.err.size() - 1) << f.err;
    const Finished asJson = run({"doctor", gone, "--json"});
    EXPECT_EQ(asJson.exitCode, Exit::connection);
    const Json report = Json::parse(asJson.out);
    EXPECT_EQ(report["complete"], false);
    EXPECT_TRUE(report["renderer"].is_null());
    EXPECT_EQ(report["checks"][0]["figures"]["error"], "connectionFailed");
}

TEST_F(DoctorCommand, InterruptGivesUp) {
    test::Gate begun;
    served.renderer.duringImage = [&](RequestMonitor& monitor) {
        begun.open();
        for (int i = 0; i < 60000 && !monitor.cancelled(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    const pid_t child = program.start({"doctor", address()});
    ASSERT_TRUE(begun.wait());
    ::kill(child, SIGINT);
    const Finished f = program.finish(child);
    EXPECT_EQ(f.exitCode, Exit::interrupted) << f.err;
    EXPECT_NE(f.err.find("given up"), std::string::npos) << f.err;
}

}  // namespace
}  // namespace emca::cli
