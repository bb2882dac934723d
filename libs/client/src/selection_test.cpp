#include "emca/client/selection.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace emca::client {
namespace {

constexpr Pixel kPixel{3, 4};

PathId path(std::int64_t sample, Pixel pixel = kPixel) { return {pixel, sample, 0}; }

struct Heard {
    explicit Heard(Selection& s) { s.listen([this](std::uint32_t parts) { rounds.push_back(parts); }); }
    std::vector<std::uint32_t> rounds;
};

TEST(Selection, PathsAreSortedAndUnique) {
    Selection selection;
    selection.setPaths({path(5), path(1), path(5), path(1, {9, 0})});
    const std::vector<PathId> expected{path(1, {9, 0}), path(1), path(5)};  // row 0 comes before row 4
    EXPECT_EQ(selection.state().paths, expected);
    EXPECT_TRUE(selection.isSelected(path(5)));
    EXPECT_FALSE(selection.isSelected(path(2)));
}

TEST(Selection, CurrentPathIsKeptIfAmongThePathsElseTheOnlyOneElseNone) {
    Selection selection;
    selection.setPaths({path(1), path(2)});
    EXPECT_FALSE(selection.state().currentPath);
    selection.setPaths({path(2)});
    EXPECT_EQ(selection.state().currentPath, path(2));
    selection.setPaths({path(1), path(2), path(3)});
    EXPECT_EQ(selection.state().currentPath, path(2));
    selection.setPaths({path(1), path(3)});
    EXPECT_FALSE(selection.state().currentPath);
}

TEST(Selection, VertexLivesOnTheCurrentPathOnly) {
    Selection selection;
    selection.setPaths({path(1), path(2)});
    selection.setVertex({path(2), 3, Subpath::light});
    EXPECT_EQ(selection.state().currentPath, path(2));
    ASSERT_TRUE(selection.state().vertex);
    EXPECT_EQ(selection.state().vertex->depth, 3);
    selection.setCurrentPath(path(1));
    EXPECT_FALSE(selection.state().vertex);
    selection.setVertex({path(7), 1});
    EXPECT_TRUE(selection.isSelected(path(7)));
    selection.togglePath(path(7));
    EXPECT_FALSE(selection.isSelected(path(7)));
    EXPECT_FALSE(selection.state().vertex);
    EXPECT_FALSE(selection.state().currentPath);
}

TEST(Selection, SetMakesTheStateObeyTheRules) {
    Selection selection;
    selection.set({kPixel, {path(4), path(2), path(4)}, path(9), VertexId{path(9), 1}});
    EXPECT_EQ(selection.state(), (Selection::State{kPixel, {path(2), path(4)}, std::nullopt, std::nullopt}));
    selection.set({kPixel, {path(2), path(4)}, path(4), VertexId{path(2), 1}});
    EXPECT_EQ(selection.state(), (Selection::State{kPixel, {path(2), path(4)}, path(4), std::nullopt}));
    const Selection::State valid{kPixel, {path(2), path(4)}, path(4), VertexId{path(4), 1}};
    selection.set(valid);
    EXPECT_EQ(selection.state(), valid);
}

TEST(Selection, EachChangeIsToldOnceWithItsPartsAndNoChangeIsNotTold) {
    Selection selection;
    const Heard heard(selection);
    selection.setPixel(kPixel);
    selection.setPixel(kPixel);
    selection.setVertex({path(1), 2});
    selection.setVertex({path(1), 2});
    selection.setCurrentPath(path(1));
    selection.setHovered(VertexId{path(1), 2});
    selection.setHovered(VertexId{path(1), 2});
    selection.clearVertex();
    selection.clearPaths();
    selection.clearPaths();
    using Part = decltype(SelectionPart::pixel);
    const std::vector<std::uint32_t> expected{Part(SelectionPart::pixel),
                                              std::uint32_t(SelectionPart::paths) | SelectionPart::currentPath |
                                                  SelectionPart::vertex,
                                              Part(SelectionPart::hover), Part(SelectionPart::vertex),
                                              std::uint32_t(SelectionPart::paths) | SelectionPart::currentPath};
    EXPECT_EQ(heard.rounds, expected);
}

TEST(Selection, ListenersMayComeAndGoWhileTheyAreCalled) {
    Selection selection;
    int first = 0, removed = 0, added = 0;
    Selection::ListenerId firstId = 0, removedId = 0;
    firstId = selection.listen([&](std::uint32_t) {
        ++first;
        selection.unlisten(firstId);
        selection.unlisten(removedId);
        selection.listen([&](std::uint32_t) { ++added; });
    });
    removedId = selection.listen([&](std::uint32_t) { ++removed; });
    selection.setPixel(kPixel);
    EXPECT_EQ(first, 1);
    EXPECT_EQ(removed, 0) << "was removed before its turn";
    EXPECT_EQ(added, 0) << "hears of the next change only";
    selection.setPixel(Pixel{0, 0});
    EXPECT_EQ(first, 1);
    EXPECT_EQ(added, 1);
}

TEST(Selection, AChangeFromAListenerReachesEveryoneInTheSameOrder) {
    Selection selection;
    selection.listen([&](std::uint32_t parts) {
        if (parts & SelectionPart::pixel) selection.setPaths({path(1)});
    });
    const Heard last(selection);
    selection.setPixel(kPixel);
    ASSERT_EQ(last.rounds.size(), 2u);
    EXPECT_EQ(last.rounds[0], std::uint32_t(SelectionPart::pixel));
    EXPECT_EQ(last.rounds[1], std::uint32_t(SelectionPart::paths) | SelectionPart::currentPath);
}

TEST(Selection, APixelOrARegionIsLookedAt) {
    Selection selection;
    selection.setPixel(kPixel);
    selection.setPaths({path(1)});
    Heard heard(selection);
    selection.togglePixel({5, 4});
    EXPECT_FALSE(selection.state().pixel);
    EXPECT_EQ(selection.state().region, PixelRegion(std::vector<Pixel>{kPixel, {5, 4}}));
    EXPECT_EQ(selection.state().paths.size(), 1u) << "the paths are of a pixel that is still looked at";
    EXPECT_EQ(heard.rounds, (std::vector<std::uint32_t>{SelectionPart::pixel | SelectionPart::region}));
    selection.togglePixel(kPixel);
    EXPECT_EQ(selection.state().pixel, (Pixel{5, 4}));
    EXPECT_TRUE(selection.state().region.empty());
    selection.togglePixel({5, 4});
    EXPECT_EQ(selection.pixels(), PixelRegion());
    selection.setRegion(PixelRegion(PixelRect{1, 1, 9, 9}));
    EXPECT_EQ(selection.pixels().size(), 64u);
    heard.rounds.clear();
    selection.setRegion(PixelRegion(PixelRect{1, 1, 9, 9}));
    EXPECT_TRUE(heard.rounds.empty()) << "the same region is no news";
    selection.setPixel(kPixel);
    EXPECT_TRUE(selection.state().region.empty());
    Selection::State both;
    both.pixel = kPixel;
    both.region = PixelRegion(PixelRect{0, 0, 2, 1});
    selection.set(both);
    EXPECT_FALSE(selection.state().pixel);
}

}  // namespace
}  // namespace emca::client
