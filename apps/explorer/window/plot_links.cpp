#include "window/plot_links.h"

#include <QApplication>
#include <algorithm>

#include "image/region_histogram.h"
#include "image/region_panel.h"
#include "parallel/parallel_plot.h"
#include "paths/filter_panel.h"
#include "paths/rule_row.h"
#include "plots/path_plot.h"
#include "window/main_window.h"
#include "window/toast.h"
#include "window/views.h"

namespace emca::explorer {
namespace {

/// Added to what the filter asks already: as rules, or as a query where it is no list of rules.
void addToFilter(FilterPanel& filter, const std::vector<query::Rule>& rules, const QString& query) {
    const QString before = filter.queryText().trimmed();
    const bool asRules = !rules.empty() && !filter.isEditedByHand() && (before.isEmpty() || filter.rowCount() > 0);
    if (!asRules) return filter.setQueryText(before.isEmpty() ? query : QStringLiteral("(%1) and %2").arg(before, query));
    const std::vector<query::Rule> present = filter.rules();
    for (const query::Rule& rule : rules)
        if (std::find(present.begin(), present.end(), rule) == present.end()) filter.addRule(rule);
}

}  // namespace

void linkPlots(MainWindow& window, Views& views, Toast& toast) {
    const auto say = [&toast](const QString& sentence) { toast.showRemark(sentence); };
    for (const Views::Plot& plot : views.plots) QObject::connect(plot.widget, &PathPlot::message, &window, say);
    QObject::connect(views.parallel, &ParallelPlot::message, &window, say);
    QObject::connect(&views.region->histogram(), &RegionHistogram::message, &window, say);
    QObject::connect(views.parallel, &ParallelPlot::filterWanted, &window, [&](const std::vector<query::Rule>& rules, const QString& query) {
        addToFilter(*views.filter, rules, query);
        window.showDock(QStringLiteral("filter"));
    });
}

void exportPlot(Views& views) {
    QWidget* focus = QApplication::focusWidget();
    const auto meant = [&](QWidget& plot, bool focused) { return focused ? plot.isAncestorOf(focus) : !plot.visibleRegion().isEmpty(); };
    for (const bool focused : {true, false}) {
        for (const Views::Plot& plot : views.plots)
            if (meant(*plot.widget, focused)) return askForExport(plot.widget->exporting());
        if (meant(*views.parallel, focused)) return askForExport(views.parallel->exporting());
        if (meant(views.region->histogram(), focused)) return askForExport(views.region->histogram().exporting());
    }
}

}  // namespace emca::explorer
