// Server tools: who may ask whom, beside what they run, and tools in files of their own.
#include <fstream>
#include <future>

#include "emca/server/tool_file.h"
#include "raw_client.h"

namespace emca::test {
namespace {

namespace fs = std::filesystem;

class Echo : public ServerTool {
  public:
    std::string name() const override { return "echo"; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor&) override {
        if (during) during();
        return std::vector<std::byte>(request.begin(), request.end());
    }
    bool observesReplay() const override { return observes; }
    void beginPixel(Pixel) override { ++told; }
    std::function<void()> during;
    bool observes = true;
    std::atomic<int> told = 0;
};

/// Asks the echo, twice.
class Asker final : public ServerTool {
  public:
    std::string name() const override { return "asker"; }
    void setHost(ToolHost& host) override { host_ = &host; }
    Result<std::vector<std::byte>> answer(std::span<const std::byte> request, RequestMonitor& monitor) override {
        if (request.empty()) return host_->ask("nobody", request, monitor);
        auto once = host_->ask("echo", request, monitor);
        return once ? host_->ask("echo", *once, monitor) : std::move(once);
    }

  private:
    ToolHost* host_ = nullptr;
};

TEST(Tools, MayAskEachOther) {
    Served served;
    served.start();
    ASSERT_OK(served.server->addTool(std::make_shared<Asker>()));
    const auto connection = served.connect();
    const std::vector<std::byte> request{std::byte{2}, std::byte{3}};
    EXPECT_CODE(connection->askTool("asker", request), notSupported);
    ASSERT_OK(served.server->addTool(std::make_shared<Echo>()));
    const auto answer = connection->askTool("asker", request);
    ASSERT_OK(answer);
    EXPECT_EQ(*answer, request);
    EXPECT_CODE(connection->askTool("asker", {}), notSupported);
}

TEST(Tools, AnswerBesideTraces) {
    Served served;
    Gate asked, traced;
    const auto tool = std::make_shared<Echo>();
    tool->during = [&] {
        asked.open();
        EXPECT_TRUE(traced.wait());
    };
    served.start();
    ASSERT_OK(served.server->addTool(tool));
    const auto connection = served.connect();
    auto answer = std::async(std::launch::async, [&] { return connection->askTool("echo", std::vector<std::byte>(3)); });
    ASSERT_TRUE(asked.wait());
    EXPECT_TRUE(connection->tracePixel({2, 2}).ok()) << "the tool is still waiting for this trace";
    traced.open();
    EXPECT_TRUE(answer.get().ok());
}

TEST(Tools, AreToldOfReplaysIfTheyWant) {
    for (const bool observes : {true, false}) {
        Served served;
        served.start();
        const auto tool = std::make_shared<Echo>();
        tool->observes = observes;
        ASSERT_OK(served.server->addTool(tool));
        ASSERT_OK(served.connect()->tracePixel({0, 0}));
        EXPECT_EQ(tool->told, observes ? 1 : 0);
    }
}

TEST(ToolFiles, ThatAreNoneAreRefusedWithAWord) {
    const fs::path folder = fs::path(EMCA_BINARY_DIR) / "tool_file_test";
    fs::create_directories(folder);
    EXPECT_CODE(loadTool(folder / "nowhere.so"), fileNotFound);
    const fs::path text = folder / "text.so";
    std::ofstream(text) << "no library";
    const auto refused = loadTool(text);
    EXPECT_CODE(refused, fileUnreadable);
    EXPECT_NE(refused.error().message.find("text.so"), std::string::npos);
    EXPECT_CODE(loadTool(folder), fileUnreadable);
}

}  // namespace
}  // namespace emca::test
