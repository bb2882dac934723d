#pragma once

#include <QPointF>
#include <QSizeF>
#include <QRectF>
#include <optional>

#include "emca/probe/sphere_map.h"

namespace emca::light_probe {

/// How a sphere is laid flat.
enum class Projection {
    latitudeLongitude,   ///< as SphereMap
    hemispheres,         ///< two discs, equal areas (Lambert): left around the pole, right around its opposite
    upperHemisphere,     ///< the first of the two
};

/// Between directions and a plane: (0, 0) to size(), one unit is the height. Discs are as a person sees them who looks
/// along the pole, or against it, with `forward` up: not mirrored.
/// Source of the discs: Lambert's azimuthal equal-area projection, r = sqrt(2) sin(theta / 2).
class SphereView {
  public:
    SphereView() : SphereView(probe::SphereFrame(), Projection::latitudeLongitude) {}
    SphereView(const probe::SphereFrame& frame, Projection projection) : map_(frame, 2, 1), projection_(projection) {}

    const probe::SphereFrame& frame() const { return map_.frame(); }
    Projection projection() const { return projection_; }
    QSizeF size() const { return {projection_ == Projection::upperHemisphere ? 1.0 : 2.0, 1.0}; }

    /// Nothing beside the discs.
    std::optional<Vec3f> direction(QPointF plane) const;
    /// Nothing for directions that the projection does not show.
    std::optional<QPointF> plane(Vec3f direction) const;

  private:
    probe::SphereMap map_;
    Projection projection_;
};

/// Where a plane lies in a widget: zoom and pan.
class PlaneTransform {
  public:
    static constexpr double kLargestZoom = 64;
    void setSizes(QSizeF plane, QSizeF widget);
    void fit();
    /// \param factor  the plane's point at `anchor` (widget) stays there
    void zoomBy(double factor, QPointF anchor);
    void pan(QPointF by);
    void centre(QPointF plane);
    double zoom() const { return zoom_; }             ///< 1: the whole plane fits
    double scale() const { return fitted_ * zoom_; }  ///< widget pixels per unit
    QPointF toWidget(QPointF plane) const { return origin_ + plane * scale(); }
    QPointF toPlane(QPointF widget) const { return (widget - origin_) / scale(); }
    QRectF area() const { return {origin_, plane_ * scale()}; }

  private:
    void keepInSight();
    QSizeF plane_{2, 1}, widget_{1, 1};
    double fitted_ = 1, zoom_ = 1;
    QPointF origin_;
};

}  // namespace emca::light_probe
