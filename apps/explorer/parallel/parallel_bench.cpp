// Measures what parallel coordinates and the plots over paths cost at 65,536 paths of 8 vertices: a new pixel, a drawing
// of everything, a selection, a step of a drag along an axis. Needs no display: QT_QPA_PLATFORM=offscreen.
#include <QApplication>
#include <QElapsedTimer>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <vector>

#include "base/path_ids.h"
#include "parallel/parallel_canvas.h"
#include "parallel/parallel_plot.h"
#include "paths/test_paths.h"
#include "plots/contribution_plot.h"
#include "plots/luminance_plot.h"

using namespace emca;
using namespace emca::explorer;

namespace {

/// Milliseconds: median of some runs, and of the processor's own time, which others on the machine do not lengthen.
void measure(const char* name, const std::function<void()>& prepare, const std::function<void()>& run) {
    std::vector<double> times, own;
    for (int i = 0; i < 9; ++i) {
        if (prepare) prepare();
        QElapsedTimer timer;
        timer.start();
        const std::clock_t before = std::clock();
        run();
        own.push_back(double(std::clock() - before) * 1e3 / CLOCKS_PER_SEC);
        times.push_back(double(timer.nsecsElapsed()) * 1e-6);
    }
    std::sort(times.begin(), times.end());
    std::sort(own.begin(), own.end());
    std::printf("%-64s %8.2f ms, %8.2f of the processor\n", name, times[times.size() / 2], own[own.size() / 2]);
}

template <typename Plot>
void measurePlot(const char* name, client::Dataset& dataset, client::Selection& selection, Theme& theme, const std::vector<client::PathId>& tenth) {
    Plot plot(dataset, selection, theme);
    plot.resize(760, 430);
    plot.show();
    QImage image(plot.size(), QImage::Format_ARGB32_Premultiplied);
    int width = 760;
    const std::string text(name);
    measure((text + ": draw everything").c_str(), [&] { plot.resize(width ^= 2, 430); }, [&] { plot.render(&image); });
    bool some = false;
    measure((text + ": select 6,554 paths, or none, and draw").c_str(), {}, [&] {
        selection.setPaths((some = !some) ? tenth : std::vector<client::PathId>{});
        plot.render(&image);
    });
    selection.clearPaths();
}

}  // namespace

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    Theme theme;
    theme.applyTo(application);
    client::Dataset dataset;
    client::Selection selection;
    const auto trace = test::traceOf(test::fakePaths({.samples = 65536, .vertices = 8}));
    const auto small = test::traceOf(test::fakePaths({.samples = 16}));
    dataset.addTrace(trace);
    std::vector<client::PathId> tenth;
    for (Index path = 0; path < 65536; path += 10) tenth.push_back(pathId(trace->paths, path));

    {
        ParallelPlot plot(dataset, selection, theme);
        plot.setAxes({{"sample"}, {"luminance", true}, {"max(c.luminance)", true}, {"min(v.segment)", true}, {"max(v.`bsdf pdf`)"}, {"last(v.label)"}});
        plot.resize(760, 430);
        plot.show();
        QImage image(plot.size(), QImage::Format_ARGB32_Premultiplied);
        measure("parallel, 6 axes: another pixel (values of 65,536 paths)", [&] { dataset.setCurrent({small}); }, [&] { dataset.setCurrent({trace}); });
        int width = 760;
        measure("parallel: draw everything", [&] { plot.resize(width ^= 2, 430); }, [&] { plot.render(&image); });
        measure("parallel: place lines for another size", {}, [&] { plot.canvas().resize(width ^= 2, 400); });
        plot.render(&image);
        bool some = false;
        measure("parallel: select 6,554 paths, or none, and draw", {}, [&] {
            selection.setPaths((some = !some) ? tenth : std::vector<client::PathId>{});
            plot.render(&image);
        });
        selection.clearPaths();
        Index path = 0;
        measure("parallel: select one path and draw", {}, [&] {
            selection.setPaths({pathId(trace->paths, path++)});
            plot.render(&image);
        });
        measure("parallel: nearest line under the mouse", {}, [&] { (void)lineAt(plot.canvas().lines(), {200, 200}, 6); });
        const query::Brush brush{0, 20000};
        const query::AxisValues& values = plot.axes()[0].values;
        const std::vector<query::BrushedAxis> axes(6, query::BrushedAxis{&values, {&brush, 1}});
        measure("parallel: paths in marks of six axes", {}, [&] { (void)query::brushedPaths(axes, 65536); });
    }
    measurePlot<LuminancePlot>("luminance", dataset, selection, theme, tenth);
    measurePlot<ContributionPlot>("red, green, blue", dataset, selection, theme, tenth);
    return 0;
}
