#include "plots/depth_plot.h"

namespace emca::explorer {
namespace {

PathPlotRow depthRow() {
    PathPlotRow row;
    row.axis = {QStringLiteral("path depth"), {}, true, false};
    row.color = &ThemeColors::data;
    row.query = "depth";
    row.series = [](const PathSet& paths) { return analysis::pathSeries(paths, analysis::PathQuantity::depth); };
    return row;
}

}  // namespace

DepthPlot::DepthPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : PathPlot(dataset, selection, theme, {depthRow()}, parent) {}

}  // namespace emca::explorer
