// The connection to a published server, with every fault that such servers have.
#include "published_server.h"

#include <gtest/gtest.h>

#include <future>

#include "published_for_tests.h"

namespace emca::bridge {
namespace {

using namespace test;
using std::chrono::milliseconds;

constexpr milliseconds kLong{20000};

PublishedServerOptions optionsFor(std::uint16_t port) {
    PublishedServerOptions options;
    options.port = port;
    options.connectLimit = options.answerLimit = options.silenceLimit = options.goodbyeLimit = kLong;
    return options;
}

/// With limits for faults that show as silence.
PublishedServerOptions impatient(std::uint16_t port) {
    PublishedServerOptions options = optionsFor(port);
    options.connectLimit = options.answerLimit = options.silenceLimit = milliseconds(150);
    options.goodbyeLimit = milliseconds(50);
    return options;
}

std::unique_ptr<PublishedServer> opened(PublishedServerOptions options) {
    auto server = PublishedServer::open(std::move(options));
    EXPECT_TRUE(server.ok()) << server.error().message;
    return server.ok() ? std::move(server).value() : nullptr;
}

TEST(PublishedServer, EverythingIsAskedOverOneConnectionThatEndsWithAGoodbye) {
    for (const bool swapped : {false, true}) {
        Show show = exampleShow();
        show.swapped = swapped;
        show.imagePath = "/tmp/somewhere.exr";
        PublishedServerForTests there(show);
        {
            const auto server = opened(optionsFor(there.port()));
            ASSERT_TRUE(server);
            EXPECT_EQ(server->info().renderer, "in-test renderer");
            EXPECT_EQ(server->info().samplesPerPixel, 6u);
            EXPECT_EQ(server->plugins(), (std::vector<std::int16_t>{17, -3}));
            const auto camera = server->camera();
            ASSERT_TRUE(camera.ok());
            EXPECT_EQ(camera->origin, (Vec3f{0, 0, 5}));
            const auto scene = server->scene();
            ASSERT_TRUE(scene.ok());
            EXPECT_EQ(scene->shapes.size(), 2u);
            const auto image = server->image(8);
            ASSERT_TRUE(image.ok()) << image.error().message;
            EXPECT_EQ(image->path, "/tmp/somewhere.exr");
            ASSERT_TRUE(image->scene.has_value());
            EXPECT_EQ(image->scene->shapes[0].faceColors.size(), 8u);
            const auto pixel = server->pixel({3, 4}, 6);
            ASSERT_TRUE(pixel.ok()) << pixel.error().message;
            EXPECT_EQ(pixel->paths.size(), 5u);
            EXPECT_EQ(pixel->remark, "");
        }
        EXPECT_EQ(there.connections(), 1);
        EXPECT_EQ(there.goodbyes(), 1);
        EXPECT_FALSE(there.quit());
        EXPECT_EQ(there.pixels().at(0), (std::array<std::uint32_t, 3>{3, 4, 6}));
    }
}

TEST(PublishedServer, QuitIsSentOnlyIfAskedFor) {
    PublishedServerForTests there(exampleShow());
    PublishedServerOptions options = optionsFor(there.port());
    options.quitAtEnd = true;
    opened(options).reset();
    EXPECT_TRUE(there.quit());
}

TEST(PublishedServer, OnePathTooManyIsSeenAtOnceWithoutWaiting) {
    Show show = exampleShow();
    show.tooMany = 1;
    PublishedServerForTests there(show);
    const auto server = opened(optionsFor(there.port()));  // patient: who waited would not be done
    for (int i = 0; i < 3; ++i) {
        const auto pixel = server->pixel({1, 1}, 6);
        ASSERT_TRUE(pixel.ok()) << pixel.error().message;
        EXPECT_EQ(pixel->paths.size(), 5u);
        EXPECT_NE(pixel->remark.find("announced 6 paths and sent 5"), std::string::npos);
        EXPECT_FALSE(pixel->endedBySilence);
    }
    EXPECT_EQ(there.connections(), 1) << "the connection stays good";
}

TEST(PublishedServer, OnePathTooManyAndSilenceKeepsWhatCameAndConnectsAgain) {
    Show show = exampleShow();
    show.tooMany = 1;
    show.namesOnce = true;
    PublishedServerForTests there(show);
    PublishedServerOptions options = impatient(there.port());
    {
        const auto server = opened(options);
        const auto pixel = server->pixel({1, 1}, 6);
        ASSERT_TRUE(pixel.ok()) << pixel.error().message;
        EXPECT_EQ(pixel->paths.size(), 5u);
        EXPECT_TRUE(pixel->endedBySilence);
        EXPECT_NE(pixel->remark.find("announced 6"), std::string::npos);
    }
    EXPECT_EQ(there.goodbyes(), 1) << "it was left with a word";
}

TEST(PublishedServer, ARendererThatFailsIsReportedAndTheNextRequestWorks) {
    Show show = exampleShow();
    show.unanswered = {{MessageId::requestPixel, true}, {MessageId::requestImage, true}};
    PublishedServerForTests there(show);
    const auto server = opened(optionsFor(there.port()));
    const auto pixel = server->pixel({1, 1}, 6);
    ASSERT_FALSE(pixel.ok());
    EXPECT_EQ(pixel.error().code, ErrorCode::rendererFailed);
    EXPECT_NE(pixel.error().message.find("no answer when it was asked for a pixel"), std::string::npos) << pixel.error().message;
    EXPECT_EQ(server->image(1).error().code, ErrorCode::rendererFailed);
    EXPECT_TRUE(server->camera().ok());
    EXPECT_EQ(there.connections(), 1);
}

TEST(PublishedServer, AConnectionThatWasDroppedBetweenRequestsIsOpenedAgain) {
    Show show = exampleShow();
    show.restsAfter = 1;
    PublishedServerForTests there(show);
    const auto server = opened(optionsFor(there.port()));
    for (int i = 0; i < 4; ++i) {
        const auto camera = server->camera();
        ASSERT_TRUE(camera.ok()) << camera.error().message;
    }
    EXPECT_EQ(there.connections(), 4);
    EXPECT_EQ(there.requests().size(), 4u);
}

TEST(PublishedServer, NobodyThereAnotherProtocolAndAnotherSceneAreSaid) {
    std::uint16_t free = 0;
    {
        PublishedServerForTests gone(exampleShow());
        free = gone.port();
    }
    const auto nobody = PublishedServer::open(optionsFor(free));
    ASSERT_FALSE(nobody.ok());
    EXPECT_EQ(nobody.error().code, ErrorCode::connectionFailed);

    Show wrong = exampleShow();
    wrong.hello = 0x4854;  // "TH", as an HTTP server may begin
    PublishedServerForTests other(wrong);
    const auto refused = PublishedServer::open(impatient(other.port()));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::protocolViolation);
    EXPECT_NE(refused.error().message.find("no published EMCA server"), std::string::npos) << refused.error().message;

