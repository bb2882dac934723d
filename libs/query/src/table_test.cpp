#include "emca/query/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "emca/recorder/handles.h"
#include "emca/recorder/recording.h"

namespace emca::query {
namespace {

/// Paths of random depth whose vertices know a pdf (most of them), and how they were found.
PathSet somePaths(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform;
    Recording recording;
    for (int i = 0; i < count; ++i) {
        const PathHandle path = recording.path({static_cast<std::uint32_t>(i % 3), 0}, i / 3);
        path.finalEstimate(Color(uniform(random), uniform(random), uniform(random)));
        const int depth = 1 + static_cast<int>(uniform(random) * 5);
        for (int d = 1; d <= depth; ++d) {
            const VertexHandle vertex = path.vertex(d);
            vertex.position(Vec3f{uniform(random), uniform(random), 0});
            if (uniform(random) < 0.8f) vertex.add("pdf", uniform(random));
            if (uniform(random) < 0.5f) vertex.contribution(Color(uniform(random)), d % 2 ? "light" : "BSDF", 0.5f);
        }
        path.add("end", std::string_view(depth > 3 ? "roulette" : "absorbed"));
    }
    return *recording.finish();
}

const TableColumn& column(const TableRows& rows, std::string_view name) {
    for (const TableColumn& c : rows.columns)
        if (c.name == name) return c;
    ADD_FAILURE() << "no column " << name;
    return rows.columns.front();
}

TableRows evaluated(const char* text, const PathSet& paths) {
    const auto table = Table::parse(text);
    EXPECT_TRUE(table) << (table ? "" : table.error().message);
    if (!table) return {};
    auto rows = table->evaluate(paths);
    EXPECT_TRUE(rows) << (rows ? "" : rows.error().message);
    return rows ? *rows : TableRows{};
}

TEST(Table, GroupsPathsByDepthAsALoopDoes) {
    const PathSet paths = somePaths(4000);
    std::map<int, std::vector<double>> expected;
    for (Index p = 0; p < paths.pathCount(); ++p) expected[paths.depth(p)].push_back(static_cast<double>(luminance(*paths.estimate(p))));
    const TableRows rows = evaluated("count(), mean(luminance) as m, variance(luminance), min(luminance), max(luminance), quantile(luminance, 0.5) group by depth", paths);
    ASSERT_EQ(rows.rowCount, expected.size());
    EXPECT_TRUE(rows.columns[0].key);
    std::size_t row = 0;
    for (auto& [depth, values] : expected) {
        double sum = 0, squares = 0;
        for (const double x : values) sum += x;
        const double mean = sum / static_cast<double>(values.size());
        for (const double x : values) squares += (x - mean) * (x - mean);
        std::sort(values.begin(), values.end());
        EXPECT_EQ(column(rows, "depth").values.numbers[row], depth);
        EXPECT_EQ(column(rows, "count()").values.numbers[row], static_cast<double>(values.size()));
        EXPECT_NEAR(column(rows, "m").values.numbers[row], mean, 1e-12);
        EXPECT_NEAR(column(rows, "variance(luminance)").values.numbers[row], squares / static_cast<double>(values.size() - 1), 1e-12);
        EXPECT_EQ(column(rows, "min(luminance)").values.numbers[row], values.front());
        EXPECT_EQ(column(rows, "max(luminance)").values.numbers[row], values.back());
        const std::size_t n = values.size();
        EXPECT_NEAR(column(rows, "quantile(luminance, 0.5)").values.numbers[row], n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2, 1e-12);
        ++row;
    }
}

TEST(Table, RowsAreContributionsWhereTheyAreNamed) {
    const PathSet paths = somePaths(3000);
    std::map<std::string, std::pair<double, int>> expected;
    for (Index v = 0; v < paths.vertexCount(); ++v) {
        const IndexRange range = paths.contributions(v);
        for (Index i = range.first; i < range.last; ++i) {
            auto& [sum, count] = expected[std::string(paths.text(paths.contribution(i).technique))];
            sum += static_cast<double>(luminance(paths.contribution(i).value));
            ++count;
        }
    }
    const TableRows rows = evaluated("sum(c.luminance), count(), sum(c.luminance) / count() as average group by c.technique", paths);
    ASSERT_EQ(rows.rowCount, 2u);
    for (std::size_t row = 0; row < 2; ++row) {
        const auto [sum, count] = expected.at(column(rows, "c.technique").values.texts[row]);
        EXPECT_NEAR(column(rows, "sum(c.luminance)").values.numbers[row], sum, 1e-9);
        EXPECT_EQ(column(rows, "count()").values.numbers[row], count);
        EXPECT_NEAR(column(rows, "average").values.numbers[row], sum / count, 1e-9);
    }
}

TEST(Table, WhereAndUnknownValues) {
    const PathSet paths = somePaths(2000);
    Index deep = 0, known = 0, all = 0;
    for (Index v = 0; v < paths.vertexCount(); ++v) {
        const Column& pdf = *paths.find(Scope::vertex, "pdf")[0];
        if (paths.depthIndex(v) < 2) continue;
        ++deep;
        known += paths.last(pdf, v).has_value();
    }
    for (Index p = 0; p < paths.pathCount(); ++p) all += paths.depth(p) > 3;
    const TableRows rows = evaluated("count(), count(has(v.pdf)) where v.depth >= 2", paths);
    ASSERT_EQ(rows.rowCount, 1u);
    EXPECT_EQ(rows.columns[0].values.numbers[0], deep);
    EXPECT_EQ(rows.columns[1].values.numbers[0], known);
    EXPECT_EQ(evaluated("count() where end == \"roulette\"", paths).columns[0].values.numbers[0], all);
    // Values that were not recorded make a group of their own, the last one.
    const TableRows groups = evaluated("count() group by has(v.pdf)", paths);
    EXPECT_EQ(groups.rowCount, 2u);
    const TableRows nothing = evaluated("count(), mean(v.nobody) group by v.nobody", paths);
    ASSERT_EQ(nothing.rowCount, 1u);
    EXPECT_EQ(nothing.columns[0].values.known[0], 0);
    EXPECT_EQ(nothing.columns[2].values.known[0], 0);
    EXPECT_EQ(nothing.missing, std::vector<std::string>{"nobody"});
}

TEST(Table, WithoutPathsThereIsOneRowAndNoGroup) {
    const PathSet none;
    EXPECT_EQ(evaluated("count(), sum(luminance), mean(luminance)", none).rowCount, 1u);
    EXPECT_EQ(evaluated("count(), sum(luminance), mean(luminance)", none).columns[0].values.numbers[0], 0);
    EXPECT_EQ(evaluated("count() group by depth", none).rowCount, 0u);
}

TEST(Table, ErrorsPointAtThePiece) {
    const auto place = [](const char* text) {
        QueryError error;
        const auto table = Table::parse(text, &error);
        EXPECT_FALSE(table) << text;
        return error.where.begin;
    };
    EXPECT_EQ(place("luminance"), 0u);                            // not aggregated
    EXPECT_EQ(place("count(), depth group by sample"), 9u);
    EXPECT_EQ(place("count() group depth"), 14u);
    EXPECT_EQ(place("count() where luminance"), 14u);
    EXPECT_EQ(place("sum(c.luminance), count(n.visible)"), 24u);  // two kinds of rows
    EXPECT_EQ(place("mean(v.event)"), 5u);
    EXPECT_EQ(place("count(), "), 9u);
}

TEST(Table, MemoryIsBounded) {
    const PathSet paths = somePaths(20000);
    const auto table = Table::parse("mean(v.pdf)");
    EvaluationLimits limits;
    limits.temporaryBytes = 64 << 10;
    const auto rows = table->evaluate(paths, limits);
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().code, ErrorCode::tooLarge);
}

}  // namespace
}  // namespace emca::query
