#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "base/path_ids.h"
#include "scene_test_data.h"
#include "scene_view.h"

// What a click costs in the 3D view, apart from the frame and with it: medians in milliseconds. Processor time stands
// beside them, because software OpenGL draws on all cores and other programs may want them too.
// Run under Xvfb with LIBGL_ALWAYS_SOFTWARE=1. An argument limits the rounds.
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

}  // namespace

int main(int argc, char** argv) {
    prepareOpenGl();
    QApplication application(argc, argv);
    if (!hasOpenGl()) {
        std::fprintf(stderr, "scene_bench needs OpenGL 3.2: run it under xvfb-run with LIBGL_ALWAYS_SOFTWARE=1.\n");
        return 3;
    }
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
    bench("1,024 paths in a small scene", 1024, 0, rounds);
    bench("1,024 paths, 1,000,000 triangles", 1024, 1000000, std::min(rounds, 7));
    bench("65,536 paths in a small scene", 65536, 0, std::min(rounds, 5));
    return 0;
}
