#include "path_table.h"

#include <gtest/gtest.h>

#include "table.h"
#include "trace_for_tests.h"

namespace emca::cli {
namespace {

TEST(Table, AlignsByCodePointsAndHasNoTrailingBlanks) {
    Table table({{"name", Table::Align::left}, {"m²"}, {"end", Table::Align::left}});
    table.add({"ä", "1.000", ""});
    table.add({"long", "12", "x\x1b[2Jy"});
    EXPECT_EQ(table.text(), "name     m²  end\nä     1.000\nlong     12  x?[2Jy\n");
}

TEST(PathTable, ShowsVerdictAndEveryPath) {
    const std::string text = pixelReport(exampleTrace(), "box", 0);
    EXPECT_EQ(text,
              "pixel (3, 4) of box, 2 spp, path, sobol, seed 7\n"
              "replay close: rendered (0.5000, 0.5000, 0.5000), replayed (0.5000, 0.5000, 0.5000)\n"
              "\n"
              "   sample  part  depth  luminance     red  green      blue  events\n"
              "*       5     0      3        NaN  0.1000    NaN  Infinity  TS · B\n"
              "        9     2      0          -       -      -         -\n"
              "\n"
              "Estimates in W/(sr m²), before division by samples per pixel.\n"
              "* 1 of 2 paths are NaN or infinite.\n");
}

TEST(PathTable, LimitKeepsTheBrightest) {
    const std::string text = pixelReport(exampleTrace(), "box", 1);
    EXPECT_NE(text.find("*       5"), std::string::npos) << text;
    EXPECT_EQ(text.find("        9"), std::string::npos) << text;
    EXPECT_NE(text.find("The 1 brightest of 2 paths"), std::string::npos) << text;
}

TEST(PathTable, SaysWhatIsMissing) {
    client::Trace trace = exampleTrace();
    trace.paths = PathSet();
    trace.replays[0] = {Verdict::unknown, SumCheck::differs, {}, {}};
    trace.stats.droppedByBudget = 12;
    const std::string text = pixelReport(trace, "box", 0);
    EXPECT_NE(text.find("replay unknown"), std::string::npos);
    EXPECT_NE(text.find("do not add up"), std::string::npos);
    EXPECT_NE(text.find("12 values did not fit"), std::string::npos);
    EXPECT_NE(text.find("no paths"), std::string::npos);
}

}  // namespace
}  // namespace emca::cli
