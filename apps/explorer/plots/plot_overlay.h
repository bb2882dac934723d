#pragma once

#include <QWidget>
#include <optional>

namespace emca::explorer {

class Theme;

/// What moves with the mouse above the canvas of a plot: ring around the hovered point, its value, a line at its x,
/// the rectangle being drawn. Apart from the canvas, so that moving the mouse draws no points again.
class PlotOverlay : public QWidget {
  public:
    PlotOverlay(const Theme& theme, QWidget* canvas);

    /// \param text  in a bubble beside the point; empty: none
    void setHovered(std::optional<QPointF> position, double radius, const QString& text);
    void setRectangle(std::optional<QRectF> rectangle);
    const QString& text() const { return text_; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void paintBubble(QPainter& painter) const;

    const Theme& theme_;
    std::optional<QPointF> position_;
    double radius_ = 0;
    QString text_;
    std::optional<QRectF> rectangle_;
};

}  // namespace emca::explorer
