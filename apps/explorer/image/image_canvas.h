#pragma once

#include <QWidget>
#include <optional>

#include "image/image_model.h"
#include "image/image_transform.h"

namespace emca::explorer {

class Theme;

/// The picture itself: paints what is visible of it, zooms and pans, says what is under the cursor and what was clicked.
/// Wheel zooms at the cursor; middle button, Space or Ctrl with the left button pan. Image and reference lie at the same
/// place; where both are shown, the line between them is dragged.
class ImageCanvas : public QWidget {
    Q_OBJECT
  public:
    ImageCanvas(const ImageModel& model, Theme& theme, QWidget* parent = nullptr);

    const ImageTransform& transform() const { return transform_; }
    std::optional<Pixel> hovered() const { return hovered_; }
    std::optional<Pixel> marked() const { return marked_; }
    /// The marker that is visible on any background.
    void setMarked(std::optional<Pixel> pixel);

    void fit();
    void zoomTo(double zoom);          ///< about the cursor if it is inside, else about the middle
    void zoomBy(double factor);
    /// Brings a pixel to the middle, large enough to tell it from its neighbours.
    void focusOn(Pixel pixel);
    /// Brings a rectangle to the middle, with as much around it as it is large.
    void focusOn(const PixelRect& area);
    /// Where the line of ImageMode::split is, as a share of the widget's width.
    double split() const { return split_; }
    void setSplit(double share);
    QSize sizeHint() const override { return {480, 360}; }

  signals:
    void clicked(emca::Pixel pixel);
    void hoverChanged();
    void zoomChanged();
    void contextMenuWanted(emca::Pixel pixel, QPoint global);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

  private:
    void imageChanged();
    void setHovered(std::optional<Pixel> pixel);
    void changed();
    QPointF zoomAnchor() const;
    void updatePixel(std::optional<Pixel> pixel);
    int splitX() const;                ///< in widget pixels
    bool isOnSplit(QPointF at) const;
    void showCursor(QPointF at);
    // image_canvas_paint.cpp
    void paintSide(QPainter& painter, const QRect& area, const ImagePixels& pixels, const ImageContent& content);
    void paintPicture(QPainter& painter, const QRect& area, const Picture& picture);
    void paintGrid(QPainter& painter, const QRect& area);
    void paintNumbers(QPainter& painter, const QRect& area, const Picture& picture, const Image& values);
    void paintInvalid(QPainter& painter, const InvalidPixels& invalid);
    void paintMarker(QPainter& painter);
    void paintSplit(QPainter& painter);
    void paintTag(QPainter& painter, const QString& text, int x, Qt::Alignment side);
    /// Pixels of an image of this size that intersect an area of the widget.
    PixelRect pixelsIn(const QRect& area, QSize image) const;

    const ImageModel& model_;
    Theme& theme_;
    ImageTransform transform_;
    std::optional<Pixel> hovered_, marked_;
    std::optional<QPointF> panFrom_, pressedAt_;
    double split_ = 0.5;
    bool splitting_ = false;           ///< the line is being dragged
    bool space_ = false;
};

}  // namespace emca::explorer
