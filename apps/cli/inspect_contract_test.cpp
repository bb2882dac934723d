// Numbers about pixels and images from the command line: the built program against a served renderer whose paths are
// known.
#include <algorithm>
#include <cmath>
#include <map>

#include "emca/analysis/image_metrics.h"
#include "emca/analysis/outliers.h"
#include "emca/analysis/statistics.h"
#include "emca/imageio/imageio.h"
#include "program_for_tests.h"
#include "served.h"

namespace emca::cli {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class Inspects : public ProgramTest {
  protected:
    void SetUp() override { served.start(); }
    std::string address() const { return served.server->address(); }
    /// Luminances of the samples of pixel (3, 4).
    std::vector<double> luminances(std::uint32_t spp) const {
        std::vector<double> values;
        for (std::uint32_t i = 0; i < spp; ++i)
            values.push_back(static_cast<double>(luminance(test::FakeRenderer::sample({3, 4}, i, 7))));
        return values;
    }
    void write(const std::string& name, std::uint32_t width, std::uint32_t height, Color color) const {
        Image image(width, height);
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) image.setColor({x, y}, color);
        ASSERT_TRUE(imageio::write(program.file(name), image).ok());
    }
    test::Served served;
};

TEST_F(Inspects, OutliersAreThoseOfTheLibrary) {
    const auto expected = analysis::detectOutliers(luminances(512), {.deviations = 2});
    ASSERT_TRUE(expected.ok());
    ASSERT_GT(expected->outliers.size(), 3u);
    const Json found = json({"outliers", address(), "3", "4", "--spp", "512", "--deviations", "2", "--json"});
    EXPECT_EQ(found["method"], "sigma");
    EXPECT_EQ(found["quantity"], "luminance");
    EXPECT_EQ(found["considered"], 512);
    EXPECT_DOUBLE_EQ(found["mean"].get<double>(), expected->mean);
    EXPECT_DOUBLE_EQ(found["lower"].get<double>(), expected->lower);
    std::vector<Index> samples;
    double before = 1e9;
    for (const Json& one : found["outliers"]) {
        samples.push_back(one["sample"].get<Index>());
        EXPECT_GT(std::abs(one["deviations"].get<double>()), 2);
        EXPECT_LE(std::abs(one["deviations"].get<double>()), before) << "farthest first";
        before = std::abs(one["deviations"].get<double>());
        EXPECT_EQ(one["depth"], 3);
    }
    std::sort(samples.begin(), samples.end());
    EXPECT_EQ(samples, expected->outliers);
    const Finished text = run({"outliers", address(), "3", "4", "--spp", "512", "--deviations", "2"});
    EXPECT_EQ(text.exitCode, Exit::ok);
    EXPECT_NE(text.out.find(std::to_string(samples.size()) + " of 512 paths stand out"), std::string::npos) << text.out;
    const Finished csv = run({"outliers", address(), "3", "4", "--spp", "512", "--deviations", "2", "--csv"});
    EXPECT_EQ(lines(csv.out), samples.size() + 1);
    EXPECT_EQ(csv.out.rfind("sample,part,luminance,deviations,depth,events\n", 0), 0u);
}

