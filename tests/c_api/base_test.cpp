// Versions, errors, seeds.
#include <cstring>
#include <string>

#include "emca/core/result.h"
#include "emca/core/seed_map.h"
#include "emca/emca.h"
#include "gtest/gtest.h"

namespace emca::test {
namespace {

TEST(VersionInC, IsCheckedWithASentence) {
    EXPECT_EQ(emca_abi(), EMCA_ABI);
    EXPECT_EQ(emca_check_abi(EMCA_ABI, nullptr), EMCA_OK);
    const std::uint32_t newerLibrary = (EMCA_ABI_MAJOR + 1) << 16, newerHeader = EMCA_ABI + 1,
                        olderLibrary = (EMCA_ABI_MAJOR - 1) << 16 | 7;
    for (const std::uint32_t abi : {newerLibrary, newerHeader, olderLibrary, 0u}) {
        emca_error error{};
        EXPECT_EQ(emca_check_abi(abi, &error), EMCA_VERSION_MISMATCH) << abi;
        EXPECT_EQ(error.code, EMCA_VERSION_MISMATCH);
        EXPECT_NE(std::string(error.message).find(": "), std::string::npos) << error.message;
    }
    emca_error error{};
    emca_check_abi(newerHeader, &error);
    EXPECT_NE(std::strstr(error.message, "install a newer EMCA"), nullptr) << error.message;
}

TEST(ErrorsInC, AreCopiedAndCut) {
    emca_error error;
    std::memset(&error, 0x55, sizeof error);
    EXPECT_EQ(emca_fail(&error, EMCA_TOO_LARGE, "Too much."), EMCA_TOO_LARGE);
    EXPECT_EQ(error.code, EMCA_TOO_LARGE);
    EXPECT_STREQ(error.message, "Too much.");
    EXPECT_EQ(emca_fail(nullptr, EMCA_TOO_LARGE, "Too much."), EMCA_TOO_LARGE);
    EXPECT_EQ(emca_fail(&error, EMCA_OK, nullptr), EMCA_INTERNAL) << "no failure is called a success";
    EXPECT_STREQ(error.message, "");
    // Two bytes each, and an odd number of bytes before: the last one that fits would be cut in two.
    for (const char* lead : {"", "x"}) {
        std::string longer = lead;
        while (longer.size() < 2 * EMCA_MESSAGE_BYTES) longer += "\u00e9";
        emca_fail(&error, EMCA_INTERNAL, longer.c_str());
        const std::string cut = error.message;
        EXPECT_LT(cut.size(), std::size_t(EMCA_MESSAGE_BYTES));
        EXPECT_GE(cut.size(), std::size_t(EMCA_MESSAGE_BYTES) - 2);
        EXPECT_EQ(cut, longer.substr(0, cut.size()));
        EXPECT_EQ((cut.size() - std::strlen(lead)) % 2, 0u) << "only whole characters";
    }
    emca_fail(&error, EMCA_INTERNAL, "made of itself");
    emca_fail(&error, EMCA_INTERNAL, error.message + 5);
    EXPECT_STREQ(error.message, "of itself");
}

TEST(ErrorsInC, HaveTheNamesAndNumbersOfCpp) {
    for (int code = EMCA_INTERNAL; code <= EMCA_OUT_OF_MEMORY; ++code)
        EXPECT_STREQ(emca_code_name(code), name(static_cast<ErrorCode>(code)));
    EXPECT_EQ(EMCA_OUT_OF_MEMORY, static_cast<int>(ErrorCode::outOfMemory));
    EXPECT_EQ(EMCA_PIXEL_OUT_OF_RANGE, static_cast<int>(ErrorCode::pixelOutOfRange));
    EXPECT_EQ(EMCA_RENDERER_FAILED, static_cast<int>(ErrorCode::rendererFailed));
    EXPECT_STREQ(emca_code_name(EMCA_OK), "ok");
    for (const int none : {-1, 70000, 999}) EXPECT_STREQ(emca_code_name(none), "unknown");
}

TEST(SeedsInC, AreThoseOfCpp) {
    const std::uint32_t stored[6] = {5, 4, 3, 2, 1, 0};
    emca_seed_map* map = nullptr;
    ASSERT_EQ(emca_seed_map_create(3, 2, stored, 9, &map, nullptr), EMCA_OK);
    const SeedMap expected(3, {5, 4, 3, 2, 1, 0}, 9), hashed(9);
    for (std::uint32_t y = 0; y < 2; ++y)
        for (std::uint32_t x = 0; x < 3; ++x)
            for (std::uint64_t sample : {0ull, 1ull, ~0ull}) {
                EXPECT_EQ(emca_seed(9, {x, y}, sample), hashed.seed({x, y}, sample));
                EXPECT_EQ(emca_seed_map_seed(map, {x, y}, sample), expected.seed({x, y}, sample));
            }
    EXPECT_EQ(emca_pixel_seed(9, {1, 2}), hashed.seed(Pixel{1, 2}));
    EXPECT_EQ(emca_seed_map_seed(map, {3, 0}, 1), hashed.seed({3, 0}, 1)) << "outside";
    emca_seed_map_destroy(map);
    emca_seed_map_destroy(nullptr);
    emca_error error{};
    EXPECT_EQ(emca_seed_map_create(0, 2, stored, 9, &map, &error), EMCA_INVALID_ARGUMENT);
    EXPECT_EQ(map, nullptr);
    EXPECT_EQ(emca_seed_map_create(3, 2, nullptr, 9, &map, &error), EMCA_INVALID_ARGUMENT);
    EXPECT_EQ(emca_seed_map_create(3, 2, stored, 9, nullptr, &error), EMCA_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace emca::test
