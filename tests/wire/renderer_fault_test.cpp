// Faults of the renderer, and what server tools may do.
#include <stdexcept>

#include "raw_client.h"

namespace emca::test {
namespace {

using client::Connection;

TEST(RendererFault, AnExceptionInTheRendererIsAReply) {
    Served served;
    served.renderer.duringPixel = [](Pixel pixel, RequestMonitor&) {
        if (pixel.x == 3) throw std::runtime_error("the BSDF is negative");
        if (pixel.x == 4) throw 42;
    };
    served.renderer.duringImage = [](RequestMonitor&) { throw std::logic_error("no film"); };
    served.start();
    const auto connection = served.connect();
    const auto thrown = connection->tracePixel({3, 0});
    EXPECT_CODE(thrown, rendererFailed);
    EXPECT_NE(thrown.error().message.find("the BSDF is negative"), std::string::npos);
    EXPECT_CODE(connection->tracePixel({4, 0}), rendererFailed);
    EXPECT_CODE(connection->render(), rendererFailed);
    const auto after = connection->tracePixel({5, 0});
    ASSERT_OK(after);
    EXPECT_EQ(after->paths.pathCount(), 4u) << "nothing is left of the failed recording";
}

class BrokenInfo final : public FakeRenderer {
  public:
    RendererInfo info() const override { throw std::runtime_error("no scene"); }
};

TEST(RendererFault, ARendererThatCannotSayWhatItIsIsNotServed) {
    BrokenInfo renderer;
    EXPECT_CODE(Server::start(renderer), rendererFailed);
}

class WrongSize final : public FakeRenderer {
  public:
    Result<RenderedImage> renderImage(const RenderSettings&, RequestMonitor&) override {
        RenderedImage image;
        image.color = Image(3, 3);
        return image;
    }
    Result<std::vector<Color>> renderPixels(const std::vector<Pixel>&, const RenderSettings&, Recording&, RequestMonitor&) override {
        return std::vector<Color>(5);
    }
};

TEST(RendererFault, ARendererThatReturnsTheWrongSizeIsFoundOut) {
    WrongSize renderer;
    const auto server = Server::start(renderer);
    ASSERT_OK(server);
    const auto connection = Connection::open({"127.0.0.1", (*server)->port()});
    ASSERT_OK(connection);
    EXPECT_CODE((*connection)->render(), rendererFailed);
    EXPECT_CODE((*connection)->tracePixel({0, 0}), rendererFailed);
}

class NotedTool final : public ServerTool {
  public:
    std::string name() const override { return "notes"; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor&) override {
        if (request.empty()) return Error{ErrorCode::invalidArgument, "The notes need at least one byte."};
        if (request[0] == std::byte{1}) throw std::runtime_error("torn page");
        return std::vector<std::byte>(request.rbegin(), request.rend());
    }
    void beginPixel(Pixel) override {
        notes += "(";
        recorder().setPathIndex(1000);
        recorder().addPathData("note", 5.f);
    }
    void endPixel(Pixel) override { notes += ")"; }
    void beginPath(Pixel, std::int64_t) override { notes += "["; }
    void endPath(Pixel, std::int64_t) override { notes += "]"; }
    void beginVertex(std::int32_t) override { notes += "<"; }
    void endVertex(std::int32_t) override { notes += ">"; }
    std::string notes;
};

TEST(Tools, AnswerRequestsAndAddDataToReplays) {
    Served served;
    served.renderer.verticesPerPath = 2;
    served.start();
    const auto tool = std::make_shared<NotedTool>();
    ASSERT_OK(served.server->addTool(tool));
    EXPECT_CODE(served.server->addTool(std::make_shared<NotedTool>()), invalidArgument);
    const auto connection = served.connect();
    EXPECT_EQ(connection->info()->tools, std::vector<std::string>{"notes"});
    const std::vector<std::byte> request{std::byte{2}, std::byte{3}};
    const auto answer = connection->askTool("notes", request);
    ASSERT_OK(answer);
    EXPECT_EQ(*answer, (std::vector<std::byte>{std::byte{3}, std::byte{2}}));
    EXPECT_CODE(connection->askTool("notes", {}), invalidArgument);
    EXPECT_CODE(connection->askTool("notes", std::vector<std::byte>(1, std::byte{1})), rendererFailed);

    client::TraceOptions options;
    options.samplesPerPixel = 1;
    const auto trace = connection->tracePixel({0, 0}, options);
    ASSERT_OK(trace);
    EXPECT_EQ(tool->notes, "([][<><>])");
    const auto path = trace->paths.findPath({0, 0}, 1000);
    ASSERT_TRUE(path);
    const auto columns = trace->paths.find(Scope::path, "note");
    ASSERT_EQ(columns.size(), 1u);
    EXPECT_EQ(trace->paths.last(*columns[0], *path), Value(5.f));
}

}  // namespace
}  // namespace emca::test
