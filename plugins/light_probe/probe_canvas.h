#pragma once

#include <QImage>
#include <QWidget>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/explorer/plugin_context.h"
#include "probe_vertex.h"
#include "sphere_view.h"

namespace emca::light_probe {

/// How radiance is shown.
struct ProbeStyle {
    analysis::ToneMap toneMap;
    bool falseColor = false;             ///< of luminance
    analysis::ColorMapId map = analysis::ColorMapId::viridis;
    analysis::ValueRange range;
};

/// A mark of each kind of direction, as canvas and switches paint it. \param size  diameter in pixels
void paintDirection(QPainter& painter, QPointF at, DirectionKind kind, double size, const explorer::ThemeColors& colors);

/// The sphere laid flat, with the directions of paths on it. Wheel zooms at the cursor, the middle button or Ctrl with
/// the left one pans, a double click fits. A click on a direction follows it; elsewhere it marks a direction.
class ProbeCanvas : public QWidget {
    Q_OBJECT
  public:
    explicit ProbeCanvas(explorer::PluginContext& context, QWidget* parent = nullptr);

    /// \param probe  null for none
    void setProbe(std::shared_ptr<const probe::LightProbe> probe);
    void setStyle(const ProbeStyle& style);
    /// Zoom and pan stay unless the projection changes.
    void setView(const SphereView& view);
    /// \param normal  its horizon is drawn; 0 for none
    void setDirections(std::vector<Direction> directions, Vec3f normal);
    void setShown(DirectionKind kind, bool shown);
    /// A word in the corner; the picture is dimmed. Empty: it is up to date.
    void setStale(const QString& words);
    void setMarked(std::optional<Vec3f> direction);

    const SphereView& view() const { return view_; }
    const PlaneTransform& transform() const { return transform_; }
    std::optional<Vec3f> hovered() const { return hovered_; }
    std::optional<Vec3f> marked() const { return marked_; }
    const Direction* hoveredDirection() const;
    /// Where a direction is painted, in widget coordinates; nothing if it is not on this projection.
    std::optional<QPointF> positionOf(Vec3f direction) const;
    void fit();
    void focusOn(Vec3f direction);
    QSize sizeHint() const override { return {344, 200}; }
    QSize minimumSizeHint() const override { return {160, 100}; }

  signals:
    void hoverChanged();
    void directionClicked(const emca::light_probe::Direction& direction);
    void markedByHand();

  protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void colourPixels();
    void projectPicture();
    void moved();
    void paintHorizon(QPainter& painter);
    void paintDirections(QPainter& painter);
    void paintMarked(QPainter& painter);
    void paintStale(QPainter& painter);
    std::optional<std::size_t> directionAt(QPointF widget) const;
    void setHovered(std::optional<QPointF> widget);

    explorer::PluginContext& context_;
    std::shared_ptr<const probe::LightProbe> probe_;
    ProbeStyle style_;
    SphereView view_;
    PlaneTransform transform_;
    std::vector<std::uint32_t> colors_;   ///< of each pixel of the probe, as QImage's ARGB32
    QImage picture_;                      ///< of the widget's size; null: to be made
    std::vector<Direction> directions_;
    Vec3f normal_;
    std::array<bool, kDirectionKinds> shown_;
    QString stale_;
    std::optional<Vec3f> hovered_, marked_;
    std::optional<std::size_t> hoveredDirection_;
    std::optional<QPointF> panFrom_, pressedAt_;
};

}  // namespace emca::light_probe
