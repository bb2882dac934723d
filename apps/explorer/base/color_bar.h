#pragma once

#include <QColor>
#include <QWidget>

#include <limits>

#include "emca/analysis/color_map.h"

class QPainter;

namespace emca::explorer {

class Theme;

struct ColorBarContent {
    analysis::ColorMapId map = analysis::ColorMapId::viridis;
    analysis::ValueRange range;
    QString label;                     ///< above the bar; room for a word
    QString title;                     ///< along the bar, turned by 90 degrees: name and unit
    double pointer = std::numeric_limits<double>::quiet_NaN();   ///< a value to point at; NaN for none
    bool integral = false;             ///< whole numbers: no tick between them
    QColor ground = {};                ///< of what is coloured: its colours are those of seenOn(); invalid: those of the map
};
/// An upright bar with ticks at round numbers. The ground is the caller's.
void paintColorBar(QPainter& painter, const QRectF& rect, const ColorBarContent& content, const Theme& theme);

/// An upright colour bar with ticks at round numbers and a unit, to stand beside what it explains.
class ColorBar : public QWidget {
    Q_OBJECT
  public:
    explicit ColorBar(Theme& theme, QWidget* parent = nullptr);
    void show(analysis::ColorMapId map, const analysis::ValueRange& range, const QString& label);
    void show(const ColorBarContent& content);
    using QWidget::show;
    const ColorBarContent& content() const { return content_; }
    /// A value to point at (what is under the cursor); NaN for none.
    void setPointer(double value);
    QSize sizeHint() const override { return {content_.title.isEmpty() ? 76 : kTitledWidth, 200}; }
    QSize minimumSizeHint() const override { return {sizeHint().width(), 80}; }
    static constexpr int kTitledWidth = 104;

  signals:
    /// The range was dragged or scrolled: the wheel stretches the end that is nearer to the cursor.
    void rangeEdited(emca::analysis::ValueRange range);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

  private:
    Theme& theme_;
    ColorBarContent content_;
};

}  // namespace emca::explorer
