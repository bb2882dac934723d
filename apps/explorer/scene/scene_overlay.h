#pragma once

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QString>
#include <QWidget>

#include <optional>
#include <utility>
#include <vector>

#include "base/theme.h"

class QPainter;

namespace emca::explorer {

/// What is written over the 3D view; positions in pixels of the view.
struct OverlayContent {
    struct Label { QPointF at; QString text; bool strong = false; };
    enum class Mark { line, dashes, dot, square, ramp };
    struct LegendEntry {
        QString text;
        QColor color;
        Mark mark = Mark::line;
        std::vector<QColor> ramp;       ///< of Mark::ramp: from low to high
    };
    struct Axis { QPointF to; double towardsEye = 0; QColor color; QString name; };   ///< `to`: in units of its length
    struct Card { QPointF at; QString title; std::vector<std::pair<QString, QString>> rows; };

    std::vector<Label> labels;          ///< depth numbers beside vertices; strong ones first
    std::optional<QPointF> ring;        ///< around the hovered vertex: here, so that hovering needs no new frame
    std::vector<LegendEntry> legend;    ///< bottom left
    std::vector<Axis> axes;             ///< of the world, top right
    QString caption;                    ///< bottom right: what is left out of the picture
    QString hint;                       ///< top middle: what to do now
    std::optional<Card> card;           ///< beside the cursor
    std::optional<QRectF> rectangle;    ///< being dragged
};

/// Labels that would cover an earlier one are left out.
void paintOverlay(QPainter& painter, QSizeF size, const OverlayContent& content, const Theme& theme);

/// Transparent widget that paints it and lets the mouse through.
class SceneOverlay : public QWidget {
    Q_OBJECT
  public:
    SceneOverlay(Theme& theme, QWidget* parent);
    OverlayContent content;   ///< call update() after a change

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    Theme& theme_;
};

}  // namespace emca::explorer
