#include "command_line.h"

#include <gtest/gtest.h>

#include <vector>

namespace emca {
namespace {

ParsedCommandLine parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "emca-render");
    return parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

TEST(CommandLine, ReadsTheWholeContract) {
    const auto parsed = parse({"-D", "a=1", "scene.xml", "-o", "out.exr", "--spp", "64", "--size", "320x180", "--integrator",
                               "direct", "--sampler", "sobol", "--seed", "18446744073709551615", "--threads", "2", "-Db=x=y",
                               "--serve", "0.0.0.0:50013", "--tool", "a.so", "--tool", "b.so"});
    ASSERT_TRUE(parsed.commandLine);
    const CommandLine& line = *parsed.commandLine;
    EXPECT_EQ(line.scene, "scene.xml");
    EXPECT_EQ(line.output, "out.exr");
    EXPECT_EQ(line.samplesPerPixel, 64u);
    EXPECT_EQ(line.size.width, 320u);
    EXPECT_EQ(line.size.height, 180u);
    EXPECT_EQ(line.integrator, "direct");
    EXPECT_EQ(line.sampler, "sobol");
    EXPECT_EQ(line.seed, 18446744073709551615ull);
    EXPECT_EQ(line.threads, 2);
    EXPECT_EQ(line.defines.at("a"), "1");
    EXPECT_EQ(line.defines.at("b"), "x=y");
    EXPECT_EQ(line.serve, (adapter::ServeAddress{"0.0.0.0", 50013}));
    EXPECT_EQ(line.tools, (std::vector<std::filesystem::path>{"a.so", "b.so"}));
}

TEST(CommandLine, RefusesWhatMakesNoSense) {
    for (const std::vector<const char*>& wrong : std::vector<std::vector<const char*>>{
             {}, {"s.xml", "--spp", "0"}, {"s.xml", "--spp", "1000000000"}, {"s.xml", "--spp", "nan"}, {"s.xml", "--spp", "-4"},
             {"s.xml", "--size", "0x5"}, {"s.xml", "--size", "5"}, {"s.xml", "--size", "5x6x7"}, {"s.xml", "--seed", "x"},
             {"s.xml", "--threads", "0"}, {"s.xml", "--tool", "a.so"}, {"s.xml", "-D", "novalue"}, {"s.xml", "--serve", "65536"}, {"s.xml", "--serve", "host:"},
             {"s.xml", "--serve", ":"}, {"s.xml", "--unknown"}}) {
        const auto parsed = parse(wrong);
        EXPECT_FALSE(parsed.commandLine) << (wrong.empty() ? "no arguments" : wrong.back());
        EXPECT_EQ(parsed.exitCode, kExitUsage);
    }
    EXPECT_EQ(parse({"--help"}).exitCode, kExitOk);
}

}  // namespace
}  // namespace emca
