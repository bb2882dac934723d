// What is no EMCA server, and servers that go away.
#include <gtest/gtest.h>

#include "emca/doctor/examination.h"
#include "emca/protocol/codec.h"
#include "emca/server/server.h"
#include "room_renderer.h"
#include "stranger.h"

namespace emca::doctor {
namespace {

std::string bytesOf(protocol::Body body) {
    const auto frame = protocol::encode({0, std::move(body)});
    const auto header = protocol::header(*frame);
    return std::string(reinterpret_cast<const char*>(header.data()), header.size()) + std::string(reinterpret_cast<const char*>(frame->data()), frame->size());
}

Examination examined(std::uint16_t port, std::chrono::milliseconds patience = std::chrono::seconds(10)) {
    ExaminationOptions options;
    options.pixels = 10;
    options.connection.connectTimeout = patience;
    options.connection.silenceTimeout = std::chrono::seconds(10);
    auto examination = examine({"127.0.0.1", port}, options);
    EXPECT_TRUE(examination.ok());
    return std::move(examination).value();
}

void expectNoHandshake(std::uint16_t port, ErrorCode code) {
    const Examination examination = examined(port, std::chrono::milliseconds(code == ErrorCode::timedOut ? 300 : 10000));
    ASSERT_TRUE(examination.lost);
    EXPECT_STREQ(name(examination.lost->code), name(code)) << examination.lost->message;
    ASSERT_EQ(examination.findings.size(), 1u);
    EXPECT_EQ(examination.findings[0].check, "handshake");
    EXPECT_STREQ(name(examination.findings[0].outcome), "failed");
    EXPECT_EQ(examination.findings[0].sentence, examination.lost->message);
}

TEST(DoctorsConnection, WhatListensIsNoServer) {
    std::uint16_t nobody = 0;
    {
        const test::Stranger gone("", true);
        nobody = gone.port();
    }
    expectNoHandshake(nobody, ErrorCode::connectionFailed);
    const test::Stranger web("HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n", true), noise(std::string(5000, '\xa5'), false), silent("", false), hangsUp("", true);
    expectNoHandshake(web.port(), ErrorCode::protocolViolation);
    expectNoHandshake(noise.port(), ErrorCode::protocolViolation);
    expectNoHandshake(silent.port(), ErrorCode::timedOut);
    expectNoHandshake(hangsUp.port(), ErrorCode::protocolViolation);
    const test::Stranger published(std::string("\x01\x00", 2), false);  // the first bytes of a server of the published EMCA
    expectNoHandshake(published.port(), ErrorCode::timedOut);
}

TEST(DoctorsConnection, OtherVersions) {
    const test::Stranger newer(bytesOf(protocol::Welcome{"from the future", 999, {}, 1 << 20}), false);
    expectNoHandshake(newer.port(), ErrorCode::versionMismatch);
    const test::Stranger refuses(bytesOf(protocol::Refusal{{ErrorCode::versionMismatch, "Version 1 is too old for this server."}, 7, 9}), true);
    expectNoHandshake(refuses.port(), ErrorCode::versionMismatch);
}

TEST(DoctorsConnection, AServerThatClosesMidwayAndIsGone) {
    test::RoomRenderer renderer;
    const auto server = Server::start(renderer, {});
    ASSERT_TRUE(server.ok());
    std::size_t longest = 0;
    for (const std::size_t bytes : {200u, 1000u, 30000u, 70000u, 200000u}) {
        const test::Scissors scissors((*server)->port(), bytes, 1);
        const Examination examination = examined(scissors.port());
        ASSERT_TRUE(examination.lost) << bytes;
        ASSERT_FALSE(examination.findings.empty());
        const Finding& last = examination.findings.back();
        EXPECT_STREQ(name(last.outcome), "failed") << bytes << " " << last.check << ": " << last.sentence;
        EXPECT_GE(examination.findings.size(), longest) << bytes;
        longest = examination.findings.size();
    }
    EXPECT_GT(longest, 4u);
}

TEST(DoctorsConnection, AServerThatClosesMidwayAndComesBack) {
    test::RoomRenderer renderer;
    const auto server = Server::start(renderer, {});
    ASSERT_TRUE(server.ok());
    const test::Scissors scissors((*server)->port(), 60000, 1000);
    const Examination examination = examined(scissors.port());
    EXPECT_FALSE(examination.lost);
    EXPECT_EQ(examination.findings.size(), checkNames().size()) << "every check has its turn";
    EXPECT_GT(examination.count(Outcome::failed), 0u);
    EXPECT_STREQ(name(examination.find("handshake")->outcome), "ok");
}

}  // namespace
}  // namespace emca::doctor
