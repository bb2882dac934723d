#pragma once

#include <qwt_scale_draw.h>
#include <QColor>
#include <QString>
#include <string>
#include <vector>

#include "emca/analysis/statistics.h"

class QwtPlot;

namespace emca::explorer {

class Theme;

/// A label of an axis that stands for no number of its range: "≤ 0", "NaN".
struct EdgeLabel {
    double value = 0;  ///< where it stands on the scale
    QString text;
    QColor color;
};

/// A tick's label as plots write it: "10⁻⁵" for "1e-05", "1000" for "1e+03".
QString tickText(const std::string& label);

/// Scale of a plot whose ticks and labels come from analysis::ticks.
class PlotAxisDraw : public QwtScaleDraw {
  public:
    explicit PlotAxisDraw(bool labels = true);
    void setLabels(const std::vector<analysis::Tick>& ticks, std::vector<EdgeLabel> edges);
    QwtText label(double value) const override;

  private:
    std::vector<EdgeLabel> labels_;
};

/// Shows ticks on an axis that spans `spanned`, in the theme's style. Takes effect without a replot.
void applyAxis(QwtPlot& plot, int axis, const analysis::ValueRange& spanned, const std::vector<analysis::Tick>& ticks,
               std::vector<EdgeLabel> edges);
void styleAxis(QwtPlot& plot, int axis, const QString& title, const Theme& theme);

}  // namespace emca::explorer
