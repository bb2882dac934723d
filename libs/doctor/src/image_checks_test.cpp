#include "emca/doctor/image_checks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace emca::doctor {
namespace {

Image image() {
    Image image(4, 3);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = float(i) + 1;
    return image;
}

TEST(ImageChecks, EqualBitsAreEqual) {
    Image a = image();
    a.setColor({1, 1}, Color(std::nanf("1")));
    Image b = a;
    b.setColor({1, 1}, Color(std::nanf("2")));
    EXPECT_TRUE(compareImages(a, b).equal()) << "NaN is NaN";
    EXPECT_EQ(compareImages(a, b).pixels, 12u);
}

TEST(ImageChecks, TheWorstPixelIsFound) {
    const Image a = image();
    Image b = a;
    b.setColor({0, 1}, a.color({0, 1}) * 1.1f);
    b.setColor({2, 2}, a.color({2, 2}) * 2.f);
    b.at({3, 0})[1] = std::nextafter(b.at({3, 0})[1], 100.f);
    const ImageDifference d = compareImages(a, b);
    EXPECT_EQ(d.different, 3u);
    EXPECT_EQ(d.worst, (Pixel{2, 2}));
    EXPECT_DOUBLE_EQ(d.largest, 0.5);
    b.at({3, 0})[0] = INFINITY;
    EXPECT_EQ(compareImages(a, b).worst, (Pixel{3, 0}));
    EXPECT_TRUE(std::isinf(compareImages(a, b).largest));
    EXPECT_FALSE(compareImages(a, Image(4, 4)).equal());
}

TEST(ImageChecks, MinusZeroHasOtherBits) {
    Image a(1, 1), b(1, 1);
    b.setColor({0, 0}, Color(-0.f));
    EXPECT_EQ(compareImages(a, b).different, 1u);
    EXPECT_EQ(compareImages(a, b).largest, 0);
}

TEST(ImageChecks, RepeatedRenders) {
    Image other = image();
    other.at({0, 0})[0] *= 3;
    Finding finding;
    checkRepeated(finding, compareImages(image(), image()), true);
    EXPECT_EQ(finding.outcome, Outcome::ok);
    checkRepeated(finding, compareImages(image(), other), false);
    EXPECT_EQ(finding.outcome, Outcome::warning);
    checkRepeated(finding, compareImages(image(), other), true);
    EXPECT_EQ(finding.outcome, Outcome::failed);
}

TEST(ImageChecks, FaultyAndBlackImages) {
    EXPECT_EQ(checkImage(image()).outcome, Outcome::ok);
    EXPECT_EQ(checkImage(Image(4, 4)).outcome, Outcome::warning);
    Image negative = image();
    negative.at({0, 0})[0] = -1;
    EXPECT_EQ(checkImage(negative).outcome, Outcome::ok) << "a filter with negative lobes may do that";
    Image nan = image();
    nan.at({2, 1})[2] = std::nanf("");
    const Finding finding = checkImage(nan);
    EXPECT_EQ(finding.outcome, Outcome::warning);
    ASSERT_EQ(finding.pixels.size(), 1u);
    EXPECT_EQ(finding.pixels[0].pixel, (Pixel{2, 1}));
}

}  // namespace
}  // namespace emca::doctor
