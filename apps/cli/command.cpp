#include "command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <iostream>

#include "version.h"

namespace emca::cli {
namespace {

constexpr const char* kDescription =
    "Asks a renderer that serves EMCA (emca-render SCENE.xml --serve PORT) what a pixel is made of.";
constexpr const char* kExamples =
    "Examples:\n"
    "  emca info localhost:50013\n"
    "  emca render localhost:50013 -o cornell.exr --spp 256\n"
    "  emca pixel localhost:50013 117 64\n"
    "  emca pixel localhost:50013 117 64 --json | jq '.paths[] | select(.depth > 5) | .estimate'\n"
    "  emca pixel localhost:50013 117 64 --against cornell.exr\n"
    "  emca layers localhost:50013 --list\n"
    "\n"
    "Exit codes: 0 ok, 2 usage, 3 input, 4 connection, 5 renderer, 130 interrupted.";

/// CLI11 takes "-5" for an option nobody knows; the person meant a number.
bool isNegativeNumber(const std::string& argument) {
    return argument.size() > 1 && argument[0] == '-' &&
           (std::isdigit(static_cast<unsigned char>(argument[1])) || argument[1] == '.');
}

}  // namespace

int exitCodeOf(ErrorCode code) {
    switch (code) {
        case ErrorCode::invalidArgument:
        case ErrorCode::pixelOutOfRange:
        case ErrorCode::notSupported:
        case ErrorCode::fileNotFound:
        case ErrorCode::fileUnreadable:
        case ErrorCode::fileUnwritable:
        case ErrorCode::tooLarge:
        case ErrorCode::parseFailed:
            return Exit::input;
        case ErrorCode::connectionFailed:
        case ErrorCode::connectionLost:
        case ErrorCode::timedOut:
        case ErrorCode::protocolViolation:
        case ErrorCode::versionMismatch:
        case ErrorCode::refused:
        case ErrorCode::addressInUse:
            return Exit::connection;
        case ErrorCode::cancelled:
        case ErrorCode::internal:
        case ErrorCode::rendererFailed:
        case ErrorCode::outOfMemory:
            break;
    }
    return Exit::server;
}

int fail(const Error& error) {
    fmt::print(stderr, "error: {}\n", error.message);
    return exitCodeOf(error.code);
}

int failUsage(const std::string& sentence) {
    fmt::print(stderr, "error: {}\n", sentence);
    return Exit::usage;
}

Result<std::unique_ptr<client::Connection>> connect(const std::string& address) {
    Result<client::Address> parsed = client::Address::parse(address);
    if (!parsed) return parsed.error();
    return client::Connection::open(*parsed);
}

int run(std::vector<std::string> arguments) {
    CLI::App app(kDescription, "emca");
    app.set_version_flag("--version", std::string("emca ") + kVersion);
    app.footer(kExamples);
    app.require_subcommand(1);
    Run chosen;
    for (const AddCommand add : commands()) add(app, chosen);

    const auto negative = std::find_if(arguments.begin(), arguments.end(), isNegativeNumber);
    if (negative != arguments.end())
        return failUsage(
            fmt::format("{} is negative; coordinates, samples and seeds are whole numbers from 0 on.", *negative));
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
        const bool asked = error.get_exit_code() == 0;  // --help, --version
        app.exit(error, std::cout, std::cerr);
        return asked ? Exit::ok : Exit::usage;
    }
    return chosen();
}

}  // namespace emca::cli
