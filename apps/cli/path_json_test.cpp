#include "path_json.h"

#include <gtest/gtest.h>

#include "trace_for_tests.h"

namespace emca::cli {
namespace {

std::vector<std::string> keys(const Json& json) {
    std::vector<std::string> result;
    for (auto it = json.begin(); it != json.end(); ++it) result.push_back(it.key());
    return result;
}
using Keys = std::vector<std::string>;

TEST(PixelJson, HasTheMembersOfTheContract) {
    const Json json = pixelJson(exampleTrace());
    EXPECT_EQ(json["pixel"].dump(), "[3,4]");
    EXPECT_EQ(json["spp"], 2);
    EXPECT_EQ(json["replay"].dump(),
              R"({"verdict":"close","rendered":[0.5,0.5,0.5],"replayed":[0.50001,0.50001,0.50001],"sums":"matches"})");
    ASSERT_EQ(json["paths"].size(), 2u);
    EXPECT_EQ(keys(json["paths"][0]),
              (Keys{"sample", "part", "origin", "depth", "estimate", "data", "contributions", "vertices"}));
    EXPECT_EQ(keys(json["paths"][0]["vertices"][1]),
              (Keys{"depth", "position", "event", "surface", "nee", "envmap", "estimate", "emission", "data"}));
    EXPECT_FALSE(json.contains("dropped"));
}

TEST(PixelJson, ValuesOfAPath) {
    const Json path = pixelJson(exampleTrace())["paths"][0];
    EXPECT_EQ(path["sample"], 5);
    EXPECT_EQ(path["origin"].dump(), "[0.0,1.0,2.0]");
    EXPECT_EQ(path["depth"], 3);
    EXPECT_EQ(path["estimate"].dump(), R"([0.1,"NaN","Infinity"])");
    EXPECT_EQ(path["data"].dump(), R"({"weight":0.75})");
    EXPECT_EQ(path["contributions"].dump(),
              R"([{"depth":1,"technique":"light sampling","value":[0.1,0.2,0.3],"misWeight":0.25,"end":"connected"}])");
}

TEST(PixelJson, ValuesOfVertices) {
    const Json vertices = pixelJson(exampleTrace())["paths"][0]["vertices"];
    EXPECT_EQ(vertices[0].dump(),
              R"({"depth":1,"position":[1.0,2.0,3.0],"event":{"type":"transmit","lobe":"specular","label":"glass"},)"
              R"("surface":{"mesh":2,"face":11},"nee":[{"position":[0.0,5.0,0.0],"visible":true},)"
              R"({"position":[0.0,6.0,0.0],"visible":false}],"envmap":null,"estimate":[0.5,0.5,0.5],)"
              R"("emission":[0.0,0.0,0.0],"data":{"pdf":2.0},"history":{"pdf":[1e-05,2.0]}})");
    EXPECT_EQ(vertices[2]["event"].dump(), R"({"type":"background","lobe":"none","label":null})");
    // The environment's hit is not a position in the scene.
    EXPECT_TRUE(vertices[2]["position"].is_null());
    EXPECT_EQ(vertices[2]["envmap"].dump(), "[7.0,8.0,9.0]");
    EXPECT_EQ(vertices[2]["data"].dump(), R"({"pdf":"NaN"})");
    EXPECT_FALSE(vertices[2].contains("history"));
}

TEST(PixelJson, MissingValuesAreNullAndMissingListsEmpty) {
    const Json json = pixelJson(exampleTrace());
    EXPECT_EQ(
        json["paths"][1].dump(),
        R"({"sample":9,"part":2,"origin":null,"depth":0,"estimate":null,"data":{},"contributions":[],"vertices":[]})");
    EXPECT_EQ(
        json["paths"][0]["vertices"][1].dump(),
        R"({"depth":2,"position":null,"event":null,"surface":null,"nee":[],"envmap":null,"estimate":null,"emission":null,"data":{}})");
}

TEST(PixelJson, UnknownVerdictHasNoRenderedColor) {
    client::Trace trace = exampleTrace();
    trace.replays[0].verdict = Verdict::unknown;
    trace.stats.droppedByBudget = 3;
    const Json json = pixelJson(trace);
    EXPECT_TRUE(json["replay"]["rendered"].is_null());
    EXPECT_EQ(json["dropped"]["byBudget"], 3);
}

TEST(PixelJson, AnEmptyPixelHasNoPaths) {
    client::Trace trace = exampleTrace();
    trace.paths = PathSet();
    EXPECT_EQ(pixelJson(trace)["paths"].dump(), "[]");
}

}  // namespace
}  // namespace emca::cli
