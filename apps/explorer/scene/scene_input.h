#pragma once

#include <QObject>
#include <QPoint>
#include <QPointF>
#include <QRectF>

#include <functional>
#include <optional>

#include "camera_driver.h"

class QMouseEvent;
class QWheelEvent;
class QWidget;

namespace emca::explorer {

/// Mouse and keys of the 3D view. Left drag orbits, middle or shift-left drag pans, right drag and wheel zoom; a press
/// without a drag is a click. `R` makes the next left drag a rectangle. Arrow keys and W A S D fly, E Q and page keys up and
/// down, Shift four times as fast. Sees the canvas' events before VTK does.
class SceneInput : public QObject {
    Q_OBJECT
  public:
    SceneInput(QWidget& canvas, CameraDriver& driver);

    void setPivot(std::function<Vec3d()> pivot) { pivot_ = std::move(pivot); }
    void setUpAxis(Vec3d axis) { upAxis_ = axis; }
    bool rectangleMode() const { return rectangleMode_; }
    void setRectangleMode(bool on);

  signals:
    void clicked(QPointF at, Qt::KeyboardModifiers modifiers);
    void doubleClicked(QPointF at);
    void hovered(QPointF at);
    void left();
    void menuRequested(QPointF at, QPoint global);
    void rectangleDragged(QRectF rectangle);      ///< null: none any more
    void rectangleSelected(QRectF rectangle, Qt::KeyboardModifiers modifiers);
    void rectangleModeChanged(bool on);
    void dragging(bool on);
    void focusRequested();
    void resetRequested();
    void backRequested();
    void orthographicRequested();                 ///< the other projection
    void clipRequested();                         ///< the clipping plane on or off
    void pictureRequested();

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    enum class Drag { none, orbit, pan, zoom, rectangle };
    bool press(const QMouseEvent& event);
    bool move(const QMouseEvent& event);
    bool release(const QMouseEvent& event);
    void wheel(const QWheelEvent& event);
    bool key(int key, Qt::KeyboardModifiers modifiers);
    static bool isOwnKey(int key, Qt::KeyboardModifiers modifiers);
    void endDrag();

    QWidget& canvas_;
    CameraDriver& driver_;
    std::function<Vec3d()> pivot_;
    Vec3d upAxis_{0, 1, 0};
    bool rectangleMode_ = false;
    Drag drag_ = Drag::none;
    Qt::MouseButton button_ = Qt::NoButton;
    bool moved_ = false;
    QPointF pressed_, last_;
    std::optional<qint64> lastWheel_;
};

}  // namespace emca::explorer
