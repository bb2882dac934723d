#pragma once

#include "plots/path_plot.h"

namespace emca::explorer {

/// Red, green and blue of the final estimates over the sample index, above each other; alpha below where the renderer
/// recorded a path value named "alpha".
class ContributionPlot : public PathPlot {
    Q_OBJECT
  public:
    ContributionPlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
};

}  // namespace emca::explorer
