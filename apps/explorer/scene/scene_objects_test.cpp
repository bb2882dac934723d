#include "scene_objects.h"

#include <gtest/gtest.h>

#include <cmath>

namespace emca::explorer {
namespace {

SceneObject points(std::size_t n) {
    SceneObject object;
    object.name = "samples";
    PointSet set;
    for (std::size_t i = 0; i < n; ++i) set.points.push_back({float(i), 0, 1});
    object.shape = std::move(set);
    return object;
}

TEST(SceneObjectRules, EachIsCheckedAndNamed) {
    EXPECT_TRUE(check(points(3)));
    EXPECT_TRUE(check(points(0)));
    const auto refused = [](auto edit, const char* word) {
        SceneObject object = points(3);
        edit(object);
        const Result<void> result = check(object);
        ASSERT_FALSE(result) << word;
        EXPECT_EQ(result.error().code, ErrorCode::invalidArgument);
        EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
    };
    refused([](SceneObject& o) { o.name.clear(); }, "name");
    refused([](SceneObject& o) { o.colors.values = {1, 2}; }, "3 elements and 2 values");
    refused([](SceneObject& o) { o.colors.colors.resize(4); }, "3 elements and 4 colours");
    refused([](SceneObject& o) { o.labels = {"a"}; }, "1 labels");
    refused([](SceneObject& o) { o.shape = TriangleSet{{{0, 0, 0}}, {{0, 0, 1}}}; }, "index 1");
    refused([](SceneObject& o) { o.shape = VoxelGrid{{}, {1, 1, 1}, {2, 2, 2}}; }, "8 elements and 0 values");
    refused([](SceneObject& o) { o.shape = VoxelGrid{{}, {1, 0, 1}, {0, 0, 0}}; }, "positive");
    refused([](SceneObject& o) { o.shape = VoxelGrid{{NAN, 0, 0}, {1, 1, 1}, {0, 0, 0}}; }, "finite");
    // 2^96 cells: the product must not wrap around to something small.
    refused([](SceneObject& o) { o.shape = VoxelGrid{{}, {1, 1, 1}, {0xffffffffu, 0xffffffffu, 0xffffffffu}}; }, "more than");
}

TEST(SceneObjectRules, BoundsIgnoreWhatIsNotFinite) {
    SceneObject object;
    object.name = "boxes";
    object.shape = BoxSet{{ObjectBox::between({-1, -2, -3}, {1, 2, 5}), ObjectBox::between({NAN, 0, 0}, {1, 1, 1})}};
    const BoundingBox box = boundsOf(object);
    EXPECT_EQ(box.min, (Vec3f{-1, -2, -3}));
    EXPECT_EQ(box.max, (Vec3f{1, 2, 5}));
    // A box turned by 45 degrees about z reaches as far as its diagonal.
    const float h = std::sqrt(0.5f);
    object.shape = BoxSet{{ObjectBox{{}, {h, h, 0}, {-h, h, 0}, {0, 0, 1}}}};
    EXPECT_NEAR(boundsOf(object).max.x, std::sqrt(2.f), 1e-6f);
    object.shape = VoxelGrid{{1, 1, 1}, {0.5f, 1, 2}, {4, 3, 2}};
    EXPECT_EQ(boundsOf(object).max, (Vec3f{3, 4, 5}));
    EXPECT_TRUE(boundsOf(points(0)).empty);
}

TEST(SceneObjectRules, ColoursAreOwnThenByValueThenOne) {
    SceneObject object = points(3);
    object.colors.color = {1, 2, 3, 4};
    EXPECT_EQ(colorsOf(object)[2], (analysis::Color8{1, 2, 3, 4}));
    object.colors.values = {0, NAN, 10};
    const auto& map = analysis::ColorMap::get(analysis::ColorMapId::viridis);
    EXPECT_EQ(colorsOf(object), (std::vector{map.map(0.), analysis::kNaNColor, map.map(1.)}));
    EXPECT_EQ(rangeOf(object.colors), (analysis::ValueRange{0, 10, false}));
    object.colors.colors = {{9, 9, 9}, {8, 8, 8}, {7, 7, 7}};
    EXPECT_EQ(colorsOf(object)[1], (analysis::Color8{8, 8, 8}));
}

TEST(SceneObjectRules, LabelsHaveNameValueAndUnit) {
    SceneObject object = points(2);
    EXPECT_EQ(labelOf(object, 1), "samples 1");
    object.colors.values = {0.5f, 2};
    object.colors.unit = "m";
    EXPECT_EQ(labelOf(object, 1), "samples 1: 2.000 m");
    object.labels = {"first", "second"};
    EXPECT_EQ(labelOf(object, 0), "first: 0.5000 m");
}

TEST(SceneObjects, SetReplaceRemoveAreTold) {
    SceneObjects objects;
    std::vector<std::uint32_t> told;
    const auto listener = objects.listen([&](std::uint32_t changes) { told.push_back(changes); });
    ASSERT_TRUE(objects.set({"b", "one"}, points(1)));
    ASSERT_TRUE(objects.set({"a", "two"}, points(2)));
    ASSERT_EQ(objects.entries().size(), 2u);
    EXPECT_EQ(objects.entries()[0].id.owner, "a");
    ASSERT_TRUE(objects.set({"b", "one"}, points(7)));
    EXPECT_EQ(objects.find({"b", "one"})->object->elementCount(), 7u);
    EXPECT_EQ(told, (std::vector<std::uint32_t>{1, 1, 1}));
    SceneObject broken = points(1);
    broken.labels = {"a", "b"};
    EXPECT_FALSE(objects.set({"b", "one"}, broken));
    EXPECT_EQ(objects.find({"b", "one"})->object->elementCount(), 7u);
    {
        SceneObjects::Transaction transaction(objects);
        objects.removeAll("a");
        objects.setVisible({"b", "one"}, false);
        EXPECT_EQ(told.size(), 3u);
    }
    EXPECT_EQ(told, (std::vector<std::uint32_t>{1, 1, 1, 3}));
    objects.remove({"c", "nothing"});
    objects.setVisible({"b", "one"}, false);
    EXPECT_EQ(told.size(), 4u) << "nothing changed";
    objects.unlisten(listener);
    objects.removeAll("b");
    EXPECT_EQ(told.size(), 4u);
}

TEST(SceneObjects, SwitchesOutliveTheirObjects) {
    SceneObjects objects;
    ASSERT_TRUE(objects.set({"p", "x"}, points(1), false));
    EXPECT_FALSE(objects.find({"p", "x"})->visible);
    objects.setVisible({"p", "x"}, true);
    objects.removeAll("p");
    ASSERT_TRUE(objects.set({"p", "x"}, points(2), false));
    EXPECT_TRUE(objects.find({"p", "x"})->visible);
}

TEST(SceneObjects, ListenersMayGoAndAddWhileTheyAreCalled) {
    SceneObjects objects;
    int second = 0, picks = 0;
    SceneObjects::ListenerId other = 0;
    objects.listen([&](std::uint32_t) { objects.unlisten(other); });
    other = objects.listen([&](std::uint32_t) { ++second; });
    ASSERT_TRUE(objects.set({"p", "x"}, points(1)));
    EXPECT_EQ(second, 0);
    objects.listenPicks([&](const ObjectId& id, std::size_t element) {
        ++picks;
        EXPECT_EQ(id.id, "x");
        EXPECT_EQ(element, 0u);
        objects.remove(id);
    });
    objects.pick({"p", "x"}, 0);
    objects.pick({"p", "x"}, 0);   // it is gone
    EXPECT_EQ(picks, 1);
}

}  // namespace
}  // namespace emca::explorer