    Show quiet = exampleShow();
    quiet.silentAfter = 0;
    PublishedServerForTests mute(quiet);
    const auto silent = PublishedServer::open(impatient(mute.port()));
    ASSERT_FALSE(silent.ok());
    EXPECT_NE(silent.error().message.find("should speak first, but was silent"), std::string::npos) << silent.error().message;

    Show changing = exampleShow();
    changing.restsAfter = 1;
    int asked = 0;
    changing.alter = [&asked](std::int16_t id, std::vector<std::byte>& message) {
        if (id == MessageId::info && ++asked > 2) message.at(10) = std::byte('X');
    };
    PublishedServerForTests changed(changing);
    const auto server = opened(optionsFor(changed.port()));
    ASSERT_TRUE(server->camera().ok());
    const auto now = server->camera();
    ASSERT_FALSE(now.ok());
    EXPECT_NE(now.error().message.find("start the bridge again"), std::string::npos) << now.error().message;
}

/// A whole conversation. \return how many of its five parts worked
int converse(const PublishedServerOptions& options, std::vector<Error>& errors) {
    auto server = PublishedServer::open(options);
    if (!server) {
        errors.push_back(server.error());
        return 0;
    }
    int worked = 1;
    const auto count = [&](const auto& result) {
        if (result.ok()) {
            ++worked;
        } else {
            errors.push_back(result.error());
        }
    };
    count((*server)->camera());
    count((*server)->scene());
    count((*server)->image(2));
    count((*server)->pixel({1, 2}, 2));
    return worked;
}

std::size_t conversationBytes() {
    PublishedServerForTests there(exampleShow());
    std::vector<Error> errors;
    EXPECT_EQ(converse(optionsFor(there.port()), errors), 5);
    return there.sent();
}

TEST(PublishedServer, AConversationClosedAtAnyByteIsAnErrorAndNeverAHang) {
    const std::size_t bytes = conversationBytes();
    ASSERT_GT(bytes, 1000u);
    for (std::size_t cut = 0; cut < bytes; cut += cut < 300 ? 1 : 3) {
        Show show = exampleShow();
        show.closedAfter = cut;
        PublishedServerForTests there(show);
        std::vector<Error> errors;
        converse(optionsFor(there.port()), errors);
        // Each later connection is cut there too, so that all that needs more bytes fails; nothing else may.
        for (const Error& error : errors) {
            EXPECT_TRUE(error.code == ErrorCode::connectionLost || error.code == ErrorCode::protocolViolation) << cut << ": " << error.message;
        }
    }
}

TEST(PublishedServer, SilenceAnywhereIsAnErrorInTime) {
    const std::size_t bytes = conversationBytes();
    for (const double part : {0.001, 0.02, 0.06, 0.15, 0.3, 0.5, 0.8, 0.95}) {
        Show show = exampleShow();
        show.silentAfter = static_cast<std::size_t>(double(bytes) * part);
        PublishedServerForTests there(show);
        std::vector<Error> errors;
        EXPECT_LT(converse(impatient(there.port()), errors), 5);
        ASSERT_FALSE(errors.empty());
        for (const Error& error : errors) {
            EXPECT_TRUE(error.code == ErrorCode::timedOut || error.code == ErrorCode::protocolViolation || error.code == ErrorCode::connectionFailed) << error.message;
        }
    }
}

TEST(PublishedServer, GarbageInAnyReplyIsAnErrorAndTheNextConnectionIsClean) {
    for (const std::int16_t id : {MessageId::camera, MessageId::scene, MessageId::image, MessageId::pixel}) {
        Show show = exampleShow();
        bool once = true;
        show.alter = [&](std::int16_t at, std::vector<std::byte>& message) {
            if (at != id || !std::exchange(once, false)) return;
            for (std::size_t i = 0; i < message.size(); ++i) message[i] = std::byte(i * 89 + 55);
        };
        PublishedServerForTests there(show);
        const auto server = opened(impatient(there.port()));
        const auto ask = [&] {
            if (id == MessageId::camera) return server->camera().ok();
            if (id == MessageId::scene) return server->scene().ok();
            if (id == MessageId::image) return server->image(1).ok();
            return server->pixel({0, 0}, 1).ok();
        };
        EXPECT_FALSE(ask()) << id;
        EXPECT_TRUE(ask()) << id;
        EXPECT_EQ(there.connections(), 2);
    }
}

TEST(PublishedServer, WhoGivesUpIsFreeAtOnceAndTheReplyIsReadToItsEnd) {
    Show show = exampleShow();
    std::promise<void> rendering, finish;
    std::atomic<bool> first{true};
    show.rendering = [&] {
        if (!first.exchange(false)) return;
        rendering.set_value();
        finish.get_future().wait();
    };
    PublishedServerForTests there(show);
    const auto server = opened(optionsFor(there.port()));
    std::atomic<bool> cancel{false};
    auto image = std::async(std::launch::async, [&] { return server->image(1000, [&] { return cancel.load(); }); });
    rendering.get_future().wait();
    cancel = true;
    const auto given = image.get();  // while the server still renders
    ASSERT_FALSE(given.ok());
    EXPECT_EQ(given.error().code, ErrorCode::cancelled);
    finish.set_value();
    const auto pixel = server->pixel({1, 2}, 6);
    ASSERT_TRUE(pixel.ok()) << pixel.error().message;
    EXPECT_EQ(pixel->paths.size(), 5u);
    EXPECT_EQ(there.connections(), 1) << "a server whose client vanishes ends itself";
}

TEST(PublishedServer, TheEndOfTheBridgeDoesNotWaitForARender) {
    Show show = exampleShow();
    std::promise<void> rendering, finish;
    show.rendering = [&] {
        rendering.set_value();
        finish.get_future().wait();
    };
    PublishedServerForTests there(show);
    PublishedServerOptions options = optionsFor(there.port());
    options.goodbyeLimit = milliseconds(20);
    auto server = opened(options);
    std::atomic<bool> cancel{false};
    auto image = std::async(std::launch::async, [&] { return server->image(1, [&] { return cancel.load(); }); });
    rendering.get_future().wait();
    cancel = true;
    EXPECT_FALSE(image.get().ok());
    server.reset();  // returns although the server is still in its render
    finish.set_value();
}

}  // namespace
}  // namespace emca::bridge
