#include "emca/core/value.h"

#include <gtest/gtest.h>

#include <cmath>

namespace emca {
namespace {

TEST(Value, TypeIsThePlaceOfTheAlternative) {
    EXPECT_EQ(typeOf(Value(true)), ValueType::boolean);
    EXPECT_EQ(typeOf(Value(std::int64_t(1))), ValueType::integer);
    EXPECT_EQ(typeOf(Value(Vec3f{})), ValueType::float3);
    EXPECT_EQ(typeOf(Value(Vec2d{})), ValueType::double2);
    EXPECT_EQ(typeOf(Value(Color{})), ValueType::color);
    EXPECT_EQ(typeOf(Value(std::string("x"))), ValueType::text);
    EXPECT_EQ(typeOf(Value(std::vector<float>{})), ValueType::spectrum);
}

TEST(Value, SizesAreThoseOfTheStoredTypes) {
    EXPECT_EQ(byteSize(ValueType::integer3), sizeof(Vec3i));
    EXPECT_EQ(byteSize(ValueType::float2), sizeof(Vec2f));
    EXPECT_EQ(byteSize(ValueType::double3), sizeof(Vec3d));
    EXPECT_EQ(byteSize(ValueType::color), sizeof(Color));
    EXPECT_EQ(byteSize(ValueType::colorA), sizeof(ColorA));
}

TEST(Value, ComponentsAreNumbersOrNan) {
    EXPECT_EQ(component(Vec3i{1, 2, 3}, 2), 3.0);
    EXPECT_EQ(component(Color{1, 2, 3}, 1), 2.0);
    EXPECT_EQ(component(true, 0), 1.0);
    EXPECT_TRUE(std::isnan(component(1.f, 1)));
    EXPECT_TRUE(std::isnan(component(std::string("1"), 0)));
    EXPECT_EQ(component(std::vector<float>{4, 5}, 1), 5.0);
}

}  // namespace
}  // namespace emca
