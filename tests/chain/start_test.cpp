// What a program loads, and when: a start costs milliseconds, and image formats come when they are asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "emca/imageio/imageio.h"
#include "process.h"

namespace emca {
namespace {

using test::Outcome;
using test::run;

const std::string kScene = std::string(EMCA_SOURCE_DIR) + "/scenes/cornell-box/scene.xml";
const std::string kWork = std::string(EMCA_WORK_DIR) + "/";

TEST(Start, NoProgramBringsOpenImageIoAlong) {
    for (const char* program : {EMCA_RENDER, EMCA_CLI}) {
        const Outcome libraries = run({"/usr/bin/env", "LD_TRACE_LOADED_OBJECTS=1", program});
        ASSERT_NE(libraries.out.find("libc.so"), std::string::npos) << libraries.err;
        EXPECT_EQ(libraries.out.find("OpenImageIO"), std::string::npos) << program;
        const auto lines = std::count(libraries.out.begin(), libraries.out.end(), '\n');
        EXPECT_LT(lines, 40) << libraries.out;
    }
}

TEST(Start, TheModuleIsFoundByPrograms) {
    const std::string png = kWork + "module.png";
    std::filesystem::remove(png);
    const Outcome rendered = run({EMCA_RENDER, kScene, "--size", "8x6", "--spp", "4", "-o", png});
    ASSERT_EQ(rendered.exitCode, 0) << rendered.err;
    const Result<Image> image = imageio::read(png);
    ASSERT_TRUE(image.ok()) << image.error().message;
    EXPECT_EQ(image->width(), 8u);
}

}  // namespace
}  // namespace emca
