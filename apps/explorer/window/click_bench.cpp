// From a click in the image to every view drawn, and from a selection to every view drawn: rows of BASELINE.md, in the
// real window with a server in the same process. 1024 paths of 8 vertices.
#include <QApplication>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <vector>

#include "base/path_ids.h"
#include "emca/server/server.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "scene/scene_view.h"
#include "testing/fake_renderer.h"
#include "testing/wait.h"
#include "window/main_window.h"

using namespace emca;
using namespace emca::explorer;

namespace {

constexpr int kRuns = 15;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Milliseconds until `act` has its effect and no view has anything left to paint.
double measure(const std::function<void()>& act, const std::function<bool()>& arrived) {
    QElapsedTimer clock;
    clock.start();
    act();
    while (!arrived()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 1);
    QCoreApplication::sendPostedEvents();
    QCoreApplication::processEvents();
    return double(clock.nsecsElapsed()) * 1e-6;
}

void report(const char* what, const std::vector<double>& values, double frame) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    std::printf("%-28s median %7.1f ms  (%.1f to %.1f)  of it one 3D frame: %.1f ms\n", what, median(values), *low, *high, frame);
}

}  // namespace

int main(int argc, char** argv) {
    prepareOpenGl();
    QApplication application(argc, argv);
    FakeRenderer renderer;
    renderer.samplesPerPixel = 1024;
    renderer.depth = 8;
    auto server = Server::start(renderer);
    if (!server) return 4;
    QTemporaryDir folder;
    QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
    Theme theme;
    theme.applyTo(application);
    client::Dataset dataset;
    client::Selection selection;
    SessionController session(dataset, selection);
    MainWindow window(dataset, selection, session, theme, settings);
    window.show();
    window.connectTo({"127.0.0.1", (*server)->port()});
    if (!waitFor([&] { return window.isSettled() && dataset.currentImage() && session.link() == LinkState::connected; })) return 4;

    ImageCanvas& canvas = window.views().image->canvas();
    std::vector<double> clicks, renderers, paths, vertices, frames;
    for (int i = 0; i < kRuns; ++i) {
        const Pixel pixel{static_cast<std::uint32_t>(1 + i), 7};
        clicks.push_back(measure(
            [&] { QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf(pixel).center().toPoint()); },
            [&] { return !dataset.current().empty() && dataset.current().front()->pixels.front() == pixel; }));
        renderers.push_back(dataset.current().front()->renderSeconds * 1e3);
        frames.push_back(window.views().scene->lastFrameSeconds() * 1e3);
    }
    const PathSet& set = dataset.paths();
    for (Index i = 0; i < kRuns; ++i) {
        paths.push_back(measure([&] { selection.setPaths({pathId(set, i * 7)}); }, [] { return true; }));
        waitFor([&] { return window.isSettled(); });
        vertices.push_back(measure([&] { selection.setVertex(vertexId(set, set.vertices(i * 7).first + 3)); }, [] { return true; }));
        waitFor([&] { return window.isSettled(); });
    }
    std::printf("%u paths, %u vertices; the renderer's own time: %.1f ms\n", set.pathCount(), set.vertexCount(), median(renderers));
    report("click to all views", clicks, median(frames));
    report("select one path", paths, median(frames));
    report("select one vertex", vertices, median(frames));
    return 0;
}
