#include "emca/server/server.h"

#include <memory>

#include "function_tool.h"
#include "served.h"
#include "sized.h"

using namespace emca;

namespace {

template <typename To, typename From>
void setIfGiven(To& to, From from) {
    if (from != 0) to = static_cast<To>(from);
}

Result<ServerOptions> options(const emca_server_options* given) {
    ServerOptions made;
    if (given == nullptr) return made;
    const auto asked = c::sized(given, EMCA_SIZE_UP_TO(emca_server_options, allow_quit), "emca_server_options");
    if (!asked) return asked.error();
    if (asked->host != nullptr && *asked->host != '\0') made.host = asked->host;
    made.token = c::text(asked->token);
    made.port = asked->port;
    made.allowQuit = asked->allow_quit != 0;
    setIfGiven(made.maximumClients, asked->maximum_clients);
    setIfGiven(made.maximumSamplesPerPixel, asked->maximum_samples_per_pixel);
    setIfGiven(made.maximumPixelsPerTrace, asked->maximum_pixels_per_trace);
    setIfGiven(made.keptImages, asked->kept_images);
    setIfGiven(made.keptSurfaces, asked->kept_surfaces);
    if (asked->handshake_timeout != 0) made.handshakeTimeout = std::chrono::milliseconds(asked->handshake_timeout);
    setIfGiven(made.defaultBudget, asked->default_budget);
    setIfGiven(made.maximumBudget, asked->maximum_budget);
    setIfGiven(made.surfaceBudget, asked->surface_budget);
    setIfGiven(made.maximumSurfaceBudget, asked->maximum_surface_budget);
    if (asked->log != nullptr)
        made.log = [log = asked->log, user = asked->log_user](const std::string& line) { log(user, line.c_str()); };
    return made;
}

}  // namespace

extern "C" {

emca_code emca_server_start(const emca_renderer* renderer, const emca_server_options* given, emca_server** server,
                            emca_error* error) {
    if (server == nullptr)
        return c::invalid(error, "emca_server_start was given null for the server: pass the address of a pointer.");
    *server = nullptr;
    return c::guarded(error, [&]() -> emca_code {
        const auto functions = c::checkedRenderer(renderer);
        if (!functions) return c::fail(error, functions.error());
        auto how = options(given);
        if (!how) return c::fail(error, how.error());
        auto made = std::make_unique<emca_server>(*functions, how->log);
        auto started = Server::start(made->renderer, std::move(how).value());
        if (!started) return c::fail(error, started.error());
        made->server = std::move(started).value();
        made->address = made->server->address();
        *server = made.release();
        return EMCA_OK;
    });
}

uint16_t emca_server_port(const emca_server* server) { return server == nullptr ? 0 : server->server->port(); }
const char* emca_server_address(const emca_server* server) { return server == nullptr ? "" : server->address.c_str(); }

void emca_server_wait(emca_server* server) {
    if (server != nullptr) c::quiet([&] { server->server->wait(); });
}

void emca_server_stop(emca_server* server) {
    if (server != nullptr) c::quiet([&] { server->server->stop(); });
}

void emca_server_destroy(emca_server* server) {
    if (server == nullptr) return;
    c::quiet([&] {
        server->server.reset();  // before the renderer that it calls
        delete server;
    });
}

emca_code emca_server_add_tool(emca_server* server, const emca_tool* tool, emca_error* error) {
    if (server == nullptr) return c::invalid(error, "emca_server_add_tool was given no server.");
    return c::guarded(error, [&]() -> emca_code {
        const auto checked = c::checkedTool(tool);
        if (!checked) return c::fail(error, checked.error());
        const auto added = server->server->addTool(std::make_shared<c::FunctionTool>(*checked));
        return added ? EMCA_OK : c::fail(error, added.error());
    });
}

}  // extern "C"
