#include "arguments.h"

#include <gtest/gtest.h>

#include "command.h"
#include "csv.h"
#include "progress_bar.h"

namespace emca::cli {
namespace {

TEST(Arguments, WholeNumbersOnly) {
    EXPECT_EQ(*parseWhole("X", "0", 0, 10), 0u);
    EXPECT_EQ(*parseWhole("X", "18446744073709551615", 0, ~std::uint64_t(0)), ~std::uint64_t(0));
    for (const char* text :
         {"", "-1", "+1", " 1", "1 ", "1.0", "1e3", "0x10", "eleven", "11", "18446744073709551616", "١"}) {
        const auto result = parseWhole("X", text, 0, 10);
        ASSERT_FALSE(result.ok()) << text;
        EXPECT_EQ(result.error().message,
                  std::string("X is \"") + text + "\"; it must be a whole number from 0 to 10.");
    }
}

TEST(Arguments, PixelsAndSettings) {
    EXPECT_EQ(*parsePixel("117", "64"), (Pixel{117, 64}));
    EXPECT_FALSE(parsePixel("1", "a").ok());
    EXPECT_FALSE(parsePixel("4294967296", "1").ok());
    const auto settings = parseSettings({"64", "0", "path", ""});
    ASSERT_TRUE(settings.ok());
    EXPECT_EQ(settings->samplesPerPixel, 64u);
    EXPECT_TRUE(settings->hasSeed);
    EXPECT_FALSE(parseSettings({}).value().hasSeed);
    EXPECT_FALSE(parseSettings({"0", "", "", ""}).ok());
}

TEST(Command, EveryErrorHasItsExitCode) {
    EXPECT_EQ(exitCodeOf(ErrorCode::connectionFailed), Exit::connection);
    EXPECT_EQ(exitCodeOf(ErrorCode::timedOut), Exit::connection);
    EXPECT_EQ(exitCodeOf(ErrorCode::pixelOutOfRange), Exit::input);
    EXPECT_EQ(exitCodeOf(ErrorCode::tooLarge), Exit::input);
    EXPECT_EQ(exitCodeOf(ErrorCode::rendererFailed), Exit::server);
    EXPECT_EQ(exitCodeOf(ErrorCode::internal), Exit::server);
}

TEST(ProgressLine, FitsIntoItsColumns) {
    EXPECT_EQ(progressLine("rendering", 0.5, 0.1, 30), "rendering ######.......  50 %");
    for (std::size_t columns = 0; columns < 120; ++columns)
        for (const double fraction : {-1.0, 0.0, 0.3, 0.999, 1.0, 7.0})
            EXPECT_LE(progressLine("rendering", fraction, 100, columns).size(), columns);
    EXPECT_NE(progressLine("r", 0.999, 1, 80).find(" 99 %"), std::string::npos);  // 100 only when done
    EXPECT_NE(progressLine("r", 0.25, 30, 80).find("1 min 30 s left"), std::string::npos);
}

TEST(Arguments, Lists) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(splitList("a"), Words{"a"});
    EXPECT_EQ(splitList("path depth, MIS weight ,b"), (Words{"path depth", "MIS weight", "b"}));
    EXPECT_EQ(splitList(""), Words{});
    EXPECT_EQ(splitList(", ,a,"), Words{"a"});
}

TEST(ParseReal, TakesFiniteNumbersOfARange) {
    EXPECT_EQ(*parseReal("--alpha", "0.05", 0, 1), 0.05);
    EXPECT_EQ(*parseReal("--alpha", "1e-3", 0, 1), 1e-3);
    EXPECT_EQ(*parseReal("--alpha", "1", 0, 1), 1);
    for (const char* text : {"", " 1", "1 ", "0,5", "1.1", "-0.1", "nan", "inf", "0x1", "one"}) {
        const auto number = parseReal("--alpha", text, 0, 1);
        ASSERT_FALSE(number.ok()) << text;
        EXPECT_NE(number.error().message.find("--alpha"), std::string::npos);
    }
}

TEST(CsvLine, QuotesWhatNeedsIt) {
    EXPECT_EQ(csvLine({"a", "", "1.5"}), "a,,1.5\n");
    EXPECT_EQ(csvLine({"a,b", "say \"hi\"", "two\nlines"}), "\"a,b\",\"say \"\"hi\"\"\",\"two\nlines\"\n");
    EXPECT_EQ(csvLine({}), "\n");
}

}  // namespace
}  // namespace emca::cli
