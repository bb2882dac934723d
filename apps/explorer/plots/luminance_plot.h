#pragma once

#include "plots/path_plot.h"

namespace emca::explorer {

/// Luminance of the final estimates over the sample index.
class LuminancePlot : public PathPlot {
    Q_OBJECT
  public:
    LuminancePlot(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
};

}  // namespace emca::explorer
