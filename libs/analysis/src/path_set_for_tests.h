#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emca/core/path_set.h"

namespace emca::analysis::testing_support {

struct TestVertex {
    std::int32_t depth = 1;
    std::optional<Vec3f> position;
    std::uint8_t flags = 0;  ///< besides hasPosition, hasEmission, hasEvent
    std::optional<Color> emission;
    Event event = Event::none;
    std::vector<NextEvent> nextEvents;
};

struct TestPath {
    std::int64_t sample = 0;
    std::optional<Vec3f> origin;
    std::optional<Color> estimate;
    std::vector<TestVertex> vertices;
};

/// The set of some paths of one pixel, whose samples must ascend.
inline PathSet makePathSet(const std::vector<TestPath>& paths, Pixel pixel = {3, 4}) {
    std::vector<Pixel> pixels(paths.size(), pixel);
    std::vector<std::int64_t> samples;
    std::vector<std::uint8_t> pathFlags, vertexFlags, events, lobes;
    std::vector<Vec3f> origins, positions;
    std::vector<Color> estimates, emissions;
    std::vector<Index> firstVertex{0}, nextEventOwners;
    std::vector<std::int32_t> depths;
    std::vector<std::uint32_t> labels;
    std::vector<NextEvent> nextEvents;
    for (const TestPath& path : paths) {
        samples.push_back(path.sample);
        pathFlags.push_back(static_cast<std::uint8_t>((path.origin ? PathFlag::hasOrigin : 0) |
                                                      (path.estimate ? PathFlag::hasEstimate : 0)));
        origins.push_back(path.origin.value_or(Vec3f{}));
        estimates.push_back(path.estimate.value_or(Color{}));
        for (const TestVertex& v : path.vertices) {
            const auto owner = static_cast<Index>(depths.size());
            depths.push_back(v.depth);
            vertexFlags.push_back(static_cast<std::uint8_t>(v.flags | (v.position ? VertexFlag::hasPosition : 0) |
                                                            (v.emission ? VertexFlag::hasEmission : 0) |
                                                            (v.event != Event::none ? VertexFlag::hasEvent : 0)));
            positions.push_back(v.position.value_or(Vec3f{}));
            emissions.push_back(v.emission.value_or(Color{}));
            events.push_back(static_cast<std::uint8_t>(v.event));
            lobes.push_back(0);
            labels.push_back(kNoString);
            for (const NextEvent& e : v.nextEvents) {
                nextEventOwners.push_back(owner);
                nextEvents.push_back(e);
            }
        }
        firstVertex.push_back(static_cast<Index>(depths.size()));
    }
    PathColumns c;
    c.pixels = std::move(pixels);
    c.samples = std::move(samples);
    c.parts = std::vector<std::int32_t>(paths.size(), 0);
    c.pathFlags = std::move(pathFlags);
    c.origins = std::move(origins);
    c.estimates = std::move(estimates);
    c.firstVertex = std::move(firstVertex);
    c.depths = std::move(depths);
    c.vertexFlags = std::move(vertexFlags);
    c.positions = std::move(positions);
    c.emissions = std::move(emissions);
    c.events = std::move(events);
    c.lobes = std::move(lobes);
    c.labels = std::move(labels);
    c.nextEventOwners = std::move(nextEventOwners);
    c.nextEvents = std::move(nextEvents);
    Result<PathSet> set = PathSet::make(std::move(c));
    EXPECT_TRUE(set.ok()) << (set.ok() ? "" : set.error().message);
    return set.ok() ? std::move(set).value() : PathSet();
}

}  // namespace emca::analysis::testing_support
