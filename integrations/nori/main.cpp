// emca-nori: renders a scene with a person's own Nori, or serves it to EMCA's explorer.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "emca/adapter/serving.h"
#include "emca/imageio/imageio.h"
#include "nori_renderer.h"

namespace emca::nori_adapter {

namespace {

enum ExitCode : int { kExitOk = 0, kExitUsage = 2, kExitInput = 3, kExitConnection = 4, kExitServer = 5 };

struct CommandLine {
    std::string scene, output, serve;
    NoriOptions options;
};

int fail(const Error& error, int exitCode) {
    std::cerr << "error: " << error.message << std::endl;
    return exitCode;
}

/// Shows how far a render is, where a person looks.
class Progress final : public RequestMonitor {
  public:
    ~Progress() override { std::cerr << '\n'; }
    bool cancelled() const override { return false; }
    void progress(double fraction) override {
        const int percent = static_cast<int>(100 * fraction);
        const std::scoped_lock lock(mutex_);
        if (percent > percent_) std::cerr << "\r" << (percent_ = percent) << " %" << std::flush;
    }
    void preview(PixelRect, const std::vector<Color>&) override {}

  private:
    std::mutex mutex_;
    int percent_ = -1;
};

int renderToFile(NoriRenderer& renderer, const std::string& output) {
    if (auto writable = imageio::checkWritable(output); !writable) return fail(writable.error(), kExitInput);
    const auto image = [&] {
        Progress progress;
        return renderer.renderImage({}, progress);
    }();
    if (!image) return fail(image.error(), kExitServer);
    const auto written = imageio::write(output, *image);
    return written ? kExitOk : fail(written.error(), kExitInput);
}

int run(const CommandLine& line) {
    std::optional<adapter::EndingSignal> ending;  // before any thread
    std::optional<adapter::ServeAddress> address;
    if (!line.serve.empty()) {
        const auto parsed = adapter::parseServeAddress(line.serve);
        if (!parsed) return fail(parsed.error(), kExitUsage);
        address = *parsed;
        ending.emplace();
    }
    auto loaded = LoadedScene::load(line.scene);
    if (!loaded) return fail(loaded.error(), kExitInput);
    const std::shared_ptr<const LoadedScene> scene = std::move(*loaded);
    NoriRenderer renderer(scene, line.options);
    if (!line.output.empty() || !address) {
        if (const int code = renderToFile(renderer, line.output.empty() ? scene->name() + ".exr" : line.output); code != kExitOk) return code;
    }
    if (!address) return kExitOk;
    ServerOptions options;
    options.host = address->host;
    options.port = address->port;
    options.log = [](const std::string& remark) { std::cerr << remark << std::endl; };
    const auto served = adapter::serve(renderer, options, {renderer.lightProbes()}, *ending, std::cout);
    return served ? kExitOk : fail(served.error(), kExitConnection);
}

}  // namespace

}  // namespace emca::nori_adapter

int main(int argc, char** argv) {
    using namespace emca::nori_adapter;
    CLI::App app("Renders a scene with your Nori, or serves it to EMCA's explorer.", "emca-nori");
    CommandLine line;
    app.add_option("scene", line.scene, "scene file of Nori")->required()->type_name("SCENE.xml");
    app.add_option("-o,--output", line.output, "image to write (.exr, .pfm, .png); without it and without --serve: the scene's name with .exr")->type_name("OUT");
    app.add_option("--serve", line.serve, "serve the scene on HOST:PORT; host 127.0.0.1 if not given, port 0 picks one")->type_name("[HOST:]PORT");
    app.add_option("--spp", line.options.samplesPerPixel, "samples per pixel; without it, as the scene says")->type_name("N")->check(CLI::Range(1u, 1u << 20));
    app.add_option("--seed", line.options.seed, "another seed gives another noise of the same image")->type_name("N");
    app.add_option("--threads", line.options.threads, "how many threads render; without it, one per processor")->type_name("N")->check(CLI::Range(1u, 1024u));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return code == 0 ? 0 : 2;
    }
    return run(line);
}
