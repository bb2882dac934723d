#include <gtest/gtest.h>

#include "emca/client/connection.h"

namespace emca::client {
namespace {

TEST(Address, AcceptsEveryUsualSpelling) {
    const Address defaults;
    const auto is = [](const char* text, const std::string& host, std::uint16_t port) {
        const auto address = Address::parse(text);
        ASSERT_TRUE(address.ok()) << text;
        EXPECT_EQ(address->host, host) << text;
        EXPECT_EQ(address->port, port) << text;
        EXPECT_EQ(*Address::parse(address->text()), *address) << "text() can be parsed again";
    };
    is("127.0.0.1:50013", "127.0.0.1", 50013);
    is("render-7.local:1", "render-7.local", 1);
    is("65535", defaults.host, 65535);
    is("localhost", "localhost", defaults.port);
    is("[::1]:8080", "::1", 8080);
    is("[fe80::1]", "fe80::1", defaults.port);
    is("::1", "::1", defaults.port);
}

TEST(Address, RefusesWhatIsNone) {
    for (const char* text : {"", ":", ":80", "host:", "host:0", "host:65536", "host:80x", "host: 80", "99999", "[::1", "[]:80",
                             "[::1]80", "[::1]:0", "my host:80", "http://host:80", "host:-1", "0"}) {
        const auto address = Address::parse(text);
        ASSERT_FALSE(address.ok()) << text;
        EXPECT_EQ(address.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(address.error().message.find(text), std::string::npos);
    }
}

}  // namespace
}  // namespace emca::client
