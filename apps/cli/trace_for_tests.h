#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "emca/client/connection.h"

namespace emca::cli {

/// A trace of pixel (3, 4) with two paths. Path 0 (sample 5): origin, estimate, three vertices (a surface with
/// everything, a vertex with its depth alone, the environment) and user data, one key of which is repeated. Path 1
/// (sample 9, part 2) has indices alone.
inline client::Trace exampleTrace() {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    using Flags = std::vector<std::uint8_t>;
    PathColumns c;
    c.pixels = std::vector<Pixel>{{3, 4}, {3, 4}};
    c.samples = std::vector<std::int64_t>{5, 9};
    c.parts = std::vector<std::int32_t>{0, 2};
    c.pathFlags = Flags{PathFlag::hasOrigin | PathFlag::hasEstimate, 0};
    c.origins = std::vector<Vec3f>{{0, 1, 2}, {}};
    c.estimates = std::vector<Color>{{0.1f, nan, inf}, {}};
    c.firstVertex = std::vector<Index>{0, 3, 3};
    c.depths = std::vector<std::int32_t>{1, 2, 3};
    constexpr std::uint8_t kAll = VertexFlag::hasPosition | VertexFlag::hasEstimate | VertexFlag::hasEmission |
                                  VertexFlag::hasSurface | VertexFlag::hasEvent;
    c.vertexFlags = Flags{kAll, 0, VertexFlag::hasPosition | VertexFlag::environment | VertexFlag::hasEvent};
    c.positions = std::vector<Vec3f>{{1, 2, 3}, {}, {7, 8, 9}};
    c.vertexEstimates = std::vector<Color>{{0.5f, 0.5f, 0.5f}, {}, {}};
    c.emissions = std::vector<Color>{{0, 0, 0}, {}, {}};
    c.meshes = std::vector<std::int32_t>{2, 0, 0};
    c.faces = std::vector<std::int32_t>{11, 0, 0};
    c.events = Flags{std::uint8_t(Event::transmit), 0, std::uint8_t(Event::background)};
    c.lobes = Flags{std::uint8_t(Lobe::specular), 0, 0};
    c.labels = std::vector<std::uint32_t>{0, kNoString, kNoString};
    c.nextEventOwners = std::vector<Index>{0, 0};
    c.nextEvents = std::vector<NextEvent>{{{0, 5, 0}, 1}, {{0, 6, 0}, 0}};
    c.contributionOwners = std::vector<Index>{0};
    c.contributions = std::vector<Contribution>{{{0.1f, 0.2f, 0.3f}, 0.25f, 1, LightEnd::connected, {}}};
    c.strings = {"glass", "light sampling"};

    const auto floats = [](const std::string& name, Scope scope, std::vector<Index> owners,
                           const std::vector<float>& values) {
        Column column;
        column.name = name;
        column.scope = scope;
        column.type = ValueType::float1;
        column.count = static_cast<Index>(values.size());
        std::vector<std::byte> bytes(values.size() * sizeof(float));
        std::memcpy(bytes.data(), values.data(), bytes.size());
        column.owners = std::move(owners);
        column.bytes = std::move(bytes);
        return column;
    };
    c.columns.push_back(floats("weight", Scope::path, {0}, {0.75f}));
    c.columns.push_back(floats("pdf", Scope::vertex, {0, 0, 2}, {1e-5f, 2, nan}));

    client::Trace trace;
    trace.pixels = {{3, 4}};
    trace.replays = {{Verdict::close, SumCheck::matches, Color(0.5f), Color(0.50001f)}};
    trace.samplesPerPixel = 2;
    trace.seed = 7;
    trace.integrator = "path";
    trace.sampler = "sobol";
    Result<PathSet> paths = PathSet::make(std::move(c));
    EXPECT_TRUE(paths.ok()) << (paths.ok() ? "" : paths.error().message);
    if (paths.ok()) trace.paths = std::move(paths).value();
    return trace;
}

}  // namespace emca::cli
