#include "program.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <mutex>
#include <optional>

#include "emca/adapter/serving.h"
#include "emca/imageio/imageio.h"

namespace emca::program {

namespace {

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

int renderToFile(Renderer& renderer, const std::string& output) {
    if (auto writable = imageio::checkWritable(output); !writable) return fail(writable.error(), kExitInput);
    const auto image = [&] {
        Progress progress;
        return renderer.renderImage({}, progress);
    }();
    if (!image) return fail(image.error(), kExitServer);
    const auto written = imageio::write(output, *image);
    return written ? kExitOk : fail(written.error(), kExitInput);
}

int serve(const Offer& offer, const adapter::ServeAddress& address, adapter::EndingSignal& ending) {
    ServerOptions options;
    options.host = address.host;
    options.port = address.port;
    options.log = [](const std::string& remark) { std::cerr << remark << std::endl; };
    const auto served = adapter::serve(*offer.renderer, options, offer.tools, ending, std::cout);
    return served ? kExitOk : fail(served.error(), kExitConnection);
}

int renderAndServe(const Program& program, const ProgramLine& line) {
    std::optional<adapter::EndingSignal> ending;  // before any thread
    std::optional<adapter::ServeAddress> address;
    if (!line.serve.empty()) {
        const auto parsed = adapter::parseServeAddress(line.serve);
        if (!parsed) return fail(parsed.error(), kExitUsage);
        address = *parsed;
        ending.emplace();
    }
    const auto offer = program.load(line);
    if (!offer) return fail(offer.error(), offer.error().code == ErrorCode::invalidArgument ? kExitUsage : kExitInput);
    if (!line.output.empty() || !address) {
        const std::string output = line.output.empty() ? offer->renderer->info().scene + ".exr" : line.output;
        if (const int code = renderToFile(*offer->renderer, output); code != kExitOk) return code;
    }
    return address ? serve(*offer, *address, *ending) : kExitOk;
}

void addOptions(CLI::App& app, const Program& program, ProgramLine& line) {
    app.add_option("scene", line.scene, "scene file of " + program.renderer)->required()->type_name("SCENE.xml");
    app.add_option("-o,--output", line.output, "image to write (.exr, .pfm, .png); without it and without --serve: the scene's name with .exr")->type_name("OUT");
    app.add_option("--serve", line.serve, "serve the scene on HOST:PORT; host 127.0.0.1 if not given, port 0 picks one")->type_name("[HOST:]PORT");
    app.add_option("--spp", line.samplesPerPixel, "samples per pixel; without it, as the scene says")->type_name("N")->check(CLI::Range(1u, 1u << 20));
    if (!program.integrators.empty()) {
        std::string names;
        for (const std::string& name : program.integrators) names += (names.empty() ? "" : ", ") + name;
        app.add_option("--integrator", line.integrator, "one of " + names + "; without it, as the scene says")->type_name("NAME");
    }
    app.add_option("--seed", line.seed, "another seed gives another noise of the same image")->type_name("N");
    app.add_option("--threads", line.threads, "how many threads render; without it, one per processor")->type_name("N")->check(CLI::Range(1u, 1024u));
}

}  // namespace

int run(const Program& program, int argc, const char* const* argv) {
    CLI::App app("Renders a scene with your " + program.renderer + ", or serves it to EMCA's explorer.", program.name);
    ProgramLine line;
    addOptions(app, program, line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? kExitOk : kExitUsage;
    }
    return renderAndServe(program, line);
}

}  // namespace emca::program
