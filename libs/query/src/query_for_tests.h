#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "emca/query/query.h"
#include "emca/recorder/handles.h"
#include "emca/recorder/recording.h"

namespace emca::query {

/// What `record(recording)` records, limited to `columns` (empty: all).
template <typename Record>
PathSet recorded(Record record, std::vector<std::string> columns = {}) {
    RecordingOptions options;
    options.columns = std::move(columns);
    Recording recording(std::move(options));
    record(recording);
    return *recording.finish();
}

inline Query parsed(std::string_view text) {
    auto query = Query::parse(text);
    EXPECT_TRUE(query.ok()) << text << ": " << query.error().message;
    return query.ok() ? *query : *Query::parse("false");
}

/// "1" true, "0" false, "?" unknown, one per path; the error's sentence if there is one.
inline std::string truths(std::string_view text, const PathSet& paths) {
    const Query query = parsed(text);
    const auto values = query.evaluate(paths);
    if (!values) return values.error().message;
    std::string out;
    for (Index p = 0; p < paths.pathCount(); ++p) out += !values->known[p] ? '?' : values->numbers[p] != 0 ? '1' : '0';
    const auto matches = query.select(paths);
    if (!matches) return matches.error().message;
    // The two ways to ask agree.
    std::vector<Index> expected;
    for (Index p = 0; p < paths.pathCount(); ++p)
        if (out[p] == '1') expected.push_back(p);
    EXPECT_EQ(matches->paths, expected) << text;
    EXPECT_EQ(matches->unknown, static_cast<Index>(std::count(out.begin(), out.end(), '?'))) << text;
    return out;
}

/// Random paths of a few pixels with every kind of column, values that are not numbers, gaps, repeated keys, paths and
/// vertices without anything. The same calls for the same seed, whatever the recording keeps.
class RandomPaths {
  public:
    RandomPaths(unsigned seed, int pixels, int paths, int vertices, bool sparse = false)
        : seed_(seed), pixels_(pixels), paths_(paths), vertices_(vertices), sparse_(sparse) {}

    void operator()(Recording& recording) {
        random_.seed(seed_);
        for (int pixel = 0; pixel < pixels_; ++pixel) {
            const int count = upTo(paths_ + 1);
            for (int p = 0; p < count; ++p) path(recording.path({static_cast<std::uint32_t>(pixel * 3), static_cast<std::uint32_t>(pixel % 2)}, p * 2 + upTo(2)));
        }
    }

  private:
    int upTo(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    bool often() { return upTo(sparse_ ? 4 : 10) < (sparse_ ? 1 : 8); }
    double number() {
        static constexpr double kOften[] = {0, 1, -1, 0.5, 2, 3, 0.1, 1e-4, 10};
        switch (upTo(24)) {
            case 0: return std::numeric_limits<double>::quiet_NaN();
            case 1: return std::numeric_limits<double>::infinity();
            case 2: return -std::numeric_limits<double>::infinity();
            case 3: case 4: case 5: return static_cast<double>(random_()) / 1e9 - 2;
            default: return kOften[upTo(9)];
        }
    }
    float single() { return static_cast<float>(number()); }
    Color color() { return {single(), single(), single()}; }
    Vec3f vector() { return {single(), single(), single()}; }
    std::string text() {
        static constexpr const char* kTexts[] = {"", "a", "ab", "glass", "rough glass", "diffuse", "reflect", "grün"};
        return kTexts[upTo(8)];
    }

    /// All kinds of values, at paths and at vertices.
    template <typename Handle>
    void values(const Handle& to) {
        to.add("dense", single());
        to.add("dense vector", vector());
        if (often()) to.add("f", single());
        if (often()) to.add("d", number());
        if (often()) to.add("i", std::int64_t{upTo(5) - 2});
        if (often()) to.add("b", upTo(2) == 0);
        if (often()) to.add("t", text());
        if (often()) to.add("col", color());
        if (often()) to.add("ca", ColorA{single(), single(), single(), single()});
        if (often()) to.add("v2", Vec2f{single(), single()});
        if (often()) to.add("vd", Vec3d{number(), number(), number()});
        if (often()) to.add("s", std::vector<float>(static_cast<std::size_t>(upTo(4)), single()));
        for (int n = upTo(4); n > 0; --n) to.add("again", single());
        if (upTo(3) == 0) to.add("mixed", std::int64_t{upTo(4)});
        else if (upTo(2) == 0) to.add("mixed", number());
        if (often()) to.add("position", single());
        if (upTo(6) == 0) to.add("rare key", single());
    }

    void vertex(const VertexHandle& v) {
        if (often()) v.position(vector());
        else if (upTo(3) == 0) v.environment(vector());
        if (often()) v.estimate(color());
        if (upTo(3) == 0) v.emission(upTo(2) == 0 ? Color(0) : color());
        if (often()) v.surface(upTo(3), upTo(9));
        if (often()) v.event(static_cast<Event>(upTo(8)), static_cast<Lobe>(upTo(5)), text());
        for (int n = upTo(4) - 1; n > 0; --n) v.nextEvent(vector(), upTo(2) == 0);
        for (int n = upTo(4) - 1; n > 0; --n) v.contribution(color(), text(), single(), static_cast<LightEnd>(upTo(3)));
        if (upTo(10) != 0) values(v);
    }

    void path(const PathHandle& p) {
        p.origin(vector());
        if (upTo(12) == 0) return;
        if (often()) p.finalEstimate(color());
        if (upTo(4) == 0) p.splat({1, 1}, color());
        values(p);
        const int count = upTo(vertices_ + 1);
        int depth = upTo(2);
        for (int i = 0; i < count; ++i, depth += 1 + (upTo(5) == 0)) vertex(p.vertex(depth, upTo(12) == 0 ? Subpath::light : Subpath::camera));
    }

    std::mt19937 random_;
    unsigned seed_;
    int pixels_, paths_, vertices_;
    bool sparse_;
};

}  // namespace emca::query
