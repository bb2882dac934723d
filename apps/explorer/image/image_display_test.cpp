#include "image/image_display.h"

#include <gtest/gtest.h>

namespace emca::explorer {
namespace {

TEST(ImageDisplay, EveryKindOfNumbersKeepsItsOwnColours) {
    ImageDisplay display;
    EXPECT_FALSE(display.style().falseColor) << "radiance is shown as light";
    display.scale().range = {1, 7, false};
    display.mode = ImageMode::difference;
    display.metric = analysis::ImageMetric::absoluteError;
    EXPECT_TRUE(display.style().falseColor);
    display.scale().range = {0, 0.25, false};
    display.mode = ImageMode::image;
    EXPECT_EQ(display.style().range, (analysis::ValueRange{1, 7, false}));
    display.samplingError = analysis::SamplingError::standardError;
    EXPECT_TRUE(display.style().falseColor);
    EXPECT_EQ(display.quantity(), "standard error");
    display.mode = ImageMode::difference;
    EXPECT_EQ(display.style().range, (analysis::ValueRange{0, 0.25, false}));
    EXPECT_EQ(display.quantity(), "absolute error");
}

TEST(ImageDisplay, SignedErrorsAreRedAndGreenAndNothingElse) {
    ImageDisplay display;
    display.mode = ImageMode::difference;
    display.metric = analysis::ImageMetric::error;
    display.scale().falseColor = false;
    EXPECT_TRUE(display.style().falseColor);
    EXPECT_EQ(display.style().colorMap, analysis::ColorMapId::redGreen);
    EXPECT_FALSE(display.style().negativeIsInvalid);
}

TEST(ChannelSelect, AnImageOffersColoursFirstThenLayersThenTheRest) {
    const Image image(1, 1, {"R", "G", "B", "A", "Z", "diffuse.B", "diffuse.G", "diffuse.R", "id"});
    std::vector<std::string> names;
    for (const ChannelSelect& select : channelsOf(image)) names.push_back(text(select));
    EXPECT_EQ(names, (std::vector<std::string>{"RGB", "Luminance", "R", "G", "B", "A", "diffuse", "Z", "diffuse.B", "diffuse.G", "diffuse.R", "id"}));
    const auto grey = channelsOf(Image(1, 1, {"Y"}));
    ASSERT_EQ(grey.size(), 1u);
    EXPECT_EQ(text(grey.front()), "Y");
}

TEST(ChannelSelect, NamesLeadToTheSameChannelWhateverTheOrder) {
    Image a(1, 1, {"R", "G", "B", "Z"}), b(1, 1, {"R", "G", "B", "A", "Z"});
    a.at({0, 0})[3] = 5;
    b.at({0, 0})[4] = 7;
    const ChannelSelect depth{ChannelSelect::Kind::channel, "Z"};
    EXPECT_EQ(shownNumber(a, {0, 0}, depth), 5);
    EXPECT_EQ(shownNumber(b, {0, 0}, depth), 7);
    Image layered(1, 1, {"R", "G", "B", "n.B", "n.G", "n.R"});
    const float values[] = {0, 0, 0, 3, 2, 1};
    std::copy(std::begin(values), std::end(values), layered.data());
    EXPECT_FLOAT_EQ(shownNumber(layered, {0, 0}, {ChannelSelect::Kind::layer, "n"}), luminance(Color(1, 2, 3)));
    EXPECT_FLOAT_EQ(shownNumber(layered, {0, 0}, {ChannelSelect::Kind::channel, "missing"}), 0) << "its luminance instead";
}

}  // namespace
}  // namespace emca::explorer
