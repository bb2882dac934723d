#include "emca/adapter/serving.h"

#include <charconv>
#include <limits>
#include <ostream>

namespace emca::adapter {

Result<ServeAddress> parseServeAddress(const std::string& text, const std::string& option) {
    ServeAddress address;
    std::string port = text;
    if (const auto colon = text.rfind(':'); colon != std::string::npos) {
        address.host = text.substr(0, colon);
        port = text.substr(colon + 1);
        if (address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']') {
            address.host = address.host.substr(1, address.host.size() - 2);
        }
    }
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    if (port.empty() || error != std::errc() || end != port.data() + port.size() || number > std::numeric_limits<std::uint16_t>::max() || address.host.empty()) {
        return Error{ErrorCode::invalidArgument, option + " is " + text + ": give PORT or HOST:PORT with a port from 0 to 65535 (0 picks one)."};
    }
    address.port = static_cast<std::uint16_t>(number);
    return address;
}

Result<void> serve(Renderer& renderer, const ServerOptions& options, const std::vector<std::shared_ptr<ServerTool>>& tools,
                   EndingSignal& ending, std::ostream& out) {
    auto server = Server::start(renderer, options);
    if (!server) return server.error();
    for (const auto& tool : tools)
        if (auto added = (*server)->addTool(tool); !added) return added.error();
    ending.setAction([&server] { (*server)->stop(); });
    out << "listening on " << (*server)->address() << std::endl;
    (*server)->wait();
    ending.setAction([] {});  // a second signal must not meet a server that is gone
    return {};
}

}  // namespace emca::adapter
