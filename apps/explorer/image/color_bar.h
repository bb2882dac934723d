#pragma once

#include <QWidget>

#include "emca/analysis/color_map.h"

namespace emca::explorer {

class Theme;

/// An upright colour bar with ticks at round numbers and a unit, to stand beside what it explains.
class ColorBar : public QWidget {
    Q_OBJECT
  public:
    explicit ColorBar(Theme& theme, QWidget* parent = nullptr);
    void show(analysis::ColorMapId map, const analysis::ValueRange& range, const QString& label);
    using QWidget::show;
    /// A value to point at (what is under the cursor); NaN for none.
    void setPointer(double value);
    QSize sizeHint() const override { return {76, 200}; }
    QSize minimumSizeHint() const override { return {76, 80}; }

  signals:
    /// The range was dragged or scrolled: the wheel stretches the end that is nearer to the cursor.
    void rangeEdited(emca::analysis::ValueRange range);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

  private:
    QRectF bar() const;
    Theme& theme_;
    analysis::ColorMapId map_ = analysis::ColorMapId::viridis;
    analysis::ValueRange range_;
    QString label_;
    double pointer_;
};

}  // namespace emca::explorer
