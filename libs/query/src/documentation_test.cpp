// docs/queries.md: every query on it is valid and finds what it says; its tables are those of names.cpp.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "emca/query/table.h"
#include "query_for_tests.h"
#include "syntax.h"

namespace emca::query {
namespace {

std::string page() {
    std::ifstream file(EMCA_SOURCE_DIR "/docs/queries.md");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<std::string> blocks(const std::string& kind) {
    const std::string text = page(), begin = "```" + kind + "\n";
    std::vector<std::string> out;
    for (std::size_t at = 0; (at = text.find(begin, at)) != text.npos;) {
        at += begin.size();
        out.push_back(text.substr(at, text.find("\n```", at) - at));
    }
    return out;
}

/// What the reference renderer records, with an example of each question and one path that is as it should be.
PathSet renderedPaths() {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    return recorded([](Recording& r) {
        const auto path = [&](int sample, float value, const char* end) {
            return r.path({0, 0}, sample).origin(Vec3f{0, 0, -1}).finalEstimate(Color(value)).add("end", end).add("left scene", false);
        };
        const auto vertex = [](const PathHandle& p, int depth, Lobe lobe, Event event = Event::reflect) {
            return p.vertex(depth).position(Vec3f{0, 0, static_cast<float>(depth)}).event(event, lobe, "paint").surface(depth, 0).add("shape", "wall").add("material", "paint")
                .add("throughput", Color(1)).add("BSDF pdf", 0.3f).add("BSDF weight", Color(0.8f));
        };
        for (int i = 0; i < 60; ++i) {
            const auto ordinary = path(i, 0.01f, "maximum depth");
            vertex(ordinary, 1, Lobe::diffuse).nextEvent(Vec3f{0, 5, 0}, true).contribution(Color(0.1f), "light sampling", 0.6f, LightEnd::connected);
            vertex(ordinary, 2, Lobe::diffuse).add("roulette survival probability", 0.95f);
        }
        vertex(path(100, 500, "maximum depth"), 1, Lobe::glossy).add("BSDF pdf", 1e-6f);                              // a firefly
        const auto caustic = path(101, 0.01f, "maximum depth");
        vertex(caustic, 1, Lobe::diffuse);
        vertex(caustic, 2, Lobe::specular, Event::transmit).add("shape", "window");
        vertex(caustic, 3, Lobe::none, Event::emission).emission(Color(9)).contribution(Color(1), "BSDF sampling", 1.f, LightEnd::hit);
        const auto window = path(102, 2, "Russian roulette");
        vertex(window, 1, Lobe::diffuse).add("shape", "window").add("roulette survival probability", 0.9f).contribution(Color(1, -1, 0), "light sampling", 0.001f, LightEnd::connected);
        vertex(window, 2, Lobe::diffuse).position(Vec3f{0, 0, 1.00001f}).contribution(Color(2), "BSDF sampling", 0.999f, LightEnd::hit);
        r.path({1, 0}, 0).finalEstimate(Color(kNan)).vertex(1).position(Vec3f{}).event(Event::reflect, Lobe::diffuse).add("BSDF weight", Color(kNan)).contribution(Color(3), "light sampling", 1.f, LightEnd::connected);
    });
}

TEST(QueryDocumentation, EveryQueryIsAnswered) {
    const PathSet paths = renderedPaths();
    const auto queries = blocks("query");
    EXPECT_GE(queries.size(), 12u);
    for (const std::string& text : queries) {
        const auto query = Query::parse(text);
        ASSERT_TRUE(query.ok()) << text << "\n" << query.error().message;
        const auto matches = query->select(paths);
        ASSERT_TRUE(matches.ok()) << text << "\n" << matches.error().message;
        EXPECT_FALSE(matches->paths.empty()) << text;
        EXPECT_LT(matches->paths.size(), paths.pathCount()) << text;
        EXPECT_TRUE(matches->missing.empty()) << text << " reads " << ::testing::PrintToString(matches->missing);
    }
    const auto tables = blocks("table");
    EXPECT_GE(tables.size(), 3u);
    for (const std::string& text : tables) {
        const auto table = Table::parse(text);
        ASSERT_TRUE(table.ok()) << text << "\n" << table.error().message;
        const auto rows = table->evaluate(paths);
        ASSERT_TRUE(rows.ok()) << text << "\n" << rows.error().message;
        EXPECT_GT(rows->rowCount, 0u) << text;
        EXPECT_GT(rows->columns.size(), 1u) << text;
    }
}

TEST(QueryDocumentation, TablesAreThoseOfTheProgram) {
    const std::string text = page();
    for (const detail::CoreName& core : detail::coreNames()) {
        const std::string dot = core.domain == detail::Domain::path ? "" : ".";
        std::string row = std::string("| `") + detail::prefix(core.domain) + dot + core.name + "` | " + name(core.type);
        if (core.type == ExpressionType::vector) row += " of " + std::to_string(core.components);
        row += std::string(" | ") + core.meaning + " |\n";
        EXPECT_NE(text.find(row), text.npos) << "docs/queries.md needs the row\n" << row;
    }
    for (const detail::Function& f : detail::functions())
        EXPECT_NE(text.find(std::string("`") + f.name + "`"), text.npos) << "docs/queries.md does not mention " << f.name;
}

}  // namespace
}  // namespace emca::query
