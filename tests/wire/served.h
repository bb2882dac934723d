#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "emca/client/connection.h"
#include "emca/server/server.h"
#include "fake_renderer.h"

namespace emca::test {

/// A fake renderer behind a real server on a free port, with as many clients as one likes.
struct Served {
    FakeRenderer renderer;
    std::unique_ptr<Server> server;

    Served() = default;
    explicit Served(ServerOptions options) { start(std::move(options)); }

    void start(ServerOptions options = {}) {
        auto started = Server::start(renderer, std::move(options));
        ASSERT_TRUE(started.ok()) << started.error().message;
        server = std::move(started).value();
    }

    client::Address address() const { return {"127.0.0.1", server->port()}; }

    std::unique_ptr<client::Connection> connect(client::Connection::Options options = {}) const {
        auto opened = client::Connection::open(address(), std::move(options));
        EXPECT_TRUE(opened.ok()) << opened.error().message;
        return opened ? std::move(opened).value() : nullptr;
    }
};

}  // namespace emca::test

#define ASSERT_OK(result) ASSERT_TRUE((result).ok()) << (result).error().message
#define EXPECT_OK(result)                                            \
    do {                                                              \
        const auto& found = (result);                                 \
        EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().message); \
    } while (false)
#define EXPECT_CODE(result, wanted)                                                     \
    do {                                                                                \
        const auto& found = (result);                                                   \
        ASSERT_FALSE(found.ok());                                                       \
        const Error& error = found.error();                                             \
        EXPECT_STREQ(name(error.code), name(ErrorCode::wanted)) << error.message;       \
        EXPECT_GT(error.message.size(), 15u) << "an error says what to do";             \
    } while (false)
