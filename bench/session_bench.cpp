// Row "session" of docs/performance.md: a session of a million vertices (125,000 paths with 8 vertices each; every vertex
// with a position, a shadow test, an estimate and seven user values) is saved and opened. Values are noise with the
// exponents of light, as a renderer's are: constant ones would flatter the compression.
#include <benchmark/benchmark.h>
#include <zstd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <vector>

#include "emca/client/session.h"
#include "emca/core/seed_map.h"
#include "emca/protocol/codec.h"
#include "emca/recorder/recorder.h"

namespace {

using namespace emca;

constexpr int kPaths = 125'000, kVertices = 8;

/// Fails loudly: a benchmark of an error would look fast.
template <typename T>
T must(Result<T> result) {
    if (!result) {
        std::cerr << result.error().message << '\n';
        std::abort();
    }
    return std::move(result).value();
}

/// In (0, 8), all 24 bits of the fraction in use.
float noise() {
    static std::uint64_t state = 1;
    const std::uint64_t bits = mix64(state++);
    const float unit = static_cast<float>(bits >> 40) * 0x1p-24f;
    return unit * static_cast<float>(1u << (bits & 3));
}
Color noisyColor() { return {noise(), noise(), noise()}; }

PathSet recordPaths() {
    RecordingOptions options;
    options.budgetBytes = std::size_t(4) << 30;
    Recording recording(options);
    {
        const RecordScope scope(recording, Pixel{1, 1});
        PathRecorder& emca = recorder();
        for (int path = 0; path < kPaths; ++path) {
            emca.setPathIndex(path);
            emca.setPathOrigin(Vec3f{0, 0, 0});
            for (int depth = 1; depth <= kVertices; ++depth) {
                emca.setDepthIndex(depth);
                emca.setIntersectionPos(Vec3f{noise(), noise(), noise()});
                emca.setNextEventEstimationPos(Vec3f{noise(), 4, noise()}, noise() < 1);
                emca.setIntersectionEstimate(noisyColor());
                emca.addIntersectionData("material", std::string_view(noise() < 1 ? "glass" : "wall"));
                emca.addIntersectionData("bsdf pdf", noise());
                emca.addIntersectionData("light pdf", noise());
                emca.addIntersectionData("throughput", noisyColor());
                emca.addIntersectionData("bsdf weight", noisyColor());
                emca.addIntersectionData("random numbers", Vec2f{noise(), noise()});
                emca.addIntersectionData("normal", Vec3f{noise(), noise(), noise()});
            }
            emca.setFinalEstimate(noisyColor());
        }
    }
    return must(recording.finish());
}

const client::Session& millionVertices() {
    static const client::Session session = [] {
        client::Trace trace;
        trace.pixels = {{1, 1}};
        trace.replays.resize(1);
        trace.paths = recordPaths();
        client::Session made;
        made.traces = {std::make_shared<const client::Trace>(std::move(trace))};
        made.shown = {0};
        return made;
    }();
    return session;
}

const std::filesystem::path& savedFile() {
    static const std::filesystem::path file = [] {
        const auto path = std::filesystem::temp_directory_path() / "emca_session_bench.emca";
        if (const auto saved = client::saveSession(path, millionVertices()); !saved) std::abort();
        std::atexit([] { std::filesystem::remove(std::filesystem::temp_directory_path() / "emca_session_bench.emca"); });
        return path;
    }();
    return file;
}

void saveMillionVertices(benchmark::State& state) {
    const auto& session = millionVertices();
    const auto file = savedFile();
    for (auto _ : state) {
        if (!client::saveSession(file, session)) state.SkipWithError("it was not saved");
    }
    state.counters["MB"] = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
}
BENCHMARK(saveMillionVertices)->Unit(benchmark::kMillisecond)->UseRealTime();

/// From a file that the system has in memory, as one that was saved a moment ago.
void openMillionVertices(benchmark::State& state) {
    const auto file = savedFile();
    for (auto _ : state) {
        const auto opened = must(client::openSession(file));
        if (!opened.whole || opened.session.traces[0]->paths.vertexCount() != kPaths * kVertices) state.SkipWithError("not all of it came");
    }
}
BENCHMARK(openMillionVertices)->Unit(benchmark::kMillisecond)->UseRealTime();

protocol::Frame frameOfPaths() {
    protocol::TraceResult result;
    result.pixels = {{1, 1}};
    result.replays.resize(1);
    result.paths = millionVertices().traces[0]->paths;
    return must(protocol::encode({0, std::move(result)}));
}

/// What each level costs and gains: the choice of session_writer.cpp.
void compress(benchmark::State& state) {
    const auto frame = frameOfPaths();
    std::vector<char> packed(ZSTD_compressBound(frame.size()));
    std::size_t size = 0;
    for (auto _ : state) size = ZSTD_compress(packed.data(), packed.size(), frame.data(), frame.size(), static_cast<int>(state.range(0)));
    state.counters["of"] = static_cast<double>(size) / static_cast<double>(frame.size());
    state.counters["MB"] = static_cast<double>(frame.size()) / 1e6;
}
BENCHMARK(compress)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);

void unpack(benchmark::State& state) {
    const auto frame = frameOfPaths();
    std::vector<char> packed(ZSTD_compressBound(frame.size())), content(frame.size());
    packed.resize(ZSTD_compress(packed.data(), packed.size(), frame.data(), frame.size(), static_cast<int>(state.range(0))));
    for (auto _ : state) benchmark::DoNotOptimize(ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size()));
}
BENCHMARK(unpack)->DenseRange(1, 3)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
