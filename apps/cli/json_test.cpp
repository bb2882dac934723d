#include "json.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace emca::cli {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Json, FloatsReadBackAsTheSameBits) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20000; ++i) {
        const auto f = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        const auto d = std::bit_cast<double>(random());
        if (std::isfinite(f)) {
            const float back = Json::parse(toJson(f).dump()).get<float>();
            ASSERT_EQ(std::bit_cast<std::uint32_t>(back), std::bit_cast<std::uint32_t>(f));
        }
        if (std::isfinite(d)) {
            const double back = Json::parse(toJson(d).dump()).get<double>();
            ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(d));
        }
    }
    EXPECT_EQ(toJson(0.1f).dump(), "0.1");
    EXPECT_EQ(toJson(-0.f).dump(), "-0.0");
}

TEST(Json, WhatIsNoNumberIsAWord) {
    EXPECT_EQ(toJson(std::nanf("")), "NaN");
    EXPECT_EQ(toJson(kInf), "Infinity");
    EXPECT_EQ(toJson(-kInf), "-Infinity");
    EXPECT_EQ(toJson(Color(1, -kInf, 0)).dump(), R"([1.0,"-Infinity",0.0])");
}

TEST(Json, EveryTypeOfValue) {
    EXPECT_EQ(toJson(Value(true)).dump(), "true");
    EXPECT_EQ(toJson(Value(std::int64_t(-9223372036854775807))).dump(), "-9223372036854775807");
    EXPECT_EQ(toJson(Value(Vec2i{1, 2})).dump(), "[1,2]");
    EXPECT_EQ(toJson(Value(Vec3d{1, 2, 0.5})).dump(), "[1.0,2.0,0.5]");
    EXPECT_EQ(toJson(Value(ColorA{1, 2, 3, 0.5f})).dump(), "[1.0,2.0,3.0,0.5]");
    EXPECT_EQ(toJson(Value(std::string("a\"b"))).dump(), R"("a\"b")");
    EXPECT_EQ(toJson(Value(std::vector<float>{1, kInf})).dump(), R"([1.0,"Infinity"])");
    EXPECT_EQ(toJson(std::optional<Vec3f>()).dump(), "null");
}

TEST(Json, DumpIsValidAndKeepsVectorsOnOneLine) {
    Json json;
    json["v"] = toJson(Vec3f{1, 2, 3});
    json["empty"] = Json::array();
    json["list"] = Json::array({Json::object({{"a", nullptr}})});
    json["bad"] = std::string("\xff");
    const std::string text = dump(json);
    EXPECT_NE(text.find("\"v\": [1.0, 2.0, 3.0],\n"), std::string::npos) << text;
    EXPECT_EQ(text.back(), '\n');
    const Json back = Json::parse(text);
    EXPECT_EQ(back["list"], json["list"]);
    EXPECT_EQ(back["empty"], json["empty"]);
    EXPECT_EQ(back["bad"], "\xef\xbf\xbd");
}

}  // namespace
}  // namespace emca::cli
