#pragma once

#include <QWidget>
#include <cmath>

#include "emca/analysis/color_map.h"
#include "emca/explorer/plugin_context.h"

namespace emca::light_probe {

/// A colour map lying under a picture, with round ticks and a pointer at the value under the cursor.
class ColorStrip : public QWidget {
    Q_OBJECT
  public:
    explicit ColorStrip(explorer::PluginContext& context, QWidget* parent = nullptr) : QWidget(parent), context_(context) {}
    void show(analysis::ColorMapId map, const analysis::ValueRange& range);
    using QWidget::show;
    void setPointer(double value);   ///< NaN: none
    QSize sizeHint() const override { return {200, 34}; }
    QSize minimumSizeHint() const override { return {120, 34}; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    explorer::PluginContext& context_;
    analysis::ColorMapId map_ = analysis::ColorMapId::viridis;
    analysis::ValueRange range_;
    double pointer_ = std::nan("");
};

}  // namespace emca::light_probe
