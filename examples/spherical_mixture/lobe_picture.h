#pragma once

#include <QColor>
#include <QImage>
#include <QWidget>
#include <optional>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/explorer/plugin_context.h"
#include "emca/probe/light_probe.h"
#include "von_mises_fisher.h"

namespace mixture {

/// A colour of each lobe that all eyes tell apart. Source: Okabe and Ito, "Color Universal Design", 2008.
QColor lobeColor(std::size_t lobe);

/// What lobes were fitted to above, the mixture below, both in latitudes and longitudes and in the same colours; the lobes
/// as cones that hold half of each.
class LobePicture : public QWidget {
    Q_OBJECT
  public:
    explicit LobePicture(emca::explorer::PluginContext& context, QWidget* parent = nullptr);

    /// \param probe  what the lobes were fitted to; null: the directions
    void show(const emca::probe::SphereFrame& frame, std::vector<Lobe> lobes, std::vector<WeightedDirection> directions,
              const emca::probe::LightProbe* probe);
    using QWidget::show;
    void clear();
    void setCurrent(std::optional<std::size_t> lobe);
    QSize sizeHint() const override { return {340, 360}; }
    QSize minimumSizeHint() const override { return {160, 170}; }

  signals:
    void lobeClicked(std::size_t lobe);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

  private:
    QRectF area(bool below) const;
    QPointF place(const QRectF& area, Vec3d direction) const;
    void paintMap(QPainter& painter, const QRectF& area, const QImage& image, const QString& title);
    void paintCone(QPainter& painter, const QRectF& area, std::size_t lobe);

    emca::explorer::PluginContext& context_;
    emca::probe::SphereMap map_;
    std::vector<Lobe> lobes_;
    std::vector<WeightedDirection> directions_;
    QImage above_, below_;
    std::optional<std::size_t> current_;
};

}  // namespace mixture
