#include "emca/recorder/path_layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <type_traits>

namespace emca {
namespace {

const std::vector<Mesh>& twoTriangles() {
    static const std::vector<Mesh> meshes{{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}},
                                          {.positions = {{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}, .triangles = {{0, 1, 2}}}};
    return meshes;
}

/// The mean of a mean layer on the only face of a mesh; every test adds points of one value there.
Color valueOn(const SurfaceField& field, std::size_t mesh, PathLayer layer) {
    const std::string& name = pathLayers()[static_cast<std::size_t>(layer)].name;
    for (std::size_t i = 0; i < field.layers.size(); ++i) {
        if (field.layers[i].description.name != name) continue;
        const auto channel = [&](std::uint32_t c) { return field.value(field.layers[i], mesh, 0, c); };
        return channelCount(field.layers[i].description.kind) == 1 ? Color(channel(0)) : Color(channel(0), channel(1), channel(2));
    }
    ADD_FAILURE() << "no layer " << name;
    return {};
}

template <typename Tally = PathTally>
SurfaceField collect(const std::vector<LayerDescription>& layers, const std::function<void(std::type_identity_t<Tally>&)>& walk) {
    SurfaceRecorder recorder(twoTriangles(), {.samplesPerDivision = 1u << 30});
    for (const LayerDescription& layer : layers) EXPECT_TRUE(recorder.addLayer(layer).ok());
    const PathLayers handles(recorder);
    Tally tally(handles);
    walk(tally);
    return recorder.finish();
}

const SurfaceLocation kFirst{.mesh = 0, .face = 0, .position = {0.2f, 0.2f, 0}}, kSecond{.mesh = 1, .face = 0, .barycentrics = {0.25f, 0.5f}};

TEST(PathLayers, RadianceIsGatheredFromThePathsEnd) {
    const SurfaceField field = collect(pathLayers(), [](PathTally& tally) {
        tally.intersection(kFirst);
        tally.throughput(Color(0.5f));
        tally.direct({1, 2, 3});
        tally.misWeight(0.25f);
        tally.scattered({0.5f, 0.5f, 1});
        tally.survived(0.5f);
        tally.intersection(kSecond);
        tally.throughput({0, 1, 1});
        tally.hit({4, 0, 0});
        tally.scattered(Color(2));
        tally.background();
        tally.throughput({0, 2, 2});
        tally.hit({1, 1, 1});
        tally.end(3);
    });
    EXPECT_EQ(valueOn(field, 1, PathLayer::reflected), Color(2));
    EXPECT_EQ(valueOn(field, 1, PathLayer::contribution), Color(0, 2, 2));
    EXPECT_EQ(valueOn(field, 0, PathLayer::reflected), Color(1 + 1 * 6, 2 + 1 * 2, 3 + 2 * 2));
    EXPECT_EQ(valueOn(field, 0, PathLayer::contribution), Color(3.5f, 2, 3.5f));
    EXPECT_EQ(valueOn(field, 0, PathLayer::throughput), Color(0.5f));
    EXPECT_EQ(valueOn(field, 0, PathLayer::misWeight), Color(0.25f));
    EXPECT_EQ(valueOn(field, 0, PathLayer::pathDepth), Color(3));
    EXPECT_EQ(valueOn(field, 1, PathLayer::pathDepth), Color(3));
}

/// Radiance at two wavelengths.
struct TwoWavelengths {
    explicit TwoWavelengths(float both) : TwoWavelengths(both, both) {}
    TwoWavelengths(float first, float second) : a(first), b(second) {}
    float a, b;
    TwoWavelengths operator+(TwoWavelengths o) const { return {a + o.a, b + o.b}; }
    TwoWavelengths operator*(TwoWavelengths o) const { return {a * o.a, b * o.b}; }
    TwoWavelengths& operator+=(TwoWavelengths o) { return *this = *this + o; }
    TwoWavelengths& operator/=(float d) { return *this = {a / d, b / d}; }
};

TEST(PathLayers, SpectraAreMultipliedBeforeTheyBecomeColours) {
    using Tally = BasicPathTally<TwoWavelengths>;
    const auto grey = [](TwoWavelengths s) { return Color((s.a + s.b) / 2); };
    const SurfaceField field = collect<Tally>(pathLayers(), [&](Tally& tally) {
        tally.intersection(kFirst);
        tally.throughput({2, 0}, grey);
        tally.direct({0, 6});
        tally.scattered({0, 1});
        tally.survived(0.25f);
        tally.intersection(kSecond);
        tally.throughput({0, 4}, grey);
        tally.hit({8, 1});
        tally.direct({1, 1});
        tally.end(2, grey);
    });
    EXPECT_EQ(valueOn(field, 0, PathLayer::throughput), Color(1));
    EXPECT_EQ(valueOn(field, 1, PathLayer::throughput), Color(2));
    EXPECT_EQ(valueOn(field, 1, PathLayer::reflected), Color(1));
    EXPECT_EQ(valueOn(field, 1, PathLayer::contribution), Color(2));
    EXPECT_EQ(valueOn(field, 0, PathLayer::reflected), Color((6 + 4 * 2) / 2));
    EXPECT_EQ(valueOn(field, 0, PathLayer::contribution), Color(0));  // of colours: 7
    EXPECT_EQ(valueOn(field, 0, PathLayer::pathDepth), Color(2));
}

TEST(PathLayers, DensitiesCountEventsPerArea) {
    const SurfaceField field = collect(pathLayers(), [](PathTally& tally) {
        for (int i = 0; i < 3; ++i) {
            tally.intersection(kFirst);
            tally.nextEvent(kSecond);
            tally.rouletteEnd();
            tally.end(1);
        }
        tally.intersection(kSecond);
        tally.invalidDirection();
        tally.end(1);
    });
    EXPECT_EQ(valueOn(field, 0, PathLayer::intersections), Color(6));  // area 1/2
    EXPECT_EQ(valueOn(field, 1, PathLayer::intersections), Color(0.5f));  // area 2
    EXPECT_EQ(valueOn(field, 1, PathLayer::nextEvents), Color(1.5f));
    EXPECT_EQ(valueOn(field, 0, PathLayer::roulette), Color(6));
    EXPECT_EQ(valueOn(field, 1, PathLayer::invalidDirections), Color(0.5f));
    EXPECT_EQ(field.counts.invalid, 0u);
}

TEST(PathLayers, APlaceIsLocatedOnlyWhereALayerHasSomethingToAdd) {
    const SurfaceField field = collect(pathLayers({PathLayer::roulette}), [](PathTally& tally) {
        EXPECT_FALSE(tally.wantsNextEvents());
        for (int i = 0; i < 10; ++i) {
            tally.intersection(kFirst);
            tally.throughput(Color(1));
            tally.nextEvent(kSecond);
            tally.end(1);
        }
        tally.intersection(kSecond);
        tally.rouletteEnd();
        tally.end(1);
    });
    EXPECT_EQ(field.counts.points, 1u);
}

TEST(PathLayers, AnObservedPathHasDepthButNoRadiance) {
    const SurfaceField field = collect(pathLayers({PathLayer::reflected, PathLayer::pathDepth}), [](PathTally& tally) {
        tally.intersection(kFirst);
        tally.background();
        tally.end(2);
    });
    EXPECT_EQ(valueOn(field, 0, PathLayer::pathDepth), Color(2));
    EXPECT_TRUE(std::isnan(valueOn(field, 0, PathLayer::reflected).r));
}

TEST(PathLayers, VerticesWithoutSurfaceAddNothing) {
    const SurfaceField field = collect(pathLayers(), [](PathTally& tally) {
        tally.background();
        tally.throughput(Color(1));
        tally.misWeight(1);
        tally.nextEvent({});
        tally.end(1);
    });
    EXPECT_EQ(field.counts.points, 0u);
    EXPECT_EQ(field.counts.invalid, 0u);
}

}  // namespace
}  // namespace emca
