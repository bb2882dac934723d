#include <QApplication>
#include <QElapsedTimer>
#include <QEvent>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/path_ids.h"
#include "scene_test_data.h"
#include "scene_view.h"

// What a click costs in the 3D view, apart from the frame and with it: medians in milliseconds.
// Run under Xvfb with LIBGL_ALWAYS_SOFTWARE=1. An argument limits the rounds.
using namespace emca;
using namespace emca::explorer;

namespace {

struct Times { double call = 0, frame = 0; };

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

void paintNow(SceneView& view) {
    // Everything that is waiting, and the frame that it asks for.
    QCoreApplication::sendPostedEvents();
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    (void)view;
}

void measure(SceneView& view, const char* what, int rounds, const std::function<void(int)>& action) {
    std::vector<double> calls, totals, frames;
    for (int i = 0; i < rounds; ++i) {
        paintNow(view);
        QElapsedTimer timer;
        timer.start();
        action(i);
        calls.push_back(double(timer.nsecsElapsed()) * 1e-6);
        paintNow(view);
        totals.push_back(double(timer.nsecsElapsed()) * 1e-6);
        frames.push_back(view.lastFrameSeconds() * 1e3);
    }
    std::printf("  %-28s %8.2f ms call %8.1f ms with the frame (of which drawing %.1f)\n", what, median(calls), median(totals), median(frames));
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
    // The room is open: paths that escape are short, so longer ones are allowed until the mean is about 8.
    const PathSet paths = explorer::testing::roomPaths(pathCount, 12);
    std::printf("  %u paths, %u vertices\n", paths.pathCount(), paths.vertexCount());
    const auto trace = explorer::testing::traceOf(paths);
    const auto none = explorer::testing::traceOf(PathSet());
    measure(view, "show all paths", rounds, [&](int) { dataset.addTrace(trace); });
    const auto path = [&](int i) { return Index(i * 37) % paths.pathCount(); };
    measure(view, "select one path", rounds, [&](int i) { selection.setPaths({pathId(paths, path(i))}); });
    measure(view, "select one intersection", rounds, [&](int i) {
        selection.setVertex(vertexId(paths, paths.vertices(path(i)).first));
    });
    measure(view, "hover another vertex", rounds, [&](int i) { selection.setHovered(vertexId(paths, paths.vertices(path(i)).first)); });
    ViewPose pose = view.pose();
    measure(view, "orbit by one step", rounds, [&](int) {
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
