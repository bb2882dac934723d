#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <optional>

#include "emca/core/pixel.h"

namespace emca::explorer {

/// How an image lies in a widget. Image coordinates: (0, 0) is the top-left corner of the top-left pixel, a pixel is one
/// unit wide. Widget coordinates: device-independent pixels.
class ImageTransform {
  public:
    static constexpr double kMinimumZoom = 1.0 / 32, kMaximumZoom = 256;

    double zoom() const { return zoom_; }             ///< widget pixels per image pixel
    bool fitted() const { return fitted_; }           ///< follows the widget's size
    QPointF toWidget(QPointF image) const { return origin_ + image * zoom_; }
    QPointF toImage(QPointF widget) const { return (widget - origin_) / zoom_; }
    QRectF toWidget(const QRectF& image) const { return {toWidget(image.topLeft()), image.size() * zoom_}; }
    std::optional<Pixel> pixelAt(QPointF widget) const;
    QRectF rectOf(Pixel pixel) const { return toWidget(QRectF(pixel.x, pixel.y, 1, 1)); }

    /// An image of another size keeps zoom and place, pixel on pixel, if it was zoomed and the middle of the widget lies in
    /// it; else all of it is shown.
    void setImageSize(QSizeF size);
    void setWidgetSize(QSizeF size);
    /// The whole image, as large as the widget allows, centred; at whole multiples where it is magnified.
    void fit();
    /// The image point at `anchor` stays there.
    void zoomTo(double zoom, QPointF anchor);
    void pan(QPointF byWidgetPixels);
    /// The middle of the pixel goes to the middle of the widget.
    void centre(Pixel pixel);

  private:
    /// At least a corner of the image stays in sight, and the origin falls on whole widget pixels.
    void keepInSight();
    QSizeF image_{0, 0}, widget_{0, 0};
    QPointF origin_;
    double zoom_ = 1;
    bool fitted_ = true;
};

}  // namespace emca::explorer
