#include "plots/contribution_plot.h"

namespace emca::explorer {
namespace {

using analysis::PathQuantity;
using analysis::PathSeries;

PathPlotRow channel(const QString& name, PathQuantity quantity, ScatterPlot::ColorRole color) {
    const std::string_view unit = analysis::unit(quantity);
    PathPlotRow row;
    row.axis = {name, QString::fromUtf8(unit.data(), int(unit.size())), false, true};
    row.color = color;
    row.query = quantity == PathQuantity::red ? "estimate.r" : quantity == PathQuantity::green ? "estimate.g" : "estimate.b";
    row.series = [quantity](const PathSet& paths) { return analysis::pathSeries(paths, quantity); };
    return row;
}

PathSeries alphaSeries(const PathSet& paths) {
    PathSeries series;
    for (const Column* column : paths.find(Scope::path, "alpha")) {
        if (componentCount(column->type) != 1) continue;
        for (Index path = 0; path < paths.pathCount(); ++path)
            if (const auto value = paths.last(*column, path)) {
                series.values.push_back(component(*value, 0));
                series.paths.push_back(path);
            }
        break;
    }
    return series;
}

PathPlotRow alpha() {
    PathPlotRow row;
    row.axis = {QStringLiteral("alpha"), {}, false, true};
    row.color = &ThemeColors::alpha;
    row.query = "alpha";
    row.series = alphaSeries;
    row.optional = true;
    return row;
}

}  // namespace

ContributionPlot::ContributionPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme,
                                   QWidget* parent)
    : PathPlot(dataset, selection, theme,
               {channel(tr("red"), PathQuantity::red, &ThemeColors::red),
                channel(tr("green"), PathQuantity::green, &ThemeColors::green),
                channel(tr("blue"), PathQuantity::blue, &ThemeColors::blue), alpha()},
               parent) {}

}  // namespace emca::explorer
