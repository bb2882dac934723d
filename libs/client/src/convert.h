#pragma once

#include "emca/client/connection.h"
#include "emca/protocol/messages.h"

/// Messages as what the public headers show, and back: the same for what came over the wire and for what was saved.
namespace emca::client {

ServerInfo infoOf(protocol::Info message);
protocol::Info messageOf(const ServerInfo& info);

/// `totalSeconds` is not part of the message.
Trace traceOf(protocol::TraceResult message);
protocol::TraceResult messageOf(const Trace& trace);

}  // namespace emca::client
