#include "image/image_transform.h"

#include <algorithm>
#include <cmath>

namespace emca::explorer {

std::optional<Pixel> ImageTransform::pixelAt(QPointF widget) const {
    const QPointF at = toImage(widget);
    const double x = std::floor(at.x()), y = std::floor(at.y());
    if (!(x >= 0 && y >= 0 && x < image_.width() && y < image_.height())) return std::nullopt;
    return Pixel{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
}

void ImageTransform::setImageSize(QSizeF size) {
    if (size == image_) return;
    image_ = size;
    const QPointF middle = toImage(QPointF(widget_.width() / 2, widget_.height() / 2));
    if (fitted_ || !QRectF(QPointF(0, 0), size).contains(middle)) fit();
}

void ImageTransform::setWidgetSize(QSizeF size) {
    if (size == widget_) return;
    const QPointF centre = toImage(QPointF(widget_.width() / 2, widget_.height() / 2));
    widget_ = size;
    if (fitted_) {
        fit();
        return;
    }
    origin_ = QPointF(widget_.width() / 2, widget_.height() / 2) - centre * zoom_;
    keepInSight();
}

void ImageTransform::fit() {
    fitted_ = true;
    if (image_.isEmpty() || widget_.isEmpty()) return;
    double zoom = std::min(widget_.width() / image_.width(), widget_.height() / image_.height());
    // Whole multiples keep all pixels equally large, as long as they cost little size.
    if (zoom > 1 && std::floor(zoom) / zoom > 0.85) zoom = std::floor(zoom);
    zoom_ = std::clamp(zoom, kMinimumZoom, kMaximumZoom);
    origin_ = QPointF(std::round((widget_.width() - image_.width() * zoom_) / 2),
                      std::round((widget_.height() - image_.height() * zoom_) / 2));
}

void ImageTransform::zoomTo(double zoom, QPointF anchor) {
    const QPointF fixed = toImage(anchor);
    zoom_ = std::clamp(zoom, kMinimumZoom, kMaximumZoom);
    fitted_ = false;
    origin_ = anchor - fixed * zoom_;
    keepInSight();
}

void ImageTransform::pan(QPointF byWidgetPixels) {
    fitted_ = false;
    origin_ += byWidgetPixels;
    keepInSight();
}

void ImageTransform::centre(Pixel pixel) {
    fitted_ = false;
    origin_ = QPointF(widget_.width() / 2, widget_.height() / 2) - QPointF(pixel.x + 0.5, pixel.y + 0.5) * zoom_;
    keepInSight();
}

void ImageTransform::keepInSight() {
    constexpr double kVisible = 24;
    const double w = image_.width() * zoom_, h = image_.height() * zoom_;
    origin_.setX(std::clamp(origin_.x(), std::min(kVisible - w, 0.0), std::max(widget_.width() - kVisible, 0.0)));
    origin_.setY(std::clamp(origin_.y(), std::min(kVisible - h, 0.0), std::max(widget_.height() - kVisible, 0.0)));
}

}  // namespace emca::explorer
