#include "serving.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "light_probe.h"
#include "mitsuba_renderer.h"

namespace emca::mitsuba06 {

namespace {

std::string environment(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

}  // namespace

const std::vector<std::string>& Serving::propertyNames() {
    static const std::vector<std::string> names{"serve", "host", "port", "token"};
    return names;
}

Serving::Serving(const mts::Properties& properties) {
    std::string asked = properties.getAsString("serve", "");
    if (properties.hasProperty("port")) asked = std::to_string(properties.getInteger("port"));
    if (properties.hasProperty("host")) asked = properties.getString("host") + ":" + (asked.empty() ? "0" : asked);
    if (asked.empty()) asked = environment("EMCA_SERVE");
    token_ = properties.getString("token", environment("EMCA_TOKEN"));
    if (asked.empty()) return;
    auto address = adapter::parseServeAddress(asked, "serve");
    if (!address) throw std::runtime_error("EMCA: " + address.error().message);
    address_ = *address;
}

void Serving::run(mts::Scene& scene, const TracedIntegrator& traced) {
    if (!address_) return;
    // Mitsuba writes its image when this has returned; who serves for hours wants it now.
    scene.getFilm()->develop(&scene, 0);

    MitsubaRenderer renderer(scene, traced);
    ServerOptions options;
    options.host = address_->host;
    options.port = address_->port;
    options.token = token_;
    options.allowQuit = true;
    options.log = [&renderer](const std::string& remark) { renderer.say(mts::EInfo, remark); };
    auto server = Server::start(renderer, options);
    // Told on the terminal even where Mitsuba is to be quiet: its image is done, but somebody waits for the server.
    if (!server) return void(std::cerr << "EMCA: " << server.error().message << std::endl);
    if (auto added = (*server)->addTool(makeLightProbeTool(renderer)); !added)
        return void(std::cerr << "EMCA: " << added.error().message << std::endl);
    {
        const std::lock_guard lock(mutex_);
        running_ = server->get();
    }
    std::cout << "listening on " << (*server)->address() << std::endl;
    (*server)->wait();
    const std::lock_guard lock(mutex_);
    running_ = nullptr;
}

void Serving::stop() {
    const std::lock_guard lock(mutex_);
    if (running_) running_->stop();
}

}  // namespace emca::mitsuba06
