#pragma once

#include <memory>
#include <string>

#include "emca/server/server.h"
#include "renderer_adapter.h"

/// A server as the caller sees it, with the renderer that it calls.
struct emca_server {
    emca_server(const emca_renderer& functions, std::function<void(const std::string&)> log)
        : renderer(functions, std::move(log)) {}
    emca::c::FunctionRenderer renderer;
    std::unique_ptr<emca::Server> server;
    std::string address;
};
