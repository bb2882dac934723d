#include "emca/core/path_set.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

namespace emca {
namespace {

template <typename T>
SharedArray<std::byte> bytesOf(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// Two paths of pixel (x, 0), samples 0 and 1, with two and one vertices.
PathColumns sampleColumns(std::uint32_t x = 0, std::string label = "wall") {
    PathColumns c;
    c.pixels = std::vector<Pixel>{{x, 0}, {x, 0}};
    c.samples = std::vector<std::int64_t>{0, 1};
    c.parts = std::vector<std::int32_t>{0, 0};
    c.pathFlags = std::vector<std::uint8_t>{PathFlag::hasEstimate, 0};
    c.estimates = std::vector<Color>{Color(2.f), Color()};
    c.firstVertex = std::vector<Index>{0, 2, 3};
    c.depths = std::vector<std::int32_t>{1, 2, 1};
    c.vertexFlags = std::vector<std::uint8_t>{VertexFlag::hasPosition, VertexFlag::hasPosition | VertexFlag::hasEvent, 0};
    c.positions = std::vector<Vec3f>{{1, 0, 0}, {2, 0, 0}, {}};
    c.events = std::vector<std::uint8_t>{0, 1, 0};
    c.lobes = std::vector<std::uint8_t>{0, 1, 0};
    c.labels = std::vector<std::uint32_t>{kNoString, 0, kNoString};
    c.nextEventOwners = std::vector<Index>{1, 1};
    c.nextEvents = std::vector<NextEvent>{{{5, 0, 0}, 1}, {{6, 0, 0}, 0}};
    c.contributionOwners = std::vector<Index>{0};
    c.contributions = std::vector<Contribution>{{Color(1.f), 0.5f, 1, LightEnd::hit, {}}};
    c.splatOwners = std::vector<Index>{1};
    c.splats = std::vector<Splat>{{{x, 0}, Color(3.f)}};
    Column hits{.name = "hits", .scope = Scope::path, .type = ValueType::integer, .count = 2};
    hits.bytes = bytesOf(std::vector<std::int64_t>{7, 8});
    Column shades{.name = "shades", .scope = Scope::vertex, .type = ValueType::spectrum, .count = 2};
    shades.owners = std::vector<Index>{0, 2};
    shades.spectrumOffsets = std::vector<std::uint32_t>{0, 2, 3};
    shades.bytes = bytesOf(std::vector<float>{1, 2, 3});
    Column words{.name = "words", .scope = Scope::vertex, .type = ValueType::text, .count = 1};
    words.owners = std::vector<Index>{2};
    words.bytes = bytesOf(std::vector<std::uint32_t>{0});
    c.columns = {hits, shades, words};
    c.strings = {std::move(label), "light sampling"};
    return c;
}

TEST(PathSet, ReadsWhatTheColumnsSay) {
    auto made = PathSet::make(sampleColumns());
    ASSERT_TRUE(made.ok()) << made.error().message;
    const PathSet& paths = *made;
    EXPECT_EQ(paths.pathCount(), 2u);
    EXPECT_EQ(paths.depth(0), 2);
    EXPECT_EQ(paths.depth(1), 0);
    EXPECT_EQ(paths.estimate(0), Color(2.f));
    EXPECT_FALSE(paths.estimate(1));
    EXPECT_EQ(paths.pathOf(0), 0u);
    EXPECT_EQ(paths.pathOf(1), 0u);
    EXPECT_EQ(paths.pathOf(2), 1u);
    EXPECT_EQ(paths.nextEvents(1).size(), 2u);
    EXPECT_TRUE(paths.nextEvents(0).empty());
    EXPECT_EQ(paths.scattering(1)->label, "wall");
    EXPECT_EQ(paths.findPath({0, 0}, 1), Index(1));
    EXPECT_FALSE(paths.findPath({0, 0}, 2));
    EXPECT_EQ(paths.findVertex(0, 2), Index(1));
    EXPECT_FALSE(paths.findVertex(1, 2));
    EXPECT_EQ(paths.value(paths.userColumns()[1], 1), Value(std::vector<float>{3}));
    EXPECT_EQ(paths.last(paths.userColumns()[2], 2), Value(std::string("wall")));
    EXPECT_TRUE(PathSet::make({}).ok());
}

TEST(PathSet, DamagedColumnsAreRefusedByName) {
    const std::vector<std::pair<const char*, std::function<void(PathColumns&)>>> damages{
        {"sample", [](auto& c) { c.samples = std::vector<std::int64_t>{0}; }},
        {"ordered", [](auto& c) { c.samples = std::vector<std::int64_t>{1, 0}; }},
        {"ordered", [](auto& c) { c.samples = std::vector<std::int64_t>{1, 1}; }},
        {"final estimate", [](auto& c) { c.estimates = {}; }},
        {"first vertex", [](auto& c) { c.firstVertex = {}; }},
        {"belong", [](auto& c) { c.firstVertex = std::vector<Index>{0, 2, 4}; }},
        {"overlap", [](auto& c) { c.firstVertex = std::vector<Index>{0, 9, 3}; }},
        {"position", [](auto& c) { c.positions = std::vector<Vec3f>{{}, {}}; }},
        {"depth", [](auto& c) { c.depths = std::vector<std::int32_t>{2, 2, 1}; }},
        {"label", [](auto& c) { c.labels = std::vector<std::uint32_t>{kNoString, 2, kNoString}; }},
        {"event", [](auto& c) { c.events = std::vector<std::uint8_t>{0, kEventCount, 0}; }},
        {"event", [](auto& c) { c.events = std::vector<std::uint8_t>{255, 1, 0}; }},
        {"lobe", [](auto& c) { c.lobes = std::vector<std::uint8_t>{0, kLobeCount, 0}; }},
        {"unknown way",
         [](auto& c) { c.contributions = std::vector<Contribution>{{Color(), 1, 1, LightEnd(kLightEndCount), {}}}; }},
        {"nee", [](auto& c) { c.nextEventOwners = std::vector<Index>{2, 1}; }},
        {"nee", [](auto& c) { c.nextEventOwners = std::vector<Index>{1, 3}; }},
        {"nee", [](auto& c) { c.nextEventOwners = std::vector<Index>{1}; }},
        {"technique", [](auto& c) { c.contributions = std::vector<Contribution>{{Color(), 1, 2, LightEnd::hit, {}}}; }},
        {"splat", [](auto& c) { c.splatOwners = std::vector<Index>{2}; }},
        {"type", [](auto& c) { c.columns[0].type = ValueType(99); }},
        {"hits", [](auto& c) { c.columns[0].count = 3; }},
        {"hits", [](auto& c) { c.columns[0].bytes = bytesOf(std::vector<float>{1, 2, 3}); }},
        {"shades", [](auto& c) { c.columns[1].spectrumOffsets = std::vector<std::uint32_t>{0, 4, 3}; }},
        {"shades", [](auto& c) { c.columns[1].spectrumOffsets = std::vector<std::uint32_t>{0, 2, 4}; }},
        {"shades", [](auto& c) { c.columns[1].spectrumOffsets = std::vector<std::uint32_t>{0, 3}; }},
        {"words", [](auto& c) { c.columns[2].bytes = bytesOf(std::vector<std::uint32_t>{2}); }},
        {"ordered", [](auto& c) { std::swap(c.columns[0], c.columns[1]); }},
    };
    for (const auto& [word, damage] : damages) {
        PathColumns columns = sampleColumns();
        damage(columns);
        const auto made = PathSet::make(std::move(columns));
        ASSERT_FALSE(made.ok()) << word;
        EXPECT_NE(made.error().message.find(word), std::string::npos) << made.error().message;
    }
}

TEST(PathSet, EveryEventLobeAndLightEndIsKnown) {
    for (std::uint8_t e = 0; e < kEventCount; ++e) EXPECT_STRNE(name(Event(e)), name(Event(kEventCount)));
    for (std::uint8_t l = 0; l < kLobeCount; ++l) EXPECT_STRNE(name(Lobe(l)), name(Lobe(kLobeCount)));
    PathColumns columns = sampleColumns();
    columns.events = std::vector<std::uint8_t>{0, kEventCount - 1, 0};
    columns.lobes = std::vector<std::uint8_t>{0, kLobeCount - 1, 0};
    columns.contributions = std::vector<Contribution>{{Color(), 1, 1, LightEnd(kLightEndCount - 1), {}}};
    EXPECT_TRUE(PathSet::make(std::move(columns)).ok());
}

TEST(PathSet, MergingKeepsEverythingInOrder) {
    const PathSet late = *PathSet::make(sampleColumns(3, "late")), early = *PathSet::make(sampleColumns(1, "early"));
    const std::vector<PathSet> both{late, early};
    const PathSet merged = PathSet::merged(both);
    ASSERT_TRUE(PathSet::make(merged.columns()).ok()) << PathSet::make(merged.columns()).error().message;
    ASSERT_EQ(merged.pathCount(), 4u);
    EXPECT_EQ(merged.pixel(0).x, 1u);
    EXPECT_EQ(merged.pixel(2).x, 3u);
    EXPECT_EQ(merged.scattering(1)->label, "early");
    EXPECT_EQ(merged.scattering(4)->label, "late");
    EXPECT_EQ(merged.nextEvents(4).size(), 2u);
    EXPECT_EQ(merged.text(merged.contribution(1).technique), "light sampling");
    const Column& shades = *merged.find(Scope::vertex, "shades").at(0);
    EXPECT_EQ(merged.last(shades, 3), Value(std::vector<float>{1, 2}));
    EXPECT_EQ(merged.last(shades, 5), Value(std::vector<float>{3}));
    EXPECT_EQ(merged.last(*merged.find(Scope::path, "hits").at(0), 3), Value(std::int64_t(8)));
    EXPECT_EQ(merged.last(*merged.find(Scope::vertex, "words").at(0), 5), Value(std::string("late")));
    EXPECT_EQ(merged.splats(1).size(), 1u);
}

TEST(PathSet, ASubsetHoldsItsPathsAndNothingElse) {
    const std::vector<PathSet> both{*PathSet::make(sampleColumns(1, "early")), *PathSet::make(sampleColumns(3, "late"))};
    const PathSet all = PathSet::merged(both);
    std::vector<Index> every(all.pathCount());
    for (Index p = 0; p < all.pathCount(); ++p) every[p] = p;
    for (Index left = 0; left < all.pathCount(); ++left) {
        std::vector<Index> others = every;
        others.erase(others.begin() + left);
        const PathSet some = all.subset(others);
        ASSERT_TRUE(PathSet::make(some.columns()).ok()) << PathSet::make(some.columns()).error().message;
        ASSERT_EQ(some.pathCount(), others.size());
        for (Index p = 0; p < some.pathCount(); ++p) {
            EXPECT_EQ(some.sample(p), all.sample(others[p]));
            EXPECT_EQ(some.estimate(p), all.estimate(others[p]));
            ASSERT_EQ(some.vertices(p).size(), all.vertices(others[p]).size());
            for (Index i = 0; i < some.vertices(p).size(); ++i) {
                const Index v = some.vertices(p).first + i, w = all.vertices(others[p]).first + i;
                EXPECT_EQ(some.position(v), all.position(w));
                EXPECT_EQ(some.contributions(v).size(), all.contributions(w).size());
                for (std::size_t c = 0; c < all.userColumns().size(); ++c) {
                    if (all.userColumns()[c].scope == Scope::path) continue;
                    EXPECT_EQ(some.last(some.userColumns()[c], v), all.last(all.userColumns()[c], w));
                }
            }
        }
    }
    EXPECT_TRUE(all.subset({}).empty());
}

TEST(PathSet, MergingThePathOfALaterSetReplacesTheEarlier) {
    PathColumns changed = sampleColumns();
    changed.estimates = std::vector<Color>{Color(9.f), Color()};
    const std::vector<PathSet> both{*PathSet::make(sampleColumns()), *PathSet::make(std::move(changed))};
    const PathSet merged = PathSet::merged(both);
    ASSERT_EQ(merged.pathCount(), 2u);
    EXPECT_EQ(merged.estimate(0), Color(9.f));
    EXPECT_EQ(merged.vertexCount(), 3u);
}

}  // namespace
}  // namespace emca
