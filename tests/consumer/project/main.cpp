// The smallest renderer and the smallest client, in one program: what a person writes who installed EMCA.
#include <cstdio>

#include "emca/client/connection.h"
#include "emca/recorder/recorder.h"
#include "emca/server/server.h"

class GreyRenderer final : public emca::Renderer {
  public:
    emca::RendererInfo info() const override { return {.renderer = "grey", .scene = "nothing", .width = 4, .height = 4}; }
    emca::Camera camera() const override { return {}; }
    std::vector<emca::Mesh> meshes() const override { return {}; }
    emca::Result<emca::RenderedImage> renderImage(const emca::RenderSettings&, emca::RequestMonitor&) override {
        emca::RenderedImage image{.color = emca::Image(4, 4)};
        for (std::size_t i = 0; i < image.color.size(); ++i) image.color.data()[i] = 0.5f;
        return image;
    }
    emca::Result<emca::Color> renderPixel(emca::Pixel, const emca::RenderSettings&, emca::Recording&, emca::RequestMonitor&) override {
        emca::PathRecorder& emca = emca::recorder();
        emca.setPathIndex(1);
        emca.setFinalEstimate(emca::Color(0.5f));
        return emca::Color(0.5f);
    }
};

int main() {
    GreyRenderer renderer;
    auto server = emca::Server::start(renderer);
    if (!server) return std::puts(server.error().message.c_str()), 1;
    auto connection = emca::client::Connection::open({"127.0.0.1", (*server)->port()});
    if (!connection) return std::puts(connection.error().message.c_str()), 1;
    const auto render = (*connection)->render();
    const auto trace = (*connection)->tracePixel({1, 2});
    if (!render || !trace) return std::puts("no reply"), 1;
    const bool good = trace->paths.pathCount() == 1 && trace->replays.at(0).verdict == emca::Verdict::exact;
    std::puts(good ? "replay exact" : "replay differs");
    return good ? 0 : 1;
}
