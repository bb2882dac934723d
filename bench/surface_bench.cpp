// 3D data on surfaces, against BASELINE: nanoseconds of wall time per sample of one scalar layer, random places on
// 100,000 and on 2 triangles, with growing subdivision and with the budget used up, by 1 and 2 threads; finishing.
//
// Places are made before the clock starts and read in order: a stream of 20 bytes a sample, which is counted. The clock
// runs from an empty recorder, so first storage and all divisions are counted; finish() is measured alone.
#include <benchmark/benchmark.h>

#include <time.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <latch>
#include <memory>
#include <thread>
#include <vector>

#include "emca/core/seed_map.h"
#include "emca/recorder/surface_recorder.h"
#include "surface_for_tests.h"

namespace {

using namespace emca;

/// A bumpy square of side x side x 2 triangles.
Mesh terrain(std::uint32_t side) {
    Mesh mesh = test::grid(side);
    for (Vec3f& p : mesh.positions) p.z = 0.05f * std::sin(20 * p.x) * std::cos(17 * p.y);
    return mesh;
}

struct Sample {
    Vec3f position;
    std::uint32_t face;
    float value;
};

struct Workload {
    std::uint32_t side;
    std::uint64_t samples;
    std::size_t budget = 256u << 20;
    int layers = 1;
    bool onePoint = false;
    bool barycentrics = false;  ///< given as such, as most ray tracers have them; else found from the position
};

std::uint64_t next(std::uint64_t& state) { return mix64(state += kGolden64); }

/// Uniform over faces and over each face. Called again and again with other seeds, as 50 M samples need not be kept.
void fill(std::vector<Sample>& samples, const Mesh& mesh, std::uint64_t seed, const Workload& work) {
    std::uint64_t state = seed;
    for (Sample& s : samples) {
        const std::uint64_t a = next(state), b = next(state);
        s.face = work.onePoint ? 0 : static_cast<std::uint32_t>((a & 0xffffffffu) * mesh.triangles.size() >> 32);
        float u = work.onePoint ? 0.3f : float(b >> 40) * 0x1p-24f;
        float v = work.onePoint ? 0.2f : float(b >> 8 & 0xffffff) * 0x1p-24f;
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Triangle& t = mesh.triangles[s.face];
        s.position = mesh.positions[t[0]] * (1 - u - v) + mesh.positions[t[1]] * u + mesh.positions[t[2]] * v;
        if (work.barycentrics) s.position = {u, v, 0};
        s.value = float(a >> 40) * 0x1p-24f;
    }
}

struct Times {
    double recording = 0, finishing = 0;
    double processor = 0;  ///< of all recording threads together
    SurfaceField field;
};

double processorSeconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Records in portions, with the clock stopped while the next portion is made.
Times run(const Workload& work, int threads) {
    using Clock = std::chrono::steady_clock;
    const std::vector<Mesh> meshes = {terrain(work.side)};
    // 256: as when the rows of docs/performance.md were measured.
    SurfaceRecorder recorder(meshes, {.budgetBytes = work.budget, .samplesPerDivision = 256, .minimumEdge = 0});
    std::vector<SurfaceLayer> layers;
    for (int i = 0; i < work.layers; ++i)
        layers.push_back(*recorder.addLayer({"value " + std::to_string(i), LayerKind::mean, "", ""}));
    constexpr std::uint64_t kPortion = 1000000;
    std::vector<std::vector<Sample>> samples(threads, std::vector<Sample>(kPortion / threads));
    Times times;
    std::atomic<double> processor{0};
    for (std::uint64_t done = 0; done < work.samples; done += kPortion) {
        for (int i = 0; i < threads; ++i) fill(samples[i], meshes[0], done * 31 + std::uint64_t(i) + 1, work);
        std::latch start(threads + 1);
        std::vector<std::thread> workers;
        for (int i = 0; i < threads; ++i)
            workers.emplace_back([&, i] {
                SurfaceCursor& surface = recorder.cursor();
                start.arrive_and_wait();
                const double before = processorSeconds(CLOCK_THREAD_CPUTIME_ID);
                for (const Sample& s : samples[i]) {
                    const SurfacePoint at = work.barycentrics
                                                ? surface.locate(0, s.face, Vec2f{s.position.x, s.position.y})
                                                : surface.locate(0, s.face, s.position);
                    for (const SurfaceLayer& layer : layers) layer.add(at, s.value);
                }
                processor += processorSeconds(CLOCK_THREAD_CPUTIME_ID) - before;
            });
        start.arrive_and_wait();
        const auto begin = Clock::now();
        for (std::thread& worker : workers) worker.join();
        times.recording += std::chrono::duration<double>(Clock::now() - begin).count();
    }
    times.processor = processor;
    const double begin = processorSeconds(CLOCK_PROCESS_CPUTIME_ID);
    times.field = recorder.finish();
    times.finishing = processorSeconds(CLOCK_PROCESS_CPUTIME_ID) - begin;
    return times;
}

void record(benchmark::State& state, Workload work) {
    const int threads = int(state.range(0));
    Times times;
    double recording = 0, finishing = 0, processor = 0;
    for (auto _ : state) {
        times = run(work, threads);
        recording += times.recording;
        finishing += times.finishing;
        processor += times.processor;
        state.SetIterationTime(times.recording);
    }
    if (times.field.counts.points != work.samples) state.SkipWithError("samples were lost");
    const double samples = double(work.samples) * double(state.iterations());
    state.counters["ns/sample"] = recording / samples * 1e9;
    state.counters["cpu/thread"] = processor / samples / threads * 1e9;  // what ns/sample is on a machine of our own
    state.counters["finish_ms"] = finishing / double(state.iterations()) * 1e3;
    state.counters["faces"] = double(times.field.faceCount());
    state.counters["MiB"] = double(times.field.counts.bytesUsed) / double(1 << 20);
    state.counters["coarse_%"] = 100 * double(times.field.counts.coarse) / double(work.samples);
}

void bench(const char* name, Workload work) {
    benchmark::RegisterBenchmark(name, record, work)->Arg(1)->Arg(2)->ArgName("threads")->Iterations(1)->UseManualTime()
        ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
    constexpr std::uint32_t k100k = 224;  // 100,352 triangles
    constexpr std::size_t kDefault = 256u << 20;
    bench("100k_triangles_5M", {k100k, 5000000});
    bench("100k_triangles_50M", {k100k, 50000000});
    bench("2_triangles_5M", {1, 5000000});
    bench("2_triangles_50M", {1, 50000000});
    bench("100k_budget_exhausted_5M", {k100k, 5000000, 2u << 20});
    bench("100k_budget_exhausted_50M", {k100k, 50000000, 6u << 20});
    bench("100k_barycentrics_5M", {k100k, 5000000, kDefault, 1, false, true});
    bench("2_barycentrics_5M", {1, 5000000, kDefault, 1, false, true});
    bench("100k_budget_exhausted_barycentrics_5M", {k100k, 5000000, 2u << 20, 1, false, true});
    bench("one_point_5M", {1, 5000000, kDefault, 1, true});
    bench("100k_nine_layers_5M", {k100k, 5000000, kDefault, 9});
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
