#include "program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <sstream>

#include <unistd.h>

#include "emca/adapter/pixel_renderer.h"
#include "emca/imageio/imageio.h"
#include "emca/server/server.h"

namespace emca::program {
namespace {

namespace fs = std::filesystem;

/// Radiance is the pixel's column, row and the seed.
class Coordinates final : public adapter::PixelWorker {
  public:
    explicit Coordinates(std::uint64_t seed) : seed_(seed) {}
    Color sample(Pixel pixel, std::uint32_t) override { return {float(pixel.x), float(pixel.y), float(seed_)}; }

  private:
    std::uint64_t seed_;
};

class TinyRenderer final : public adapter::PixelRenderer {
  public:
    explicit TinyRenderer(const ProgramLine& line) : line_(line) {}
    RendererInfo info() const override {
        return {.renderer = "tiny", .scene = "three pixels", .width = 3, .height = 2, .samplesPerPixel = std::max(1u, line_.samplesPerPixel)};
    }
    Camera camera() const override { return {}; }
    std::vector<Mesh> meshes() const override { return {}; }

  private:
    Result<adapter::PixelLoop> loopFor(const RenderSettings&) const override {
        if (line_.scene == "dark.xml") return Error{ErrorCode::rendererFailed, "There is no light."};
        const RendererInfo own = info();
        return adapter::PixelLoop{own.width, own.height, own.samplesPerPixel, line_.threads, 16,
                                  [seed = line_.seed](SurfaceRecorder*) -> Result<std::unique_ptr<adapter::PixelWorker>> {
                                      return std::make_unique<Coordinates>(seed);
                                  }};
    }

    ProgramLine line_;
};

/// Stands for a stream of the process while it lives, and says when something is written.
class Captured final : public std::stringbuf {
  public:
    explicit Captured(std::ostream& stream) : stream_(stream), before_(stream.rdbuf(this)) {}
    ~Captured() override { stream_.rdbuf(before_); }
    Captured(const Captured&) = delete;
    Captured& operator=(const Captured&) = delete;
    std::function<void()> onFlush = [] {};

  private:
    int sync() override {
        onFlush();
        return 0;
    }
    std::ostream& stream_;
    std::streambuf* before_;
};

class ProgramTest : public testing::Test {
  protected:
    ProgramTest() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        fs::current_path(folder_);
    }
    ~ProgramTest() override {
        fs::current_path(before_);
        fs::remove_all(folder_);
    }

    /// Runs "tiny" with these arguments; what it says is in out_ and err_.
    int tiny(std::vector<const char*> arguments, std::function<void(Captured&)> onFlush = {}) {
        arguments.insert(arguments.begin(), "tiny");
        Captured out(std::cout), err(std::cerr);
        if (onFlush) out.onFlush = [&] { onFlush(out); };
        const int code = run({.name = "tiny", .renderer = "nobody", .integrators = integrators_, .load = [this](const ProgramLine& line) { return load(line); }},
                             static_cast<int>(arguments.size()), arguments.data());
        out_ = out.str();
        err_ = err.str();
        return code;
    }

    Result<Offer> load(const ProgramLine& line) {
        ++loaded_;
        line_ = line;
        if (line.scene == "broken.xml") return Error{ErrorCode::fileUnreadable, "broken.xml is no scene."};
        if (line.integrator == "radiosity") return Error{ErrorCode::invalidArgument, "There is no radiosity."};
        return Offer{std::make_unique<TinyRenderer>(line), {}};
    }

