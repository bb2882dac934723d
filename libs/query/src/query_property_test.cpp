// Random queries on random paths: evaluated column by column, and by brute force.
#include <gtest/gtest.h>

#include "brute_force_for_tests.h"
#include "query_for_tests.h"
#include "random_query_for_tests.h"

namespace emca::query {
namespace {

using detail::BruteForce;
using detail::Single;

struct Counts {
    int compared = 0, refused = 0, known = 0, selected = 0;
};

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

std::string describe(const Single& s) {
    if (!s.known) return "unknown";
    std::string out = s.text.empty() ? "" : "\"" + s.text + "\"";
    for (const double x : s.numbers) out += std::to_string(x) + " ";
    return out;
}

/// Value p of `values` is the one that brute force found.
::testing::AssertionResult agrees(const PathValues& values, Index p, const Single& expected) {
    bool equal = (values.known[p] != 0) == expected.known;
    Single found{values.known[p] != 0, values.type, false, {}, {}};
    if (values.type == ExpressionType::text) found.text = values.texts[p];
    else found.numbers.assign(values.numbers.begin() + p * values.components, values.numbers.begin() + (p + 1) * values.components);
    if (equal && expected.known) {
        equal = values.type == ExpressionType::text ? found.text == expected.text : found.numbers.size() == expected.numbers.size();
        for (std::size_t c = 0; equal && c < expected.numbers.size(); ++c) equal = same(found.numbers[c], expected.numbers[c]);
    }
    if (equal) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "path " << p << ": found " << describe(found) << ", by brute force " << describe(expected);
}

/// `limited` is the same recording, with nothing but what the query reads.
void compare(const std::string& text, const PathSet& paths, const PathSet* limited, Counts& counts, long budget = 1L << 40) {
    SCOPED_TRACE(text);
    const auto query = Query::parse(text);
    ASSERT_TRUE(query.ok()) << query.error().message;
    const auto values = query->evaluate(paths);
    if (!values) {  // a type that only this set decides
        EXPECT_EQ(values.error().code, ErrorCode::parseFailed) << values.error().message;
        ++counts.refused;
        return;
    }
    detail::Node tree;
    QueryError error;
    ASSERT_TRUE(detail::parseExpression(text, tree, error));
    BruteForce bruteForce(paths, budget);
    try {
        for (Index p = 0; p < paths.pathCount(); ++p) {
            const Single expected = bruteForce.at(tree, {detail::Domain::path, p, 0, 0});
            counts.known += expected.known;
            ASSERT_TRUE(agrees(*values, p, expected));
        }
    } catch (const BruteForce::TooLong&) {
        return;
    }
    ++counts.compared;
    if (values->type == ExpressionType::boolean) {
        const auto matches = query->select(paths);
        ASSERT_TRUE(matches.ok());
        counts.selected += !matches->paths.empty();
    }
    if (!limited) return;
    const auto pushed = query->evaluate(*limited);
    ASSERT_TRUE(pushed.ok()) << pushed.error().message;
    ASSERT_EQ(pushed->known, values->known) << "with its own columns only";
    ASSERT_EQ(pushed->texts, values->texts);
    ASSERT_EQ(pushed->missing, values->missing);
    for (std::size_t i = 0; i < values->numbers.size(); ++i) ASSERT_TRUE(same(pushed->numbers[i], values->numbers[i]));
}

TEST(QueryProperty, ColumnsAgreeWithBruteForce) {
    Counts counts;
    detail::RandomQueries queries(1);
    for (unsigned seed = 0; seed < 40 && !::testing::Test::HasFailure(); ++seed) {
        const bool sparse = seed % 4 == 3;
        RandomPaths record(seed, 1 + static_cast<int>(seed % 4), 6, seed % 5 == 0 ? 1 : 6, sparse);
        const PathSet paths = recorded(record);
        for (int i = 0; i < 150 && !::testing::Test::HasFailure(); ++i) {
            const std::string text = i % 3 == 0 ? queries.value(i % 5) : queries.condition(1 + i % 5);
            const auto query = Query::parse(text);
            ASSERT_TRUE(query.ok()) << query.error().message << "\n" << text;
            const PathSet limited = recorded(record, query->columns());
            ASSERT_EQ(limited.pathCount(), paths.pathCount());
            compare(text, paths, &limited, counts);
        }
    }
    // The comparison says something only if queries are decided, and differently.
    EXPECT_GT(counts.compared, 5000);
    EXPECT_LT(counts.refused, 300);
    EXPECT_GT(counts.known, 20000);
    EXPECT_GT(counts.selected, 500);
}

TEST(QueryProperty, ChunksDoNotShow) {
    Counts counts;
    detail::RandomQueries queries(2);
    for (const bool sparse : {false, true}) {
        const PathSet paths = recorded(RandomPaths(7, 5, 1500, 8, sparse));
        ASSERT_GT(paths.vertexCount(), 2 * 4096u);
        for (int i = 0; i < 100 && !::testing::Test::HasFailure(); ++i) compare(i % 3 == 0 ? queries.value(3) : queries.condition(3), paths, nullptr, counts, 400'000);
    }
    EXPECT_GT(counts.compared, 80);
}

}  // namespace
}  // namespace emca::query
