#pragma once

namespace emca::explorer {

class MainWindow;
class Toast;
struct Views;

/// What plots ask of the rest of the window: marks of parallel axes become rules of the filter, and what a plot says is
/// shown.
void linkPlots(MainWindow& window, Views& views, Toast& toast);

/// Asks where to export the plot that has the focus, else the one that is seen.
void exportPlot(Views& views);

}  // namespace emca::explorer