    fs::path before_ = fs::current_path();
    fs::path folder_ = fs::temp_directory_path() / ("emca_program_test_" + std::to_string(getpid()));
    std::vector<std::string> integrators_;
    int loaded_ = 0;
    ProgramLine line_;
    std::string out_, err_;
};

TEST_F(ProgramTest, WhatItDoesNotUnderstandIsAnErrorOfUsageAndNothingIsLoaded) {
    for (const std::vector<const char*>& wrong : std::vector<std::vector<const char*>>{
             {}, {"a.xml", "--spp", "0"}, {"a.xml", "--spp", "many"}, {"a.xml", "--threads", "0"}, {"a.xml", "--seed", "x"}, {"a.xml", "b.xml"},
             {"a.xml", "--nonsense"}, {"a.xml", "--integrator", "path"}, {"a.xml", "--serve", "host:"}, {"a.xml", "--serve", "65536"}}) {
        EXPECT_EQ(tiny(wrong), kExitUsage) << testing::PrintToString(wrong);
        EXPECT_FALSE(err_.empty()) << testing::PrintToString(wrong);
    }
    EXPECT_EQ(loaded_, 0);
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ProgramTest, TheHelpNamesWhatThereIs) {
    EXPECT_EQ(tiny({"--help"}), kExitOk);
    EXPECT_NE(out_.find("your nobody"), std::string::npos) << out_;
    for (const char* option : {"scene", "-o,--output", "--serve", "--spp", "--seed", "--threads"}) EXPECT_NE(out_.find(option), std::string::npos) << option;
    EXPECT_EQ(out_.find("--integrator"), std::string::npos);
    integrators_ = {"path", "volpath"};
    EXPECT_EQ(tiny({"--help"}), kExitOk);
    EXPECT_NE(out_.find("one of path, volpath;"), std::string::npos) << out_;
    EXPECT_EQ(loaded_, 0);
}

TEST_F(ProgramTest, WritesTheImage) {
    EXPECT_EQ(tiny({"a.xml", "--seed", "7", "--spp", "5", "--threads", "2", "-o", "image.exr"}), kExitOk);
    EXPECT_NE(err_.find("100 %"), std::string::npos);
    EXPECT_EQ(out_, "");
    EXPECT_EQ(line_.scene, "a.xml");
    EXPECT_EQ(line_.samplesPerPixel, 5u);
    EXPECT_EQ(line_.threads, 2u);
    const auto image = imageio::read("image.exr");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width(), 3u);
    EXPECT_EQ(image->height(), 2u);
    EXPECT_EQ(image->color({2, 1}), (Color{2, 1, 7}));
}

TEST_F(ProgramTest, TheImageHasTheNameOfTheSceneIfThereIsNoOther) {
    EXPECT_EQ(tiny({"a.xml"}), kExitOk);
    EXPECT_TRUE(fs::exists("three pixels.exr"));
}

TEST_F(ProgramTest, ExitCodesSayWhoseFaultItIs) {
    integrators_ = {"path"};
    EXPECT_EQ(tiny({"a.xml", "--integrator", "radiosity"}), kExitUsage);
    EXPECT_EQ(err_, "error: There is no radiosity.\n");
    EXPECT_EQ(tiny({"broken.xml"}), kExitInput);
    EXPECT_EQ(err_, "error: broken.xml is no scene.\n");
    EXPECT_EQ(tiny({"a.xml", "-o", "nowhere/image.exr"}), kExitInput);
    EXPECT_EQ(tiny({"dark.xml", "-o", "image.exr"}), kExitServer);
    EXPECT_EQ(err_, "\nerror: There is no light.\n");
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ProgramTest, AnotherServersPortIsAnErrorOfTheConnection) {
    TinyRenderer other(ProgramLine{});
    const auto server = Server::start(other);
    ASSERT_TRUE(server);
    const std::string address = (*server)->address();
    EXPECT_EQ(tiny({"a.xml", "--serve", address.c_str()}), kExitConnection);
    EXPECT_EQ(out_, "");
}

TEST_F(ProgramTest, ServesUntilTheSignal) {
    const auto end = [](Captured& out) {
        if (out.str().starts_with("listening on 127.0.0.1:")) kill(getpid(), SIGTERM);
    };
    EXPECT_EQ(tiny({"a.xml", "--serve", "0"}, end), kExitOk);
    EXPECT_TRUE(fs::is_empty(folder_)) << "an image that nobody asked for";
    EXPECT_EQ(tiny({"a.xml", "--serve", "0", "-o", "image.pfm"}, end), kExitOk);
    EXPECT_TRUE(fs::exists("image.pfm"));
    EXPECT_TRUE(out_.starts_with("listening on 127.0.0.1:")) << out_;
}

}  // namespace
}  // namespace emca::program
