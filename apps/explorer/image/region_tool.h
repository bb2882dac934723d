#pragma once

#include <QLineF>
#include <QPointF>
#include <QSize>
#include <QWidget>
#include <optional>
#include <vector>

#include "base/listeners.h"

namespace emca::explorer {

class ImageCanvas;
class Theme;

/// Several pixels of the image as one selection. Lies over the canvas, shows the region's outline and the pixel of the
/// current path, and watches the canvas' mouse and keys:
///   Shift with the left button, or the left button in rectangle mode: drag a rectangle; Ctrl besides adds to the region;
///   Shift and a click: the rectangle from the pixel before to this one; Ctrl and a click: this pixel too, or no longer;
///   Shift and an arrow key: one column or row more or less.
/// Everything else stays with the canvas.
class RegionTool : public QWidget {
    Q_OBJECT
  public:
    /// \param canvas  becomes the parent; shows the Dataset's current image
    RegionTool(const client::Dataset& dataset, ImageCanvas& canvas, client::Selection& selection, Theme& theme);

    /// The next drag with the left button is a rectangle; ends with it.
    bool rectangleMode() const { return rectangleMode_; }
    void setRectangleMode(bool on);
    /// A rectangle is being drawn.
    bool isDragging() const { return from_.has_value(); }

  signals:
    void rectangleModeChanged(bool on);
    /// A person chose the region that is now selected.
    void chosen();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    /// Width and height; 0 without an image.
    QSize imageSize() const;
    bool press(const QMouseEvent& event);
    bool release(const QMouseEvent& event);
    bool key(const QKeyEvent& event);
    void endDrag();
    void choose(const PixelRect& rect, bool add);
    /// Between two points of the widget; empty if the image is not touched.
    PixelRect rectOf(QPointF a, QPointF b) const;
    std::optional<Pixel> anchor() const;
    void selectionChanged(std::uint32_t parts);
    void setMark(std::optional<Pixel> pixel, std::optional<Pixel>& mark);
    void paintOutline(QPainter& painter, const std::vector<QLineF>& lines, const QRectF& bounds) const;
    void paintMark(QPainter& painter, Pixel pixel, const QColor& color) const;
    void paintSize(QPainter& painter, const PixelRect& rect) const;

    const client::Dataset& dataset_;
    ImageCanvas& canvas_;
    client::Selection& selection_;
    Theme& theme_;
    bool rectangleMode_ = false;
    std::optional<QPointF> from_, ctrlFrom_;
    QPointF to_;
    std::optional<Pixel> first_, last_;      ///< corners of the rectangle that was drawn last
    std::vector<QLineF> outline_;            ///< of the selected region, in image coordinates
    std::optional<Pixel> current_, hovered_; ///< inside the region: pixels of the current and of the hovered path
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
