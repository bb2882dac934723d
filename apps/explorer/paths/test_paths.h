#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/core/path_set.h"

// Paths for the tests of views: plausible, with a fixed seed, made without a renderer.
namespace emca::explorer::test {

struct FakeOptions {
    Pixel pixel{174, 169};
    std::uint32_t samples = 1024;
    std::uint32_t vertices = 8;  ///< of each path; 0: between 2 and 8, as a path tracer with roulette makes them
    std::int64_t firstSample = 0;
    std::int64_t firefly = -1;  ///< sample index of a path 300 times as bright; -1: none
    bool estimates = true;
    std::uint32_t seed = 1;
};

namespace detail {

template <typename T>
SharedArray<std::byte> bytesOf(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return SharedArray<std::byte>(std::move(bytes));
}

template <typename T>
Column column(std::string name, Scope scope, ValueType type, const std::vector<T>& values,
              std::vector<Index> owners = {}) {
    Column c;
    c.name = std::move(name);
    c.scope = scope;
    c.type = type;
    c.count = static_cast<Index>(values.size());
    if (!owners.empty()) c.owners = SharedArray<Index>(std::move(owners));
    c.bytes = bytesOf(values);
    return c;
}

}  // namespace detail

/// Paths off diffuse walls, some of them through glass; every quantity that the reference renderer records.
inline PathSet fakePaths(const FakeOptions& options = {}) {
    std::mt19937 random(options.seed);
    std::uniform_real_distribution<float> uniform(0.f, 1.f);
    enum : std::uint32_t { kWall, kGlass, kLight, kLightSampling, kBsdfSampling, kLit, kStringCount };
    PathColumns c;
    c.strings = {"white wall", "tinted glass", "lamp", "light sampling", "BSDF sampling", "left the scene"};
    std::vector<Pixel> pixels;
    std::vector<std::int64_t> samples;
    std::vector<std::int32_t> parts, depths, meshes, faces;
    std::vector<std::uint8_t> pathFlags, vertexFlags, events, lobes, roulette;
    std::vector<Vec3f> origins, positions;
    std::vector<Color> estimates, vertexEstimates, emissions, throughputs;
    std::vector<Index> firstVertex{0}, nextEventOwners, contributionOwners;
    std::vector<NextEvent> nextEvents;
    std::vector<Contribution> contributions;
    std::vector<std::uint32_t> labels, reasons;
    std::vector<float> pdfs, survival;
    std::vector<Vec2f> randoms;
    for (std::uint32_t i = 0; i < options.samples; ++i) {
        const bool bright = options.firstSample + i == options.firefly;
        const std::uint32_t count =
            options.vertices ? options.vertices
            : bright         ? 6
                             : 2 + std::min<std::uint32_t>(6, std::uint32_t(-2.f * std::log(1.f - uniform(random))));
        pixels.push_back(options.pixel);
        samples.push_back(options.firstSample + i);
        parts.push_back(0);
        origins.push_back({0, 1, 6});
        Color throughput(1), sum(0);
        for (std::uint32_t v = 1; v <= count; ++v) {
            const bool last = v == count;
            const bool glass = bright ? (v == 2 || v == 3) : !last && uniform(random) < 0.12f;
            const auto vertex = static_cast<Index>(depths.size());
            depths.push_back(static_cast<std::int32_t>(v));
            positions.push_back({uniform(random) * 4 - 2, uniform(random) * 2, uniform(random) * 4 - 2});
            events.push_back(std::uint8_t(last ? Event::emission : glass ? Event::transmit : Event::reflect));
            lobes.push_back(std::uint8_t(last ? Lobe::none : glass ? Lobe::specular : Lobe::diffuse));
            labels.push_back(last ? kLight : glass ? kGlass : kWall);
            meshes.push_back(last ? 7 : glass ? 4 : 1);
            faces.push_back(static_cast<std::int32_t>(uniform(random) * 1000));
            const float pdf = bright && v == 3 ? 4.2e-6f : 0.05f + uniform(random);
            pdfs.push_back(pdf);
            survival.push_back(v < 4 ? 1.f : 0.95f);
            randoms.push_back({uniform(random), uniform(random)});
            throughputs.push_back(throughput);
            Color light(0);
            if (!glass && !last) {
                const bool visible = uniform(random) < 0.7f;
                nextEventOwners.push_back(vertex);
                nextEvents.push_back({{uniform(random) - 0.5f, 1.98f, uniform(random) - 0.5f}, visible});
                if (visible) {
                    light = throughput * Color(0.28f, 0.25f, 0.2f) * (0.3f + uniform(random));
                    contributionOwners.push_back(vertex);
                    contributions.push_back(
                        {light, 0.5f + 0.5f * uniform(random), kLightSampling, LightEnd::connected, {}});
                }
            }
            if (last && (bright || uniform(random) < 0.1f)) {
                light = bright ? Color(133.2f, 126.1f, 110.f) : throughput * Color(0.4f, 0.36f, 0.3f) * uniform(random);
                contributionOwners.push_back(vertex);
                contributions.push_back({light, bright ? 0.98f : 0.2f, kBsdfSampling, LightEnd::hit, {}});
            }
            sum += light;
            throughput *= glass ? Color(0.95f, 0.98f, 0.9f) : Color(0.7f, 0.68f, 0.62f);
            vertexEstimates.push_back(sum);
            emissions.push_back(last ? Color(18.4f, 15.6f, 8.f) : Color(0));
            using F = VertexFlag;
            vertexFlags.push_back(std::uint8_t(F::hasPosition | F::hasEstimate | F::hasSurface | F::hasEvent |
                                               (last ? F::hasEmission : 0)));
        }
        estimates.push_back(sum);
        pathFlags.push_back(std::uint8_t(PathFlag::hasOrigin | (options.estimates ? PathFlag::hasEstimate : 0)));
        roulette.push_back(count < 8);
        reasons.push_back(kLit);
        firstVertex.push_back(static_cast<Index>(depths.size()));
    }
    c.pixels = std::move(pixels);
    c.samples = std::move(samples);
    c.parts = std::move(parts);
    c.pathFlags = std::move(pathFlags);
    c.origins = std::move(origins);
    c.estimates = std::move(estimates);
    c.firstVertex = std::move(firstVertex);
    c.depths = std::move(depths);
    c.vertexFlags = std::move(vertexFlags);
    c.positions = std::move(positions);
    c.vertexEstimates = std::move(vertexEstimates);
    c.emissions = std::move(emissions);
    c.meshes = std::move(meshes);
    c.faces = std::move(faces);
    c.events = std::move(events);
    c.lobes = std::move(lobes);
    c.labels = std::move(labels);
    c.nextEventOwners = std::move(nextEventOwners);
    c.nextEvents = std::move(nextEvents);
    c.contributionOwners = std::move(contributionOwners);
    c.contributions = std::move(contributions);
    using detail::column;
    c.columns.push_back(column("ended by roulette", Scope::path, ValueType::boolean, roulette));
    c.columns.push_back(column("why it ended", Scope::path, ValueType::text, reasons));
    c.columns.push_back(column("bsdf pdf", Scope::vertex, ValueType::float1, pdfs));
    c.columns.push_back(column("random numbers", Scope::vertex, ValueType::float2, randoms));
    c.columns.push_back(column("survival probability", Scope::vertex, ValueType::float1, survival));
    c.columns.push_back(column("throughput", Scope::vertex, ValueType::color, throughputs));
    Result<PathSet> set = PathSet::make(std::move(c));
    if (!set) throw std::runtime_error(set.error().message);
    return std::move(set).value();
}

/// One-vertex paths with the given final estimates and depths (cycled if fewer); nothing else.
inline PathSet pathsWithEstimates(const std::vector<Color>& estimates, const std::vector<std::int32_t>& depths = {1},
                                  Pixel pixel = {3, 4}) {
    PathColumns c;
    std::vector<Pixel> pixels(estimates.size(), pixel);
    std::vector<std::int64_t> samples;
    std::vector<std::int32_t> vertexDepths;
    std::vector<Index> firstVertex{0};
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        samples.push_back(static_cast<std::int64_t>(i));
        vertexDepths.push_back(depths[i % depths.size()]);
        firstVertex.push_back(static_cast<Index>(i + 1));
    }
    c.pixels = std::move(pixels);
    c.samples = std::move(samples);
    c.parts = std::vector<std::int32_t>(estimates.size(), 0);
    c.pathFlags = std::vector<std::uint8_t>(estimates.size(), PathFlag::hasEstimate);
    c.estimates = std::vector<Color>(estimates);
    c.firstVertex = std::move(firstVertex);
    c.depths = std::move(vertexDepths);
    c.vertexFlags = std::vector<std::uint8_t>(estimates.size(), VertexFlag::hasPosition);
    c.positions = std::vector<Vec3f>(estimates.size());
    Result<PathSet> set = PathSet::make(std::move(c));
    if (!set) throw std::runtime_error(set.error().message);
    return std::move(set).value();
}

inline std::shared_ptr<const client::Trace> traceOf(PathSet paths, Pixel pixel = {174, 169}) {
    auto trace = std::make_shared<client::Trace>();
    trace->pixels = {pixel};
    trace->samplesPerPixel = paths.pathCount();
    trace->paths = std::move(paths);
    return trace;
}

}  // namespace emca::explorer::test