TEST_F(Inspects, OutliersPerPixelAreThoseOfEachPixelAlone) {
    for (const std::vector<std::string>& method : {std::vector<std::string>{"--deviations", "1.9"}, {"--method", "esd", "--alpha", "0.9"}}) {
        const auto ask = [&](std::vector<std::string> where, const char* format) {
            where.insert(where.begin(), {"outliers", address()});
            where.insert(where.end(), method.begin(), method.end());
            where.insert(where.end(), {"--spp", "64", format});
            return where;
        };
        const Json region = json(ask({"--rect", "2,3,5,5", "--per-pixel"}, "--json"));
        EXPECT_EQ(region["rect"], Json({2, 3, 5, 5}));
        EXPECT_EQ(region["replays"]["unknown"], 6);
        EXPECT_EQ(region["paths"], 6 * 64);
        ASSERT_EQ(region["pixels"].size(), 6u);
        std::size_t outliers = 0;
        for (const Json& of : region["pixels"]) {
            const Json alone = json(ask({of["pixel"][0].dump(), of["pixel"][1].dump()}, "--json"));
            for (const char* member : {"considered", "notFinite", "mean", "standardDeviation", "lower", "upper", "paths"}) EXPECT_EQ(of[member], alone[member]) << member;
            Json here = Json::array();
            for (Json one : region["outliers"]) {
                if (one["pixel"] != of["pixel"]) continue;
                one.erase("pixel");
                here.push_back(one);
            }
            EXPECT_EQ(here, alone["outliers"]) << "in their order, too";
            outliers += here.size();
        }
        EXPECT_EQ(region["outliers"].size(), outliers);
        // Luminances of a hash have short tails: the test finds none in them, and says so pixel by pixel.
        EXPECT_EQ(outliers > 3, method[0] == "--deviations") << outliers;
        EXPECT_EQ(region["pixels"][0].contains("steps"), method[0] == "--method");
        const Finished csv = run(ask({"--rect", "2,3,5,5", "--per-pixel"}, "--csv"));
        EXPECT_EQ(lines(csv.out), outliers + 1);
        EXPECT_EQ(csv.out.rfind("x,y,sample,part,", 0), 0u);
    }
    const Finished text = run({"outliers", address(), "--rect", "2,3,5,5", "--per-pixel", "--spp", "64"});
    EXPECT_NE(text.out.find("region 3x2 at (2, 3)"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("of its own pixel: in"), std::string::npos) << text.out;
    const Json together = json({"outliers", address(), "--rect", "2,3,5,5", "--spp", "64", "--json"});
    EXPECT_EQ(together["considered"], 6 * 64);
    EXPECT_FALSE(together.contains("pixels"));
    expectError({"outliers", address()}, Exit::usage, "--rect");
    expectError({"outliers", address(), "1", "2", "--rect", "2,3,5,5"}, Exit::usage, "one of the two");
    expectError({"outliers", address(), "--rect", "2,3,99,5"}, Exit::input, "beyond the image");
}

TEST_F(Inspects, OutliersByTheGeneralizedEsdTest) {
    const auto expected = analysis::detectOutliers(
        luminances(64), {.method = analysis::OutlierMethod::generalizedEsd, .maximum = 6, .significance = 0.5});
    ASSERT_TRUE(expected.ok());
    const Json found = json(
        {"outliers", address(), "3", "4", "--spp", "64", "--method", "esd", "--max", "6", "--alpha", "0.5", "--json"});
    EXPECT_EQ(found["method"], "esd");
    EXPECT_EQ(found["alpha"], 0.5);
    ASSERT_EQ(found["steps"].size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(found["steps"][i]["sample"], expected->steps[i].index);
        EXPECT_DOUBLE_EQ(found["steps"][i]["statistic"].get<double>(), expected->steps[i].statistic);
        EXPECT_DOUBLE_EQ(found["steps"][i]["critical"].get<double>(), expected->steps[i].critical);
    }
    EXPECT_EQ(found["outliers"].size(), expected->outliers.size());
    const Finished text = run({"outliers", address(), "3", "4", "--spp", "64", "--method", "esd"});
    EXPECT_NE(text.out.find("lambda"), std::string::npos) << text.out;
}

TEST_F(Inspects, OutliersAmongTheMatchesOfAQuery) {
    const Json found = json(
        {"outliers", address(), "3", "4", "--spp", "64", "--where", "luminance > 0.5", "--quantity", "red", "--json"});
    EXPECT_EQ(found["where"]["paths"], 64);
    EXPECT_EQ(found["paths"], found["where"]["matched"]);
    EXPECT_LT(found["paths"].get<int>(), 64);
}

TEST_F(Inspects, StatsOfAPixel) {
    const analysis::Summary expected = analysis::summarize(std::span<const double>(luminances(128)));
    const Json stats = json({"stats", address(), "3", "4", "--spp", "128", "--json"});
    EXPECT_EQ(stats["paths"], 128);
    EXPECT_EQ(stats["vertices"], 384);
    const Json& l = stats["summary"]["luminance"];
    EXPECT_DOUBLE_EQ(l["mean"].get<double>(), expected.mean);
    EXPECT_DOUBLE_EQ(l["variance"].get<double>(), expected.variance);
    EXPECT_DOUBLE_EQ(l["standardError"].get<double>(), expected.standardError());
    EXPECT_DOUBLE_EQ(l["min"].get<double>(), expected.min);
    EXPECT_DOUBLE_EQ(l["quantiles"]["p50"].get<double>(),
                     analysis::quantile(analysis::sortedFinite(luminances(128)), 0.5));
    EXPECT_EQ(stats["summary"]["depth"]["max"], 3.0);
    ASSERT_EQ(stats["byDepth"].size(), 1u);
    EXPECT_EQ(stats["byDepth"][0]["depth"], 3.0);
    EXPECT_EQ(stats["byDepth"][0]["paths"], 128.0);
    EXPECT_NEAR(stats["byDepth"][0]["mean"].get<double>(), expected.mean, 1e-6);
    EXPECT_TRUE(stats["byTechnique"].empty()) << "this renderer records no contributions";
    const Finished text = run({"stats", address(), "3", "4"});
    EXPECT_EQ(text.exitCode, Exit::ok) << text.err;
    EXPECT_NE(text.out.find("by depth"), std::string::npos) << text.out;
    const Finished csv = run({"stats", address(), "3", "4", "--csv"});
    EXPECT_EQ(csv.out.rfind("quantity,count,finite,nan,", 0), 0u);
    EXPECT_EQ(lines(csv.out), 7u);
}

TEST_F(Inspects, ValuesOfEachPath) {
    const std::vector<double> expected = luminances(8);
    const Finished values = run({"pixel", address(), "3", "4", "--spp", "8", "--value", "luminance", "--value", "max(v.depth) + 1", "--value",
                                 "pfd", "--json"});
    EXPECT_EQ(values.err, "warning: no path has \"pfd\"\n");
    const Json found = Json::parse(values.out, nullptr, false);
    ASSERT_EQ(found["rows"].size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        const Json& row = found["rows"][i];
        EXPECT_EQ(row["sample"], i);
        EXPECT_DOUBLE_EQ(row["luminance"].get<double>(), expected[i]);
        EXPECT_EQ(row["max(v.depth) + 1"], 4);
        EXPECT_TRUE(row["pfd"].is_null());
    }
    EXPECT_EQ(found["missing"], Json({"pfd"}));
    const Finished csv = run({"pixel", address(), "3", "4", "--spp", "8", "--value", "depth", "--csv"});
    EXPECT_EQ(csv.out.rfind("sample,depth\n0,3\n1,3\n", 0), 0u) << csv.out;
    const Finished wrong = run({"pixel", address(), "3", "4", "--value", "max(v.depth"});
    EXPECT_EQ(wrong.exitCode, Exit::usage);
    EXPECT_NE(wrong.err.find("^"), std::string::npos) << wrong.err;
    EXPECT_EQ(run({"pixel", address(), "3", "4", "--csv"}).exitCode, Exit::usage);
}

TEST_F(Inspects, TablesOfAPixel) {
    std::map<bool, std::pair<double, int>> expected;
    for (const double v : luminances(100)) {
        expected[v > 0.5].first += v;
        ++expected[v > 0.5].second;
    }
    const Json found = json({"stats", address(), "3", "4", "--spp", "100", "--table",
                             "count() as n, mean(luminance) as m group by luminance > 0.5", "--json"});
    ASSERT_EQ(found["rows"].size(), 2u);
    for (const int row : {0, 1}) {
        EXPECT_EQ(found["rows"][row]["n"], expected[row == 1].second);
        EXPECT_NEAR(found["rows"][row]["m"].get<double>(), expected[row == 1].first / expected[row == 1].second, 1e-6);
    }
    const Finished csv = run({"stats", address(), "3", "4", "--spp", "8", "--table",
                              "count() as n, max(v.depth) as d where v.depth > 1", "--csv"});
    EXPECT_EQ(csv.out, "n,d\n16,3\n") << csv.err;
    const Finished text = run({"stats", address(), "3", "4", "--spp", "8", "--table", "count() group by v.name"});
    EXPECT_NE(text.out.find("vertex 2"), std::string::npos) << text.out;
    const Finished missing = run({"stats", address(), "3", "4", "--table", "mean(v.pfd)"});
    EXPECT_EQ(missing.exitCode, Exit::ok);
    EXPECT_NE(missing.err.find("pfd"), std::string::npos);
    const Finished wrong = run({"stats", address(), "3", "4", "--table", "mean(luminance) grup by depth"});
    EXPECT_EQ(wrong.exitCode, Exit::usage);
    EXPECT_NE(wrong.err.find("                ^"), std::string::npos) << wrong.err;
}

TEST_F(Inspects, StatsOfAnImage) {
    Image image(4, 3);
    for (std::size_t i = 0; i < image.size(); ++i) image.data()[i] = 0.5f;
    image.setColor({1, 2}, Color(static_cast<float>(kNaN), 2, -1));
    image.setColor({2, 2}, Color(INFINITY, 0.5f, 0.5f));
    ASSERT_TRUE(imageio::write(program.file("a.exr"), image).ok());
    const Json stats = json({"stats", "a.exr", "--json"});
    EXPECT_EQ(stats["width"], 4);
    ASSERT_EQ(stats["channels"].size(), 4u);
    EXPECT_EQ(stats["channels"][0]["nan"], 1);
    EXPECT_EQ(stats["channels"][0]["positiveInfinite"], 1);
    EXPECT_EQ(stats["channels"][0]["mean"], 0.5);
    EXPECT_EQ(stats["channels"][1]["max"], 2.0);
    EXPECT_EQ(stats["channels"][2]["negative"], 1);
    EXPECT_EQ(stats["channels"][3]["channel"], "luminance");
    EXPECT_EQ(stats["faultyPixels"], 2);
    EXPECT_EQ(stats["faults"][0]["pixel"].dump(), "[1,2]");
    EXPECT_EQ(stats["faults"][0]["fault"], "NaN");
    EXPECT_NE(run({"stats", "a.exr"}).out.find("2 faulty pixels: (1, 2) NaN, (2, 2) infinite"), std::string::npos);
    EXPECT_EQ(lines(run({"stats", "a.exr", "--csv"}).out), 5u);
    const Json part = json({"stats", "a.exr", "--rect", "1,1,4,3", "--json"});
    EXPECT_EQ(part["rect"].dump(), "[1,1,4,3]");
    EXPECT_EQ(part["channels"][0]["finite"], 4);
    EXPECT_EQ(part["channels"][1]["median"], 0.5);
    EXPECT_EQ(part["channels"][1]["max"], 2.0);
    EXPECT_EQ(json({"stats", "a.exr", "--rect", "0,0,4,2", "--json"})["faultyPixels"], 0);
    EXPECT_NE(run({"stats", "a.exr", "--rect", "1,1,4,3"}).out.find("of them 3 x 2 at (1, 1)"), std::string::npos);
    EXPECT_EQ(run({"stats", "a.exr", "--rect", "1,1,5,3"}).exitCode, 3);
    EXPECT_EQ(run({"stats", "a.exr", "--rect", "1,1,1,3"}).exitCode, 2);
    EXPECT_EQ(run({"stats", "127.0.0.1:1", "1", "1", "--rect", "0,0,1,1"}).exitCode, 2);
}

TEST_F(Inspects, DiffByEveryMetric) {
    write("a.exr", 6, 5, {1, 0.5f, 0});
    write("b.exr", 6, 5, {3, 0.5f, 0});
    const auto mean = [&](const char* metric) {
        return json({"diff", "a.exr", "b.exr", "--metric", metric, "--json"})["channels"][0]["mean"].get<double>();
    };
    EXPECT_NEAR(mean("error"), -2, 1e-6);
    EXPECT_NEAR(mean("abs"), 2, 1e-6);
    EXPECT_NEAR(mean("sq"), 4, 1e-6);
    EXPECT_NEAR(mean("rel"), 2 / 3.01, 1e-6);
    EXPECT_NEAR(mean("relsq"), 4 / 9.01, 1e-6);
    EXPECT_NEAR(mean("smape"), 4 / 4.02, 1e-6);
    const Json flip = json({"diff", "a.exr", "b.exr", "--metric", "flip", "-o", "f.exr", "--json"});
    EXPECT_EQ(flip["metric"], "HDR-FLIP");
    EXPECT_EQ(flip["channels"].size(), 1u);
    EXPECT_GT(flip["mean"].get<double>(), 0);
    EXPECT_LE(flip["mean"].get<double>(), 1);
    EXPECT_EQ(flip["exposures"]["count"], 1);
    const auto written = imageio::read(program.file("f.exr"));
    ASSERT_TRUE(written.ok());
    EXPECT_NEAR(analysis::meanOf(*written), flip["mean"].get<double>(), 1e-6);
    const Finished text = run({"diff", "a.exr", "b.exr"});
    EXPECT_NE(text.out.find("absolute error of a.exr against b.exr, 6 x 5 pixels"), std::string::npos) << text.out;
    // 8-bit images show what the screen shows.
    write("a.png", 6, 5, {1, 1, 1});
    write("b.png", 6, 5, {0, 0, 0});
    const Json low = json({"diff", "a.png", "b.png", "--metric", "flip", "--json"});
    EXPECT_EQ(low["metric"], "LDR-FLIP");
    EXPECT_NEAR(low["mean"].get<double>(), 0.96739, 1e-4);
}

TEST_F(Inspects, DiffFailsAboveALimit) {
    write("a.exr", 6, 5, {1, 0.5f, 0});
    write("b.exr", 6, 5, {1.25f, 0.5f, 0});
    EXPECT_EQ(run({"diff", "a.exr", "b.exr", "--fail-above", "0.25"}).exitCode, Exit::ok);
    const Finished above = run({"diff", "a.exr", "b.exr", "--metric", "error", "--fail-above", "0.2"});
    EXPECT_EQ(above.exitCode, Exit::assertionFalse) << "a signed error counts by its size";
    EXPECT_NE(above.out.find("failed: 0.2500 is above the limit of 0.2000"), std::string::npos) << above.out;
    const Finished said = run({"diff", "a.exr", "b.exr", "--fail-above", "0.2", "--json"});
    EXPECT_EQ(said.exitCode, Exit::assertionFalse);
    EXPECT_EQ(Json::parse(said.out)["fails"], true);
    EXPECT_EQ(run({"diff", "a.exr", "a.exr", "--fail-above", "0"}).exitCode, Exit::ok);
    // A NaN that only one image has is a difference without a number.
    Image broken = *imageio::read(program.file("a.exr"));
    broken.at({2, 2})[1] = static_cast<float>(kNaN);
    ASSERT_TRUE(imageio::write(program.file("nan.exr"), broken).ok());
    for (const char* metric : {"abs", "flip"}) {
        const Finished nan = run({"diff", "nan.exr", "a.exr", "--metric", metric, "--fail-above", "100", "--json"});
        EXPECT_EQ(nan.exitCode, Exit::assertionFalse);
        EXPECT_EQ(Json::parse(nan.out)["incomparable"], 1);
        EXPECT_EQ(run({"diff", "nan.exr", "nan.exr", "--metric", metric, "--fail-above", "0"}).exitCode, Exit::ok);
    }
}

TEST_F(Inspects, MistakesAreSaid) {
    expectError({"outliers", address(), "3", "4", "--method", "guess"}, Exit::usage, "sigma or esd");
    expectError({"outliers", address(), "3", "4", "--deviations", "0"}, Exit::usage, "--deviations");
    expectError({"outliers", address(), "3", "4", "--alpha", "2"}, Exit::usage, "--alpha");
    expectError({"outliers", address(), "3", "4", "--max", "none"}, Exit::usage, "--max");
    expectError({"outliers", address(), "3", "4", "--quantity", "taste"}, Exit::usage, "taste");
    expectError({"outliers", address(), "16", "0"}, Exit::input, "16 x 12");
    expectError({"stats", address(), "0", "12"}, Exit::input, "16 x 12");
    expectError({"stats", "absent.exr"}, Exit::input, "absent.exr");
    expectError({"stats", "absent.exr", "--table", "count()"}, Exit::usage, "HOST:PORT X Y");
    EXPECT_EQ(run({"stats", address(), "3"}).exitCode, Exit::usage);
    write("a.exr", 6, 5, {1, 1, 1});
    write("b.exr", 5, 6, {1, 1, 1});
    for (const char* metric : {"abs", "flip"})
        expectError({"diff", "a.exr", "b.exr", "--metric", metric}, Exit::input, "6 x 5");
    expectError({"diff", "a.exr", "absent.exr"}, Exit::input, "absent.exr");
    expectError({"diff", "a.exr", "a.exr", "--metric", "psnr"}, Exit::usage, "psnr");
    expectError({"diff", "a.exr", "a.exr", "--fail-above", "much"}, Exit::usage, "--fail-above");
    expectError({"diff", "a.exr", "a.exr", "-o", "a.xyz"}, Exit::input, "xyz");
}

}  // namespace
}  // namespace emca::cli
