#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/path_ids.h"
#include "scene_test_data.h"
#include "scene_view.h"

// What a click costs in the 3D view, apart from the frame and with it: medians in milliseconds. Processor time stands
// beside them, because software OpenGL draws on all cores and other programs may want them too.
// Run under Xvfb with LIBGL_ALWAYS_SOFTWARE=1. An argument limits the rounds; "large N" measures a scene of N triangles.
using namespace emca;
using namespace emca::explorer;

namespace {

/// Of all threads, in milliseconds.
double processorTime() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Everything that is waiting, and the frame that it asks for.
void paintNow() {
    QCoreApplication::sendPostedEvents();
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
}

void measure(const char* what, int rounds, const std::function<void(int)>& action,
             const std::function<void()>& prepare = {}) {
    std::vector<double> calls, totals, processor;
    for (int i = 0; i < rounds; ++i) {
        if (prepare) prepare();
        paintNow();
        const double before = processorTime();
        QElapsedTimer timer;
        timer.start();
        action(i);
        calls.push_back(double(timer.nsecsElapsed()) * 1e-6);
        paintNow();
        totals.push_back(double(timer.nsecsElapsed()) * 1e-6);
        processor.push_back(processorTime() - before);
    }
    std::printf("  %-28s %8.2f ms call %8.1f ms with the frame %8.1f ms of all cores\n", what, median(calls), median(totals), median(processor));
    std::fflush(stdout);
}

void bench(const char* title, std::uint32_t pathCount, std::uint32_t triangles, int rounds) {
    std::printf("%s\n", title);
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    SceneView view(dataset, selection, theme);
    SceneOptions options = view.options();
    options.animate = options.flyToSelection = false;
    view.setOptions(options);
    view.resize(1150, 700);
    view.show();
    explorer::testing::fillRoom(dataset, {});
    if (triangles > 0) {
        auto meshes = explorer::testing::roomMeshes();
        meshes.push_back(explorer::testing::waves(triangles));
        QElapsedTimer timer;
        timer.start();
        dataset.setMeshes(std::make_shared<const std::vector<Mesh>>(std::move(meshes)));
        const double blocked = double(timer.nsecsElapsed()) * 1e-6;
        while (view.isLoading()) QApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
        std::printf("  prepare meshes: %.0f ms beside the window, which was held up for %.1f ms\n", double(timer.nsecsElapsed()) * 1e-6, blocked);
    }
    const PathSet paths = explorer::testing::roomPaths(pathCount, 8, 0.01f, true);
    std::printf("  %u paths, %u vertices, %.2f on average\n", paths.pathCount(), paths.vertexCount(), double(paths.vertexCount()) / paths.pathCount());
    const auto trace = explorer::testing::traceOf(paths);
    dataset.addTrace(trace);
    measure("show all paths", rounds, [&](int) { dataset.setCurrent({trace}); }, [&] { dataset.setCurrent({}); });
    const auto path = [&](int i) { return Index(i * 37) % paths.pathCount(); };
    measure("select one path", rounds, [&](int i) { selection.setPaths({pathId(paths, path(i))}); });
    measure("select one intersection", rounds, [&](int i) {
        selection.setVertex(vertexId(paths, paths.vertices(path(i)).first));
    });
    measure("hover another vertex", rounds, [&](int i) { selection.setHovered(vertexId(paths, paths.vertices(path(i)).first)); });
    selection.clearPaths();
    const auto frameWith = [&](const char* what, auto edit) {
        SceneOptions changed = options;
        edit(changed);
        view.setOptions(changed);
        measure(what, rounds, [&](int) {
            changed.cameraGlyph = !changed.cameraGlyph;   // asks for a frame
            view.setOptions(changed);
        });
    };
    frameWith("frame without paths", [](SceneOptions& o) { o.paths = PathChoice::none; });
    frameWith("  and without FXAA", [](SceneOptions& o) { o.paths = PathChoice::none; o.smoothEdges = false; });
    frameWith("  and without surfaces", [](SceneOptions& o) { o.paths = PathChoice::none; o.smoothEdges = o.edges = false; o.surfaceOpacity = 0; });
    frameWith("everything", [](SceneOptions&) {});
    ViewPose pose = view.pose();
    measure("orbit by one step", rounds, [&](int) {
        pose = orbited(pose, pose.focus, {0, 1, 0}, 0.02, 0);
        view.setPose(pose);
    });
}

/// Of the whole program, in MiB: what is in use now, and the most that ever was.
std::pair<double, double> memoryInUse() {
    std::ifstream status("/proc/self/status");
    double now = 0, peak = 0;
    for (std::string word; status >> word;) {
        if (word == "VmRSS:") status >> now;
        if (word == "VmHWM:") status >> peak;
    }
    return {now / 1024, peak / 1024};
}

/// A scene of many triangles: how long it takes until it is seen, how much memory, and how it turns.
void benchLarge(std::uint32_t triangles) {
    std::printf("%u triangles\n", triangles);
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    SceneView view(dataset, selection, theme);
    SceneOptions options = view.options();
    options.animate = options.flyToSelection = false;
    view.setOptions(options);
    view.resize(1150, 700);
    view.show();
    auto meshes = explorer::testing::roomMeshes();
    for (std::uint32_t i = 0; i < 4; ++i) {   // four layers of waves: hidden surfaces cost as they do in real scenes
        meshes.push_back(explorer::testing::waves(triangles / 4));
        for (Vec3f& p : meshes.back().positions) p.y += 0.15f * float(i);
    }
    explorer::testing::fillRoom(dataset, explorer::testing::roomPaths(1024, 8, 0.01f, true));
    paintNow();
    std::printf("  before: %.0f MiB in use, the scene's own arrays among them\n", memoryInUse().first);
    QElapsedTimer timer;
    timer.start();
    const double before = processorTime();
    dataset.setMeshes(std::make_shared<const std::vector<Mesh>>(std::move(meshes)));
    const double blocked = double(timer.nsecsElapsed()) * 1e-6;
    while (view.isLoading()) QApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
    paintNow();
    std::printf("  seen after %.2f s (%.2f s of all cores; the window was held up for %.0f ms), %zu triangles drawn, %.0f MiB in use, %.0f at most\n",
                double(timer.nsecsElapsed()) * 1e-9, (processorTime() - before) * 1e-3, blocked, view.shownTriangles(), memoryInUse().first, memoryInUse().second);
    ViewPose pose = view.pose();
    measure("turn by one step", 15, [&](int) {
        pose = orbited(pose, pose.focus, {0, 1, 0}, 0.02, 0);
        view.setPose(pose);
    });
    timer.restart();
    while (view.isMoving() || timer.elapsed() < 600) QApplication::processEvents(QEventLoop::AllEvents, 20);
    std::printf("  at rest: frame of %.0f ms, %zu triangles drawn\n", view.lastFrameSeconds() * 1e3, view.shownTriangles());
    const PathSet& paths = dataset.paths();
    measure("select one path", 9, [&](int i) { selection.setPaths({pathId(paths, Index(i * 37) % paths.pathCount())}); });
    timer.restart();
    view.renderImage({1150, 700});
    std::printf("  a picture with every triangle: %.2f s; %.0f MiB at most\n", double(timer.nsecsElapsed()) * 1e-9, memoryInUse().second);
}

}  // namespace

int main(int argc, char** argv) {
    prepareOpenGl();
    QApplication application(argc, argv);
    if (!hasOpenGl()) {
        std::fprintf(stderr, "scene_bench needs OpenGL 3.2: run it under xvfb-run with LIBGL_ALWAYS_SOFTWARE=1.\n");
        return 3;
    }
    if (argc > 2 && std::string(argv[1]) == "large") {
        benchLarge(static_cast<std::uint32_t>(std::strtoul(argv[2], nullptr, 10)));
        return 0;
    }
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
    bench("1,024 paths in a small scene", 1024, 0, rounds);
    bench("1,024 paths, 1,000,000 triangles", 1024, 1000000, std::min(rounds, 7));
    bench("65,536 paths in a small scene", 65536, 0, std::min(rounds, 5));
    return 0;
}
