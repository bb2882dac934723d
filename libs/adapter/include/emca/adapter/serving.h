#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "emca/adapter/ending_signal.h"
#include "emca/core/result.h"
#include "emca/server/server.h"

namespace emca::adapter {

/// Where to serve.
struct ServeAddress {
    std::string host = "127.0.0.1";
    std::uint16_t port = 0;  ///< 0: the system picks one
    friend bool operator==(const ServeAddress&, const ServeAddress&) = default;
};

/// "PORT" or "HOST:PORT"; an IPv6 host stands in brackets. Errors: invalidArgument, with a sentence about `option`.
/// \param option  that the text was given to, for example "--serve"
Result<ServeAddress> parseServeAddress(const std::string& text, const std::string& option = "--serve");

/// Serves until a client's quit request or the signal. Writes one line, "listening on HOST:PORT", when clients can come.
/// Errors: those of Server::start and Server::addTool.
Result<void> serve(Renderer& renderer, const ServerOptions& options, const std::vector<std::shared_ptr<ServerTool>>& tools,
                   EndingSignal& ending, std::ostream& out);

}  // namespace emca::adapter
