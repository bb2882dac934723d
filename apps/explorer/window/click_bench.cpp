// From a click in the image to every view drawn, and from a selection to every view drawn: rows of BASELINE.md, in the
// real window with a server in the same process. 1024 paths of 8 vertices. Run it under Xvfb with software OpenGL.
//
// One drawn frame of the 3D view is measured in the same run, between the selections and in the same way: nothing but
// the 3D view is asked to draw, and the clock stops when the window shows it. What a selection costs besides is the
// difference; for it, one frame of VTK is taken off both sides, because its time in software varies by more than all
// that is looked for. A second frame would stay in. Frames of the camera's flight to what was selected come after that and are counted apart.
#include <QTemporaryDir>
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "base/path_ids.h"
#include "emca/server/server.h"
#include "image/image_canvas.h"
#include "image/image_view.h"
#include "scene/scene_view.h"
#include "testing/event_times.h"
#include "testing/fake_renderer.h"
#include "testing/wait.h"
#include "window/main_window.h"
#include "window/panel_dock.h"

using namespace emca;
using namespace emca::explorer;

namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Medians of one kind of change.
struct Row {
    std::vector<double> total, rest, call, frames, flight;   ///< rest: without one frame of VTK
    std::map<std::string, std::vector<double>> times, paints;
    std::size_t runs = 0;
};

class Bench {
  public:
    ~Bench() { times_.nameOf = {}; }
    Bench(EventTimes& times, MainWindow& window) : times_(times), window_(window), scene_(*window.views().scene) {
        times_.nameOf = [this](const QWidget& widget) -> std::string {
            if (!std::strcmp(widget.metaObject()->className(), "emca::explorer::SceneCanvas")) return "3D frame";
            for (const auto& [name, dock] : window_.docks())
                if (dock == &widget) return name.toStdString();
            return &widget == &window_ ? "window" : "";
        };
    }

    void run(Row& row, const std::function<void()>& act, const std::function<bool()>& arrived = [] { return true; }) {
        waitFor([&] { return window_.isSettled(); });
        QTest::qWait(30);
        times_.clear();
        const std::uint64_t before = scene_.frameCount();
        double end = 0, frame = 0;
        std::uint64_t frames = 0;
        int painted = 0;
        QElapsedTimer clock;
        times_.handled = [&] {
            // The picture is complete with the first frame of the 3D view and the last paint of any other one.
            int now = 0;
            for (const auto& [name, count] : times_.paints)
                if (name != "3D frame" && name != "scene" && name != "window") now += count;
            const bool first = frames == 0 && scene_.frameCount() > before;
            if (!first && now == painted) return;
            painted = now;
            end = double(clock.nsecsElapsed()) * 1e-6;
            frames = scene_.frameCount() - before;
            frame = times_.milliseconds["3D frame"];
            snapshot_ = times_;
        };
        clock.start();
        act();
        const double call = double(clock.nsecsElapsed()) * 1e-6;
        while (!arrived() || frames == 0) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 1);
        QElapsedTimer quiet;   // ends when no other view was painted for a while
        quiet.start();
        double last = end;
        while (quiet.elapsed() < 60) {
            QCoreApplication::processEvents(QEventLoop::AllEvents, 1);
            if (end != last) quiet.restart();
            last = end;
        }
        times_.handled = {};
        waitFor([&] { return window_.isSettled(); });
        QTest::qWait(300);   // the full scene after the flight
        row.total.push_back(end);
        row.call.push_back(call);
        row.rest.push_back(end - frame / double(frames));
        row.frames.push_back(double(frames));
        row.flight.push_back(double(scene_.frameCount() - before - frames));
        for (const auto& [name, ms] : snapshot_.milliseconds) row.times[name].push_back(ms);
        for (const auto& [name, count] : snapshot_.paints) row.paints[name].push_back(count);
        ++row.runs;
    }

  private:
    struct Snapshot {
        std::map<std::string, double> milliseconds;
        std::map<std::string, int> paints;
        Snapshot& operator=(const EventTimes& t) { milliseconds = t.milliseconds; paints = t.paints; return *this; }
    } snapshot_;
    EventTimes& times_;
    MainWindow& window_;
    SceneView& scene_;
};

void report(const char* what, const Row& row, const Row& frame, double renderer) {
    const auto [low, high] = std::minmax_element(row.total.begin(), row.total.end());
    std::printf("%-18s median %6.1f ms (%.1f to %.1f); besides one frame%s %6.1f ms; 3D frames: %.0f, then %.0f of the flight\n", what,
                median(row.total), *low, *high, renderer > 0 ? " and the renderer" : "", median(row.rest) - median(frame.rest) - renderer,
                median(row.frames), median(row.flight));
    std::printf("    %-16s %6.2f ms\n", "the call", median(row.call));
    for (auto [name, values] : row.times) {
        values.resize(row.runs);
        const auto found = row.paints.find(name);
        std::vector<double> paints = found == row.paints.end() ? std::vector<double>() : found->second;
        paints.resize(row.runs);
        std::printf("    %-16s %6.2f ms, %.0f paints\n", name.empty() ? "else" : name.c_str(), median(values), median(paints));
    }
}

}  // namespace

int main(int argc, char** argv) {
    prepareOpenGl();
    EventTimes application(argc, argv);
    const int runs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
    // "region": the 65,536 paths of 8 x 8 pixels together instead of the 1,024 of one.
    const bool region = argc > 2 && !std::strcmp(argv[2], "region");
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

    SceneView& scene = *window.views().scene;
    ImageCanvas& canvas = window.views().image->canvas();
    Bench bench(application, window);
    Row clicks, frames, paths, vertices;
    std::vector<double> renderers;
    for (int i = 0; i < (region ? std::min(runs, 3) : runs); ++i) {
        if (region) {
            const client::PixelRegion pixels(PixelRect{std::uint32_t(i), 3, std::uint32_t(i) + 8, 11});
            bench.run(clicks, [&] { selection.setRegion(pixels); },
                      [&] { return !dataset.current().empty() && client::PixelRegion(dataset.current().front()->pixels) == pixels; });
            renderers.push_back(dataset.current().front()->renderSeconds * 1e3);
            continue;
        }
        const Pixel pixel{static_cast<std::uint32_t>(1 + i % 20), static_cast<std::uint32_t>(3 + i / 20)};
        bench.run(clicks, [&] { QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.transform().rectOf(pixel).center().toPoint()); },
                  [&] { return !dataset.current().empty() && dataset.current().front()->pixels.front() == pixel; });
        renderers.push_back(dataset.current().front()->renderSeconds * 1e3);
    }
    const PathSet& set = dataset.paths();
    for (int i = 0; i < runs; ++i) {
        const Index path = Index(i * 7) % set.pathCount();
        bench.run(frames, [&] { scene.requestFrame(); });
        bench.run(paths, [&] { selection.setPaths({pathId(set, path)}); });
        bench.run(frames, [&] { scene.requestFrame(); });
        bench.run(vertices, [&] { selection.setVertex(vertexId(set, set.vertices(path).first + 3)); });
    }
    std::printf("%u paths, %u vertices\n", set.pathCount(), set.vertexCount());
    report("one 3D frame", frames, frames, 0);
    report("click to all views", clicks, frames, median(renderers));
    report("select one path", paths, frames, 0);
    report("select one vertex", vertices, frames, 0);
    return 0;
}
