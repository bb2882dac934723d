// Recording through C beside recording through C++: the same calls as recorder_bench, 12 per intersection, with the
// same values, in one program. Times are per intersection.
#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <random>

#include "c_recorder_calls.h"
#include "emca/recorder/recorder.h"

namespace {

using namespace emca;

using Intersections = std::array<bench_intersection, BENCH_INTERSECTIONS>;

const Intersections& intersections() {
    static const std::array<const char*, 6> kMaterials = {
        "wall", "floor tiles", "rough glass", "brushed aluminium", "lamp shade, inside", "wooden table top, varnished"};
    static const Intersections all = [] {
        Intersections made;
        std::mt19937 random(7);
        std::uniform_real_distribution<float> number(0.f, 10.f);
        const auto vector = [&] { return emca_vec3f{number(random), number(random), number(random)}; };
        const auto color = [&] { return emca_color{number(random), number(random), number(random)}; };
        for (bench_intersection& i : made)
            i = {vector(),       vector(),       vector(),          color(),
                 color(),        color(),        color(),           {number(random), number(random)},
                 number(random), number(random), random() % 2 == 0, kMaterials[random() % kMaterials.size()]};
        return made;
    }();
    return all;
}

/// bench_record_in_c with the calls of C++; a renderer's own types (here those of C) are taken as they are.
[[gnu::noinline]] void recordInCpp(const bench_intersection* all) {
    int next = 0;
    for (int path = 0; path < BENCH_PATHS; ++path) {
        PathRecorder& emca = recorder();
        emca.setPathIndex(path);
        emca.setPathOrigin(Vec3f{0, 0, 0});
        for (int depth = 1; depth <= BENCH_DEPTH; ++depth) {
            const bench_intersection* its = &all[next];
            next = next + 1 == BENCH_INTERSECTIONS ? 0 : next + 1;
            __asm__ volatile("" : : "r"(its) : "memory");
            emca.setDepthIndex(depth);
            emca.setIntersectionPos(its->position);
            emca.addIntersectionData("material", its->material);
            emca.addIntersectionData("pdf", its->pdf);
            emca.addIntersectionData("survival probability", its->survival);
            emca.addIntersectionData("throughput", its->throughput);
            emca.addIntersectionData("BSDF weight", its->bsdf_weight);
            emca.addIntersectionData("radiance", its->radiance);
            emca.addIntersectionData("sample", its->sample);
            emca.addIntersectionData("direction", its->direction);
            emca.setNextEventEstimationPos(its->light_position, its->visible);
            emca.setIntersectionEstimate(its->estimate);
        }
        emca.setFinalEstimate(all[next].estimate);
    }
}

void countIntersections(benchmark::State& state) {
    state.counters["ns/intersection"] =
        benchmark::Counter(double(state.iterations()) * int(BENCH_PATHS) * int(BENCH_DEPTH) * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

template <void (*Record)(const bench_intersection*)>
void outside(benchmark::State& state) {
    for (auto _ : state) Record(intersections().data());
    countIntersections(state);
}
BENCHMARK(outside<bench_nothing_in_c>)->Name("off/no calls");
BENCHMARK(outside<recordInCpp>)->Name("off/C++");
BENCHMARK(outside<bench_record_in_c>)->Name("off/C");

void onInCpp(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        auto recording = std::make_unique<Recording>();
        auto scope = std::make_unique<RecordScope>(*recording, Pixel{0, 0});
        state.ResumeTiming();
        recordInCpp(intersections().data());
        state.PauseTiming();
        scope.reset();
        recording.reset();
        state.ResumeTiming();
    }
    countIntersections(state);
}
BENCHMARK(onInCpp)->Name("on/C++");

void onInC(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        emca_recording* recording = nullptr;
        emca_scope* scope = nullptr;
        const emca_pixel pixel = {0, 0};
        if (emca_recording_create(0, &recording, nullptr) != EMCA_OK ||
            emca_scope_open(recording, &pixel, &scope, nullptr) != EMCA_OK)
            return state.SkipWithError("no recording");
        state.ResumeTiming();
        bench_record_in_c(intersections().data());
        state.PauseTiming();
        emca_scope_close(scope, nullptr);
        emca_recording_destroy(recording);
        state.ResumeTiming();
    }
    countIntersections(state);
}
BENCHMARK(onInC)->Name("on/C");

}  // namespace

BENCHMARK_MAIN();
