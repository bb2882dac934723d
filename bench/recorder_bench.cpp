// Recording, against BASELINE: 1024 paths x 8 intersections x (1 string, 2 float, 3 colour, one 2D, one 3D value,
// next-event estimation, estimate), besides the index, position and origin that make paths and intersections. Times are
// per intersection. Timed is what a renderer waits for: making the recording, its scope, all calls; not finish(), which
// is a row of its own, nor giving memory back.
#include <benchmark/benchmark.h>

#include <malloc.h>

#include <array>
#include <memory>
#include <random>
#include <string>

#include "emca/recorder/recorder.h"
#include "slab.h"

namespace {

using namespace emca;

constexpr int kPaths = 1024, kDepth = 8;

/// What a renderer has at one intersection. All of it comes from memory, so that nothing can be computed ahead.
struct Intersection {
    Vec3f position, direction, lightPosition;
    Color throughput, bsdfWeight, radiance, estimate;
    Vec2f sample;
    float pdf, survival;
    bool visible;
    const std::string* material;
};

/// Different at every use for a while; small enough to stay in the nearest cache, where a renderer has its values, too.
const std::array<Intersection, 61>& intersections() {
    static const std::array<std::string, 6> materials = {
        "wall", "floor tiles", "rough glass", "brushed aluminium", "lamp shade, inside", "wooden table top, varnished"};
    static const auto all = [] {
        std::array<Intersection, 61> made;
        std::mt19937 random(7);
        std::uniform_real_distribution<float> number(0.f, 10.f);
        const auto vector = [&] { return Vec3f{number(random), number(random), number(random)}; };
        const auto color = [&] { return Color(number(random), number(random), number(random)); };
        for (Intersection& i : made)
            i = {vector(), vector(), vector(), color(), color(), color(), color(), {number(random), number(random)},
                 number(random), number(random), random() % 2 == 0, &materials[random() % materials.size()]};
        return made;
    }();
    return all;
}

/// The calls of one pixel.
void recordPixel(PathRecorder& emca) {
    const auto& all = intersections();
    std::size_t next = 0;
    for (int sample = 0; sample < kPaths; ++sample) {
        emca.setPathIndex(sample);
        emca.setPathOrigin(Vec3f{0, 0, 0});
        for (int depth = 1; depth <= kDepth; ++depth) {
            const Intersection& its = all[next];
            next = next + 1 == all.size() ? 0 : next + 1;
            emca.setDepthIndex(depth);
            emca.setIntersectionPos(its.position);
            emca.addIntersectionData("material", *its.material);
            emca.addIntersectionData("pdf", its.pdf);
            emca.addIntersectionData("survival probability", its.survival);
            emca.addIntersectionData("throughput", its.throughput);
            emca.addIntersectionData("BSDF weight", its.bsdfWeight);
            emca.addIntersectionData("radiance", its.radiance);
            emca.addIntersectionData("sample", its.sample);
            emca.addIntersectionData("direction", its.direction);
            emca.setNextEventEstimationPos(its.lightPosition, its.visible);
            emca.setIntersectionEstimate(its.estimate);
        }
        emca.setFinalEstimate(all[next].estimate);
    }
}

/// Warm: recordings before this one left their memory for it. Cold: all memory comes from the system.
void recordingOn(benchmark::State& state, bool cold) {
    std::uint64_t bytes = 0;
    intersections();
    for (auto _ : state) {
        state.PauseTiming();
        if (cold) {
            detail::releaseKeptSlabs();
            malloc_trim(0);
        }
        state.ResumeTiming();
        auto recording = std::make_unique<Recording>();
        {
            const RecordScope scope(*recording, {0, 0});
            recordPixel(recorder());
        }
        state.PauseTiming();
        auto paths = recording->finish();
        benchmark::DoNotOptimize(paths);
        bytes = recording->stats().bytes;
        recording.reset();
        state.ResumeTiming();
    }
    state.counters["ns/intersection"] = benchmark::Counter(
        double(state.iterations()) * kPaths * kDepth * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["bytes/intersection"] = double(bytes) / (kPaths * kDepth);
}

void recordingOnWarm(benchmark::State& state) { recordingOn(state, false); }
void recordingOnCold(benchmark::State& state) { recordingOn(state, true); }
BENCHMARK(recordingOnWarm);
BENCHMARK(recordingOnCold);

/// From the threads' logs to the ordered PathSet; warm.
void finishing(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        auto recording = std::make_unique<Recording>();
        {
            const RecordScope scope(*recording, {0, 0});
            recordPixel(recorder());
        }
        state.ResumeTiming();
        auto paths = recording->finish();
        benchmark::DoNotOptimize(paths);
        state.PauseTiming();
        recording.reset();
        state.ResumeTiming();
    }
    state.counters["ns/intersection"] = benchmark::Counter(
        double(state.iterations()) * kPaths * kDepth * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(finishing);

constexpr int kOff = 100000;

/// What the off benchmark costs without any recording call.
void emptyLoop(benchmark::State& state) {
    for (auto _ : state)
        for (int i = 0; i < kOff; ++i) {
            float f = float(i);
            benchmark::DoNotOptimize(f);
        }
    state.counters["ns/intersection"] = benchmark::Counter(
        double(state.iterations()) * kOff * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(emptyLoop);

/// Off, as BASELINE has it: setDepthIndex, setIntersectionPos and four values per intersection.
void recordingOff(benchmark::State& state) {
    PathRecorder& emca = recorder();
    for (auto _ : state)
        for (int i = 0; i < kOff; ++i) {
            float f = float(i);
            benchmark::DoNotOptimize(f);
            emca.setDepthIndex(i);
            emca.setIntersectionPos(Vec3f{f, f, f});
            emca.addIntersectionData("pdf", f);
            emca.addIntersectionData("a key that is longer than any small string is", f);
            emca.addIntersectionData("throughput", Color(f));
            emca.addIntersectionData("material", "another text that is longer than small strings");
            benchmark::ClobberMemory();
        }
    state.counters["ns/intersection"] = benchmark::Counter(
        double(state.iterations()) * kOff * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(recordingOff);

}  // namespace

BENCHMARK_MAIN();
