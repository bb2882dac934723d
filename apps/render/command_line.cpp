#include "command_line.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <vector>

#include "emca/render/image_renderer.h"

namespace emca {

namespace {

/// A whole text as an unsigned number.
template <typename T>
std::optional<T> wholeNumber(std::string_view text) {
    T value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Error usageError(std::string message) { return {ErrorCode::invalidArgument, std::move(message)}; }

/// What CLI11 collects as text; checked afterwards, so that a wrong value gets a sentence of ours.
struct RawCommandLine {
    std::string scene, output, samples, size, integrator, sampler, seed, threads, serve;
    std::vector<std::string> defines, tools;
};

Result<std::uint32_t> parseSamples(const std::string& text) {
    const std::string limit = std::to_string(render::kMaximumSamplesPerPixel);
    const auto value = wholeNumber<std::uint64_t>(text);
    if (!value || *value < 1 || *value > render::kMaximumSamplesPerPixel) {
        return usageError("--spp is " + text + ": give a whole number of samples per pixel from 1 to " + limit + ".");
    }
    return static_cast<std::uint32_t>(*value);
}

Result<std::pair<std::string, std::string>> parseDefine(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        return usageError("-D " + text + " has no name=value: write for example -D spp=64.");
    }
    return std::pair{text.substr(0, equals), text.substr(equals + 1)};
}

Result<CommandLine> check(const RawCommandLine& raw) {
    CommandLine line;
    line.scene = raw.scene;
    if (!raw.output.empty()) line.output = raw.output;
    if (!raw.integrator.empty()) line.integrator = raw.integrator;
    if (!raw.sampler.empty()) line.sampler = raw.sampler;
    if (!raw.samples.empty()) {
        const auto samples = parseSamples(raw.samples);
        if (!samples) return samples.error();
        line.samplesPerPixel = *samples;
    }
    if (!raw.size.empty()) {
        const auto size = parseImageSize(raw.size);
        if (!size) return size.error();
        line.size = *size;
    }
    if (!raw.seed.empty()) {
        line.seed = wholeNumber<std::uint64_t>(raw.seed);
        if (!line.seed) return usageError("--seed is " + raw.seed + ": give a whole number from 0 to 2^64 - 1.");
    }
    if (!raw.threads.empty()) {
        const auto threads = wholeNumber<std::uint32_t>(raw.threads);
        if (!threads || *threads < 1 || *threads > 1024) {
            return usageError("--threads is " + raw.threads + ": give a whole number from 1 to 1024.");
        }
        line.threads = static_cast<int>(*threads);
    }
    for (const std::string& text : raw.defines) {
        auto define = parseDefine(text);
        if (!define) return define.error();
        line.defines[define->first] = define->second;
    }
    if (!raw.serve.empty()) {
        auto serve = adapter::parseServeAddress(raw.serve);
        if (!serve) return serve.error();
        line.serve = *serve;
    }
    if (!raw.tools.empty() && !line.serve) return usageError("--tool is there without --serve: tools answer the clients of a server.");
    line.tools.assign(raw.tools.begin(), raw.tools.end());
    return line;
}

}  // namespace

Result<ImageSize> parseImageSize(const std::string& text) {
    const auto cross = text.find('x');
    if (cross != std::string::npos) {
        const auto width = wholeNumber<std::uint32_t>(std::string_view(text).substr(0, cross));
        const auto height = wholeNumber<std::uint32_t>(std::string_view(text).substr(cross + 1));
        constexpr std::uint32_t kLargest = 65536;
        if (width && height && *width >= 1 && *height >= 1 && *width <= kLargest && *height <= kLargest) {
            return ImageSize{*width, *height};
        }
    }
    return usageError("--size is " + text + ": give WIDTHxHEIGHT in pixels, each from 1 to 65536, for example 640x360.");
}

ParsedCommandLine parseCommandLine(int argc, const char* const* argv) {
    CLI::App app("Renders a scene in Mitsuba's XML, or serves it to EMCA's explorer.", "emca-render");
    app.set_version_flag("--version", "emca-render 0.1");
    RawCommandLine raw;
    app.add_option("scene", raw.scene, "scene file (Mitsuba XML, 0.4 to 0.6 and 2.x to 3.x)")->required()->type_name("SCENE.xml");
    app.add_option("-o,--output", raw.output, "image to write; without it and without --serve: the scene's name with .exr")->type_name("OUT.exr");
    app.add_option("--spp", raw.samples, "samples per pixel, 1 to 1048576")->type_name("N");
    app.add_option("--size", raw.size, "image size in pixels")->type_name("WxH");
    app.add_option("--integrator", raw.integrator, "path or direct")->type_name("NAME");
    app.add_option("--sampler", raw.sampler, "independent or sobol")->type_name("NAME");
    app.add_option("--seed", raw.seed, "another seed gives another noise of the same image")->type_name("N");
    app.add_option("--threads", raw.threads, "how many threads render; without it, one per processor")->type_name("N");
    app.add_option("-D,--define", raw.defines, "value of a $name in the scene file; may be repeated")->type_name("name=value")->allow_extra_args(false);
    app.add_option("--serve", raw.serve, "serve the scene on HOST:PORT; host 127.0.0.1 if not given, port 0 picks one")->type_name("[HOST:]PORT");
    app.add_option("--tool", raw.tools, "with --serve: a server tool in a shared library of its own; may be repeated")->type_name("FILE")->allow_extra_args(false);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // --help, --version
        app.exit(error, std::cout, std::cerr);
        return {std::nullopt, asked ? kExitOk : kExitUsage};
    }
    auto line = check(raw);
    if (!line) {
        std::cerr << "error: " << line.error().message << '\n';
        return {std::nullopt, kExitUsage};
    }
    return {std::move(*line), kExitOk};
}

}  // namespace emca
