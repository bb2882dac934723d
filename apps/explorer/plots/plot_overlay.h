#pragma once

#include <QRegion>
#include <QWidget>
#include <cstdint>
#include <optional>

namespace emca::explorer {

class Theme;

struct ScatterContent;

/// What changes above the points of a plot: those that are selected, what lies beyond the ranges (arrows and values at
/// the edges, where selected ones come first), the ring around the hovered point, its value, a line at its x, the
/// rectangle being drawn. Apart from the canvas, so that neither a selection nor the mouse draws points again.
class PlotOverlay : public QWidget {
  public:
    PlotOverlay(const ScatterContent& content, const Theme& theme, QWidget* canvas);

    /// What the marks of the selection cover now: paint this anew before and after a change of it.
    QRegion markedRegion() const;

    /// \param text  in a bubble beside the point; empty: none
    void setHovered(std::optional<QPointF> position, double radius, const QString& text);
    void setRectangle(std::optional<QRectF> rectangle);
    const QString& text() const { return text_; }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void paintSelected(QPainter& painter) const;
    void paintCurrent(QPainter& painter) const;
    /// The edge row that a point is in, across the whole canvas; else the room of a dot with its ring.
    QRect roomOf(std::uint32_t point) const;

    const ScatterContent& content_;
    const Theme& theme_;
    std::optional<QPointF> position_;
    double radius_ = 0;
    QString text_;
    std::optional<QRectF> rectangle_;
};

}  // namespace emca::explorer
