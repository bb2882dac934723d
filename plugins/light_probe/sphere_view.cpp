#include "sphere_view.h"

#include <algorithm>
#include <cmath>

namespace emca::light_probe {

std::optional<Vec3f> SphereView::direction(QPointF plane) const {
    if (!(plane.x() >= 0 && plane.y() >= 0 && plane.x() <= size().width() && plane.y() <= 1)) return std::nullopt;
    if (projection_ == Projection::latitudeLongitude) return map_.direction({plane.x(), plane.y()});
    const bool below = plane.x() > 1;
    // Right and up on the disc, in [-1, 1].
    const double x = 2 * (plane.x() - (below ? 1 : 0)) - 1, y = 1 - 2 * plane.y();
    const double r2 = x * x + y * y;
    if (r2 > 1) return std::nullopt;
    const double cosTheta = 1 - r2, s = std::sqrt(std::max(0.0, 2 - r2));   // sin(theta) = r s
    return frame().toWorld({y * s, below ? -x * s : x * s, below ? -cosTheta : cosTheta});
}

std::optional<QPointF> SphereView::plane(Vec3f direction) const {
    if (projection_ == Projection::latitudeLongitude) {
        const Vec2d film = map_.film(direction);
        return QPointF(film.x, film.y);
    }
    Vec3d local = normalize(frame().toLocal(direction));
    const bool below = local.z < 0;
    if (below && projection_ == Projection::upperHemisphere) return std::nullopt;
    if (below) local.y = -local.y;
    const double s = std::sqrt(1 + std::abs(local.z));
    const double x = local.y / s, y = local.x / s;
    return QPointF((x + 1) / 2 + (below ? 1 : 0), (1 - y) / 2);
}

void PlaneTransform::setSizes(QSizeF plane, QSizeF widget) {
    if (plane == plane_ && widget == widget_) return;
    const bool other = plane != plane_;
    const QPointF middle = toPlane(QPointF(widget_.width() / 2, widget_.height() / 2));
    plane_ = plane;
    widget_ = widget;
    fitted_ = std::max(1e-6, std::min(widget.width() / plane.width(), widget.height() / plane.height()));
    if (other || zoom_ == 1) fit();
    else centre(middle);
}

void PlaneTransform::fit() {
    zoom_ = 1;
    keepInSight();
}

void PlaneTransform::zoomBy(double factor, QPointF anchor) {
    const QPointF there = toPlane(anchor);
    zoom_ = std::clamp(zoom_ * factor, 1.0, kLargestZoom);
    origin_ = anchor - there * scale();
    keepInSight();
}

void PlaneTransform::pan(QPointF by) {
    origin_ += by;
    keepInSight();
}

void PlaneTransform::centre(QPointF plane) {
    origin_ = QPointF(widget_.width() / 2, widget_.height() / 2) - plane * scale();
    keepInSight();
}

/// A plane that is smaller than the widget is in its middle, a larger one covers it.
void PlaneTransform::keepInSight() {
    const auto kept = [](double origin, double size, double room) {
        return size <= room ? (room - size) / 2 : std::clamp(origin, room - size, 0.0);
    };
    origin_ = {kept(origin_.x(), plane_.width() * scale(), widget_.width()), kept(origin_.y(), plane_.height() * scale(), widget_.height())};
}

}  // namespace emca::light_probe
