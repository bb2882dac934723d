// Servers, and functions of renderers that fail.
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "everything.h"
#include "served_in_c.h"

namespace emca::test {
namespace {

TEST(ServerInC, SaysWhereItIs) {
    const emca_renderer renderer = everything();
    ServedInC served(renderer);
    EXPECT_GT(emca_server_port(served.server()), 0);
    EXPECT_EQ(std::string(emca_server_address(served.server())),
              "127.0.0.1:" + std::to_string(emca_server_port(served.server())));
    const emca_server_options taken = {EMCA_SIZED(emca_server_options), .port = emca_server_port(served.server())};
    emca_server* second = nullptr;
    emca_error error{};
    EXPECT_EQ(emca_server_start(&renderer, &taken, &second, &error), EMCA_ADDRESS_IN_USE) << error.message;
    EXPECT_EQ(second, nullptr);
    const emca_server_options nowhere = {EMCA_SIZED(emca_server_options), .host = "no such host."};
    EXPECT_EQ(emca_server_start(&renderer, &nowhere, &second, &error), EMCA_INVALID_ARGUMENT) << error.message;
    EXPECT_EQ(emca_server_port(nullptr), 0);
    EXPECT_STREQ(emca_server_address(nullptr), "");
    emca_server_wait(nullptr);
    emca_server_stop(nullptr);
    emca_server_destroy(nullptr);
}

TEST(ServerInC, AsksForItsTokenAndLogs) {
    struct Log {
        std::mutex mutex;
        std::string lines;
    } log;
    const emca_renderer renderer = everything();
    const emca_server_options options = {EMCA_SIZED(emca_server_options), .token = "open sesame",
                                         .maximum_samples_per_pixel = 8, .log_user = &log,
                                         .log = [](void* user, const char* line) {
                                             const std::lock_guard lock(static_cast<Log*>(user)->mutex);
                                             static_cast<Log*>(user)->lines += std::string(line) + "\n";
                                         }};
    ServedInC served(renderer, &options);
    const client::Address address{"127.0.0.1", emca_server_port(served.server())};
    EXPECT_FALSE(client::Connection::open(address).ok());
    const auto known = client::Connection::open(address, {.token = "open sesame"});
    ASSERT_TRUE(known.ok()) << known.error().message;
    EXPECT_FALSE((*known)->render({.samplesPerPixel = 9}).ok());
    EXPECT_TRUE((*known)->render({.samplesPerPixel = 8}).ok());
    EXPECT_FALSE((*known)->quitServer().ok()) << "nobody allowed it";
    const std::lock_guard lock(log.mutex);
    EXPECT_NE(log.lines, "");
}

TEST(ServerInC, EndsWhenItIsStopped) {
    const emca_renderer renderer = everything();
    ServedInC served(renderer);
    std::thread waiting([&] { emca_server_wait(served.server()); });
    emca_server_stop(served.server());
    waiting.join();
}

TEST(RendererInC, ItsErrorsTravel) {
    emca_renderer renderer = everything();
    renderer.render_pixel = [](void*, emca_pixel pixel, const emca_settings*, emca_recording*, emca_monitor*,
                               emca_color*, emca_error* error) -> emca_code {
        switch (pixel.x) {
            case 0:
                return emca_fail(error, EMCA_NOT_SUPPORTED, "Not on Mondays.");
            case 1:
                return EMCA_TOO_LARGE;
            case 2:
                return 12345;
            case 3:
                return -1;
            default:
                throw std::runtime_error("thrown through C");
        }
    };
    ServedInC served(renderer);
    const auto errorAt = [&](std::uint32_t x) { return served.client().tracePixel({x, 0}).error(); };
    EXPECT_EQ(errorAt(0).message, "Not on Mondays.");
    EXPECT_EQ(errorAt(0).code, ErrorCode::notSupported);
    EXPECT_EQ(errorAt(1).code, ErrorCode::tooLarge);
    EXPECT_NE(errorAt(1).message.find("render_pixel"), std::string::npos) << errorAt(1).message;
    EXPECT_EQ(errorAt(2).code, ErrorCode::rendererFailed);
    EXPECT_EQ(errorAt(3).code, ErrorCode::rendererFailed);
    EXPECT_NE(errorAt(4).message.find("thrown through C"), std::string::npos) << errorAt(4).message;
    EXPECT_TRUE(served.client().info().ok()) << "it still serves";
}

TEST(RendererInC, IsToldOfCallsThatMadeNoSense) {
    emca_renderer renderer = everything();
    renderer.render_pixel = [](void*, emca_pixel, const emca_settings*, emca_recording*, emca_monitor*, emca_color*,
                               emca_error*) -> emca_code {
        emca_recorder* emca = emca_thread_recorder();
        emca_set_path_index(emca, 0, 0);
        emca_set_depth_index(emca, 1, EMCA_CAMERA_SUBPATH);
        emca_set_intersection_event(emca, 99, EMCA_DIFFUSE, nullptr);
        return EMCA_OK;
    };
    static std::mutex mutex;
    static std::string lines;
    const emca_server_options options = {EMCA_SIZED(emca_server_options), .log = [](void*, const char* line) {
                                             const std::lock_guard lock(mutex);
                                             lines += line;
                                         }};
    ServedInC served(renderer, &options);
    EXPECT_TRUE(served.client().tracePixel({0, 0}).ok()) << "the rest of the path is good";
    const std::lock_guard lock(mutex);
    EXPECT_NE(lines.find("was ignored: "), std::string::npos) << lines;
}

TEST(RendererInC, ThatCannotSayWhatItIsIsNotServed) {
    emca_renderer renderer = everything();
    emca_server* server = nullptr;
    emca_error error{};
    renderer.info = [](void*, emca_info*, emca_error* e) {
        return emca_fail(e, EMCA_FILE_NOT_FOUND, "There is no scene.");
    };
    EXPECT_EQ(emca_server_start(&renderer, nullptr, &server, &error), EMCA_RENDERER_FAILED);
    EXPECT_NE(std::strstr(error.message, "There is no scene."), nullptr) << error.message;
    renderer.info = [](void*, emca_info* info, emca_error*) -> emca_code {
        info->capability_count = 3;
        info->width = info->height = 1;
        return EMCA_OK;
    };
    EXPECT_EQ(emca_server_start(&renderer, nullptr, &server, &error), EMCA_RENDERER_FAILED) << "a null list";
}

TEST(RendererInC, MayBeCancelled) {
    emca_renderer renderer = everything();
    static std::atomic<bool> began, ended;
    began = ended = false;
    renderer.render_image = [](void*, const emca_settings*, emca_monitor* monitor, emca_image*,
                               emca_error* error) -> emca_code {
        began = true;
        while (!emca_cancelled(monitor)) emca_progress(monitor, 0.5), std::this_thread::yield();
        ended = true;
        return emca_fail(error, EMCA_CANCELLED, "The render was cancelled.");
    };
    ServedInC served(renderer);
    auto cancel = std::make_shared<std::atomic<bool>>(false);
    served.client();
    std::thread asking(
        [&] { EXPECT_EQ(served.client().render({}, {.cancel = cancel}).error().code, ErrorCode::cancelled); });
    while (!began) std::this_thread::yield();
    *cancel = true;
    asking.join();
    EXPECT_TRUE(served.client().info().ok()) << "which waits for the renderer where it is not concurrent, or not";
    while (!ended) std::this_thread::yield();
    EXPECT_FALSE(emca_cancelled(nullptr));
    emca_progress(nullptr, 1);
    emca_preview(nullptr, {0, 0, 1, 1}, nullptr);
}

}  // namespace
}  // namespace emca::test
