// emca-bridge: a server of the published EMCA (2021) as a server of today's.

#include <iostream>

#include "command_line.h"

namespace emca::bridge {

namespace {

constexpr int kExitInput = 3, kExitConnection = 4;

int fail(const Error& error, int exitCode) {
    std::cerr << "error: " << error.message << std::endl;
    return exitCode;
}

bool isAboutConnection(ErrorCode code) {
    return code == ErrorCode::connectionFailed || code == ErrorCode::connectionLost || code == ErrorCode::timedOut ||
           code == ErrorCode::protocolViolation || code == ErrorCode::addressInUse;
}

int run(CommandLine line) {
    adapter::EndingSignal ending;
    const auto log = [](const std::string& remark) { std::cerr << remark << std::endl; };
    line.server.log = line.bridge.log = log;
    auto server = PublishedServer::open(line.server);
    if (!server) return fail(server.error(), kExitConnection);
    auto renderer = BridgeRenderer::make(**server, line.bridge);
    if (!renderer) return fail(renderer.error(), isAboutConnection(renderer.error().code) ? kExitConnection : kExitInput);
    ServerOptions options;
    options.host = line.serve.host;
    options.port = line.serve.port;
    options.allowQuit = line.allowQuit;
    options.log = log;
    if (auto served = adapter::serve(**renderer, options, {}, ending, std::cout); !served) return fail(served.error(), kExitConnection);
    return 0;
}

}  // namespace

}  // namespace emca::bridge

int main(int argc, char** argv) {
    auto parsed = emca::bridge::parseCommandLine(argc, argv);
    return parsed.commandLine ? emca::bridge::run(std::move(*parsed.commandLine)) : parsed.exitCode;
}
