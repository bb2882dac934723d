#include "emca/client/dataset.h"

#include <gtest/gtest.h>

namespace emca::client {
namespace {

/// A trace of one path with no vertices at (x, 0).
std::shared_ptr<const Trace> traceOf(std::uint32_t x, std::int64_t sample = 0, float red = 0) {
    PathColumns columns;
    columns.pixels = std::vector<Pixel>{{x, 0}};
    columns.samples = std::vector<std::int64_t>{sample};
    columns.parts = std::vector<std::int32_t>{0};
    columns.pathFlags = std::vector<std::uint8_t>{PathFlag::hasEstimate};
    columns.estimates = std::vector<Color>{{red, 0, 0}};
    columns.firstVertex = std::vector<Index>{0, 0};
    auto paths = PathSet::make(std::move(columns));
    EXPECT_TRUE(paths.ok()) << paths.error().message;
    auto trace = std::make_shared<Trace>();
    trace->pixels = {{x, 0}};
    trace->paths = std::move(paths).value();
    return trace;
}

ImageEntry image(const char* title, std::uint64_t renderId = 0) {
    ImageEntry entry;
    entry.title = title;
    entry.renderId = renderId;
    return entry;
}

struct Heard {
    explicit Heard(Dataset& d) { d.listen([this](std::uint32_t parts) { rounds.push_back(parts); }); }
    std::vector<std::uint32_t> rounds;
};

TEST(Dataset, EmptyHasNothing) {
    const Dataset data;
    EXPECT_FALSE(data.info());
    EXPECT_FALSE(data.camera());
    EXPECT_EQ(data.meshes(), nullptr);
    EXPECT_EQ(data.currentImage(), nullptr);
    EXPECT_TRUE(data.paths().empty());
}

TEST(Dataset, MeshesReplaceTheFormerOnes) {  // the published client piled them up on every load
    Dataset data;
    data.setMeshes(std::make_shared<const std::vector<Mesh>>(3));
    data.setMeshes(std::make_shared<const std::vector<Mesh>>(2));
    EXPECT_EQ(data.meshes()->size(), 2u);
}

TEST(Dataset, AddedImageIsCurrentAndTitlesStay) {
    Dataset data;
    const Heard heard(data);
    EXPECT_EQ(data.addImage(image("a")), 0u);
    EXPECT_EQ(data.addImage(image("b")), 1u);
    EXPECT_EQ(data.currentImage()->title, "b");
    data.setCurrentImage(0);
    data.setCurrentImage(0);
    data.setCurrentImage(7);
    data.replaceImage(1, image("c"));
    data.replaceImage(7, image("d"));
    EXPECT_EQ(data.currentImage()->title, "a");
    EXPECT_EQ(data.images()[1].title, "c");
    const std::uint32_t both = std::uint32_t(DatasetPart::images) | DatasetPart::currentImage;
    const std::vector<std::uint32_t> expected{both, both, DatasetPart::currentImage, DatasetPart::images};
    EXPECT_EQ(heard.rounds, expected);
}

TEST(Dataset, TracesAreNewestFirstAndBounded) {
    Dataset data;
    for (std::uint32_t i = 0; i < Dataset::kHistory + 3; ++i) data.addTrace(traceOf(i));
    EXPECT_EQ(data.traces().size(), Dataset::kHistory);
    EXPECT_EQ(data.traces().front()->pixels[0].x, Dataset::kHistory + 2);
    EXPECT_EQ(data.traces().back()->pixels[0].x, 3u);
    ASSERT_EQ(data.current().size(), 1u);
    EXPECT_EQ(data.paths().pixel(0).x, Dataset::kHistory + 2);
}

TEST(Dataset, TheHistoryIsBoundedInBytesAndKeepsTheNewest) {
    Dataset data;
    const auto heavy = [](std::uint32_t x, std::uint64_t bytes) {
        auto trace = std::make_shared<Trace>(*traceOf(x));
        trace->stats.bytes = bytes;
        return trace;
    };
    for (std::uint32_t i = 0; i < 4; ++i) data.addTrace(heavy(i, Dataset::kHistoryBytes / 2));
    ASSERT_EQ(data.traces().size(), 2u);
    EXPECT_EQ(data.traces().back()->pixels[0].x, 2u);
    data.addTrace(heavy(9, 3 * Dataset::kHistoryBytes));
    EXPECT_EQ(data.traces().size(), 1u) << "what was asked for last is there however large it is";
    EXPECT_EQ(data.paths().pixel(0).x, 9u);
}

TEST(Dataset, AddTraceTellsOnce) {
    Dataset data;
    const Heard heard(data);
    data.addTrace(traceOf(1));
    data.addTrace(nullptr);
    const std::vector<std::uint32_t> expected{std::uint32_t(DatasetPart::traces) | DatasetPart::currentTrace};
    EXPECT_EQ(heard.rounds, expected);
}

TEST(Dataset, CurrentTracesAreShownTogether) {
    Dataset data;
    const auto left = traceOf(1), right = traceOf(2);
    data.setCurrent({right, nullptr, left, right});
    EXPECT_EQ(data.current().size(), 2u);
    ASSERT_EQ(data.paths().pathCount(), 2u);
    EXPECT_EQ(data.paths().pixel(0).x, 1u);
    EXPECT_EQ(data.paths().pixel(1).x, 2u);
    const Heard heard(data);
    data.setCurrent({right, left});
    EXPECT_TRUE(heard.rounds.empty());
    data.setCurrent({});
    EXPECT_TRUE(data.paths().empty());
    EXPECT_EQ(heard.rounds.size(), 1u);
}

TEST(Dataset, OfTheSamePathTheLaterTraceIsShown) {
    Dataset data;
    data.setCurrent({traceOf(1, 0, 5.f), traceOf(1, 0, 7.f)});
    ASSERT_EQ(data.paths().pathCount(), 1u);
    EXPECT_EQ(data.paths().estimate(0)->r, 7.f);
}

TEST(Dataset, TransactionTellsOnceAtItsEnd) {
    Dataset data;
    const Heard heard(data);
    {
        const Dataset::Transaction outer(data);
        data.setCamera(Camera{});
        {
            const Dataset::Transaction inner(data);
            data.setInfo(ServerInfo{});
        }
        data.setMeshes(nullptr);
        EXPECT_TRUE(heard.rounds.empty());
    }
    const std::vector<std::uint32_t> expected{std::uint32_t(DatasetPart::info) | DatasetPart::camera | DatasetPart::meshes};
    EXPECT_EQ(heard.rounds, expected);
    { const Dataset::Transaction nothing(data); }
    EXPECT_EQ(heard.rounds.size(), 1u);
}

TEST(Dataset, SurfaceLayersAreToldOfAndGoWithTheScene) {
    Dataset data;
    const Heard heard(data);
    const auto surface = std::make_shared<const SurfaceField>();
    data.setSurface(nullptr);
    EXPECT_TRUE(heard.rounds.empty()) << "there were none before";
    data.setSurface(surface);
    EXPECT_EQ(data.surface(), surface);
    data.addTrace(traceOf(1));
    EXPECT_EQ(data.surface(), surface) << "a trace after the render keeps them";
    data.setSurface(surface);
    data.clearScene();
    EXPECT_EQ(data.surface(), nullptr);
    ASSERT_EQ(heard.rounds.size(), 4u);
    EXPECT_EQ(heard.rounds[0], std::uint32_t(DatasetPart::surface));
    EXPECT_EQ(heard.rounds[1] & DatasetPart::surface, 0u);
    EXPECT_EQ(heard.rounds[2], std::uint32_t(DatasetPart::surface));
    EXPECT_NE(heard.rounds[3] & DatasetPart::surface, 0u);
}

TEST(Dataset, ClearSceneKeepsImagesWithoutTheirRenderIds) {
    Dataset data;
    data.setInfo(ServerInfo{});
    data.setCamera(Camera{});
    data.setMeshes(std::make_shared<const std::vector<Mesh>>(1));
    data.addImage(image("render", 17));
    data.addTrace(traceOf(1));
    const Heard heard(data);
    data.clearScene();
    EXPECT_TRUE(data.info());
    EXPECT_FALSE(data.camera());
    EXPECT_EQ(data.meshes(), nullptr);
    EXPECT_TRUE(data.traces().empty());
    EXPECT_TRUE(data.current().empty());
    EXPECT_TRUE(data.paths().empty());
    ASSERT_NE(data.currentImage(), nullptr);
    EXPECT_EQ(data.currentImage()->title, "render");
    EXPECT_EQ(data.currentImage()->renderId, 0u);
    EXPECT_EQ(heard.rounds.size(), 1u);
}

TEST(Dataset, ListenersMayComeGoAndChangeTheDataWhileTheyAreCalled) {
    Dataset data;
    int once = 0;
    Dataset::ListenerId id = 0;
    id = data.listen([&](std::uint32_t) {
        ++once;
        data.unlisten(id);
        const Dataset::Transaction two(data);
        data.setCamera(Camera{});
        data.setMeshes(nullptr);
    });
    const Heard heard(data);
    data.setInfo(ServerInfo{});
    const std::vector<std::uint32_t> expected{std::uint32_t(DatasetPart::info),
                                              std::uint32_t(DatasetPart::camera) | DatasetPart::meshes};
    EXPECT_EQ(heard.rounds, expected);
    EXPECT_EQ(once, 1);
}

}  // namespace
}  // namespace emca::client
