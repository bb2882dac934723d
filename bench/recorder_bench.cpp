// Recording, against BASELINE: 1024 paths x 8 intersections x (1 string, 2 float, 3 colour, one 2D, one 3D value,
// next-event estimation, estimate). Times are per intersection.
#include <benchmark/benchmark.h>

#include <malloc.h>

#include "emca/recorder/recorder.h"

namespace {

using namespace emca;

constexpr int kPaths = 1024, kDepth = 8;

/// The calls of one pixel.
void recordPixel(PathRecorder& emca) {
    for (int sample = 0; sample < kPaths; ++sample) {
        emca.setPathIndex(sample);
        emca.setPathOrigin(Vec3f{0, 0, 0});
        for (int depth = 1; depth <= kDepth; ++depth) {
            const float f = float(depth);
            emca.setDepthIndex(depth);
            emca.setIntersectionPos(Vec3f{f, f, f});
            emca.addIntersectionData("material", "rough glass");
            emca.addIntersectionData("pdf", f);
            emca.addIntersectionData("survival probability", f);
            emca.addIntersectionData("throughput", Color(f));
            emca.addIntersectionData("BSDF weight", Color(f));
            emca.addIntersectionData("radiance", Color(f));
            emca.addIntersectionData("sample", Vec2f{f, f});
            emca.addIntersectionData("direction", Vec3f{f, f, f});
            emca.setNextEventEstimationPos(Vec3f{f, f, f}, true);
            emca.setIntersectionEstimate(Color(f));
        }
        emca.setFinalEstimate(Color(1.f));
    }
}

void recordingOn(benchmark::State& state, bool cold) {
    std::uint64_t bytes = 0;
    for (auto _ : state) {
        state.PauseTiming();
        if (cold) malloc_trim(0);
        auto recording = std::make_unique<Recording>();
        state.ResumeTiming();
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

/// From the threads' pages to the ordered PathSet.
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
