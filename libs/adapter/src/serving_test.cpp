#include "emca/adapter/serving.h"

#include <gtest/gtest.h>

namespace emca::adapter {
namespace {

TEST(ServeAddress, ServesOnLoopbackUnlessToldOtherwise) {
    EXPECT_EQ(*parseServeAddress("50013"), (ServeAddress{"127.0.0.1", 50013}));
    EXPECT_EQ(*parseServeAddress("0"), (ServeAddress{"127.0.0.1", 0}));
    EXPECT_EQ(*parseServeAddress("0.0.0.0:65535"), (ServeAddress{"0.0.0.0", 65535}));
    EXPECT_EQ(*parseServeAddress("[::1]:7"), (ServeAddress{"::1", 7}));
}

TEST(ServeAddress, RefusesWhatIsNoAddressAndNamesTheOption) {
    for (const char* wrong : {"", "65536", "host:", ":", ":80", "host:7x", "-1", "1e3"}) {
        const auto parsed = parseServeAddress(wrong, "emca_port");
        ASSERT_FALSE(parsed) << wrong;
        EXPECT_EQ(parsed.error().message.rfind("emca_port is ", 0), 0u) << parsed.error().message;
    }
}

}  // namespace
}  // namespace emca::adapter
