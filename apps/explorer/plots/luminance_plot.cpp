#include "plots/luminance_plot.h"

#include "base/qt_compat.h"

namespace emca::explorer {
namespace {

PathPlotRow luminanceRow() {
    constexpr auto kQuantity = analysis::PathQuantity::luminance;
    PathPlotRow row;
    row.axis = {toQString(analysis::label(kQuantity)), toQString(analysis::unit(kQuantity)), false, true};
    row.color = &ThemeColors::luminance;
    row.query = "luminance";
    row.series = [](const PathSet& paths) { return analysis::pathSeries(paths, kQuantity); };
    return row;
}

}  // namespace

LuminancePlot::LuminancePlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : PathPlot(dataset, selection, theme, {luminanceRow()}, parent) {}

}  // namespace emca::explorer
