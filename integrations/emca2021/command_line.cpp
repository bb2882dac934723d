#include "command_line.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace emca::bridge {

namespace {

constexpr int kExitUsage = 2;

bool number(const std::string& text, std::uint32_t& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value > 0;
}

Result<void> parseSize(const std::string& text, BridgeOptions& options) {
    const std::size_t x = text.find('x');
    if (x == std::string::npos || !number(text.substr(0, x), options.width) || !number(text.substr(x + 1), options.height)) {
        return Error{ErrorCode::invalidArgument, "--size \"" + text + "\" is no size: write WIDTHxHEIGHT in pixels, for example 640x480."};
    }
    return {};
}

}  // namespace

ParsedCommandLine parseCommandLine(int argc, const char* const* argv) {
    CommandLine line;
    CLI::App app("Shows a server of the published EMCA (2021) in today's explorer: connects to it and serves what it says.", "emca-bridge");
    std::string server, serve, size, axis = "auto";
    std::vector<std::string> folders;
    double timeout = 300;
    app.add_option("SERVER", server, "HOST:PORT of the published server; it listens at port 50013")->required();
    app.add_option("--serve", serve, "[HOST:]PORT where the bridge listens; 0: any free port of this machine")->required();
    app.add_option("--size", size, "WIDTHxHEIGHT of the image, which is not on the wire; else it is rendered once with one sample per pixel");
    app.add_option("--image-folder", folders, "FROM=TO: where a folder of the server's machine is on this one; may be repeated")->allow_extra_args(false);
    app.add_option("--fov-axis", axis, "what the server's field of view spans: vertical, horizontal or auto (horizontal for Mitsuba)")
        ->check(CLI::IsMember({"auto", "vertical", "horizontal"}))->capture_default_str();
    app.add_option("--timeout", timeout, "seconds that the server may think about a pixel; images may take any time")->check(CLI::Range(0.1, 1e6))->capture_default_str();
    app.add_flag("--allow-quit", line.allowQuit, "a client may end the bridge");
    app.add_flag("--quit-server", line.server.quitAtEnd, "at its end, the bridge ends the published server too");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return {std::nullopt, app.exit(error) == 0 ? 0 : kExitUsage};
    }
    const auto complain = [](const Error& error) {
        std::cerr << "error: " << error.message << std::endl;
        return ParsedCommandLine{std::nullopt, kExitUsage};
    };
    const auto from = adapter::parseServeAddress(server, "SERVER");
    if (!from) return complain(from.error());
    line.server.host = from->host;
    line.server.port = from->port;
    const auto to = adapter::parseServeAddress(serve, "--serve");
    if (!to) return complain(to.error());
    line.serve = *to;
    if (!size.empty()) {
        if (auto parsed = parseSize(size, line.bridge); !parsed) return complain(parsed.error());
    }
    for (const std::string& folder : folders) {
        auto mapping = FolderMapping::parse(folder);
        if (!mapping) return complain(mapping.error());
        line.bridge.folders.push_back(std::move(mapping).value());
    }
    line.bridge.axis = axis == "auto" ? FieldOfViewAxis::automatic : axis == "vertical" ? FieldOfViewAxis::vertical : FieldOfViewAxis::horizontal;
    line.server.answerLimit = std::chrono::milliseconds(std::llround(timeout * 1000));
    return {std::move(line), 0};
}

}  // namespace emca::bridge
