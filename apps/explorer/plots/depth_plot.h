#pragma once

#include "plots/path_plot.h"

namespace emca::explorer {

/// Depth of the paths (largest depth index with a position) over the sample index, and how many have each depth.
class DepthPlot : public PathPlot {
    Q_OBJECT
  public:
    DepthPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
};

}  // namespace emca::explorer
