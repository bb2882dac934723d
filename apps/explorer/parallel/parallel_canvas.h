#pragma once

#include <QImage>
#include <QWidget>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "parallel/line_pictures.h"
#include "parallel/parallel_frame.h"

namespace emca::explorer {

class Theme;

/// Draws parallel axes and has their hands. Knows no Selection: what is chosen, its owner says.
/// Mouse: a drag along an axis marks an interval (Shift adds one); a drag of a mark moves it, of its end resizes it, a
/// click on it takes it away; a click on a line chooses its path; a drag of an axis' title moves the axis. Keys: Left and
/// Right choose an axis, with Shift they move it, L log, I upside down, Delete removes, Esc clears.
class ParallelCanvas : public QWidget {
    Q_OBJECT
  public:
    /// \param axes  those that are shown; outlive the canvas, which changes their order, scales and brushes
    ParallelCanvas(ParallelAxes& axes, Theme& theme, QWidget* parent = nullptr);

    /// Other paths or axes.
    void reload();
    /// \param paths  ascending
    void setSelected(std::vector<Index> paths, std::optional<Index> current);
    /// Marked by another view or by the mouse in it.
    void setHovered(std::optional<Index> path);
    void setDescription(std::function<QString(Index)> description) { description_ = std::move(description); }
    /// Pictures and drawings: no chips, rings or texts of the mouse.
    void setExporting(bool exporting) { exporting_ = exporting; }

    const ParallelFrame& frame() const { return frame_; }
    const LineField& lines() const { return lines_; }
    std::optional<std::size_t> currentAxis() const;
    void setCurrentAxis(std::optional<std::size_t> axis);
    QString hoverText() const { return bubble_; }
    /// How often all lines were drawn so far; neither selection nor mouse may draw them again.
    std::uint64_t drawnLayers() const { return drawnLayers_; }
    /// Of the small buttons in the header of the axis under the mouse.
    enum class Chip { log, flip, remove };
    QRectF chipRect(std::size_t axis, Chip chip) const;

  signals:
    /// Marks of the axes changed by hand. \param finished  the mouse was released
    void brushed(bool finished);
    void clicked(Index path, Qt::KeyboardModifiers modifiers);
    void hovered(std::optional<Index> path);
    /// Axes were moved, turned, removed or scaled by hand.
    void axesChanged();
    void clearRequested();
    void menuRequested(const QPoint& globalPosition, std::optional<std::size_t> axis, std::optional<Index> path);
    void addRequested();

  public slots:
    void toggleLog(std::size_t axis);
    void toggleFlipped(std::size_t axis);
    void removeAxis(std::size_t axis);
    void moveAxis(std::size_t from, std::size_t to);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

  private:
    enum class Drag { none, pressed, brush, moveBrush, lowerEnd, upperEnd, axis };
    void layoutFrame();
    void placeLines();
    void forgetPictures();
    // parallel_paint.cpp
    void paintLines(QPainter& painter);
    void paintAxis(QPainter& painter, std::size_t i, double x) const;
    void paintTicks(QPainter& painter, std::size_t i, double x) const;
    void paintRows(QPainter& painter, std::size_t i, double x) const;
    void paintHeader(QPainter& painter, std::size_t i, double x) const;
    void paintChips(QPainter& painter, std::size_t i) const;
    void paintBrushes(QPainter& painter, std::size_t i) const;
    void paintHovered(QPainter& painter) const;
    void paintHoveredDots(QPainter& painter) const;
    void label(QPainter& painter, QPointF at, const QString& text, const QColor& color) const;
    // parallel_mouse.cpp
    struct BrushHit {
        std::size_t axis = 0, brush = 0;
        Drag part = Drag::moveBrush;
    };
    std::optional<BrushHit> brushAt(QPointF position) const;
    std::optional<std::pair<std::size_t, Chip>> chipAt(QPointF position) const;
    void dragBrush(QPointF position);
    void dropAxis(QPointF position);
    void clickAt(QPointF position, Qt::KeyboardModifiers modifiers);
    void hoverAt(std::optional<QPointF> position);
    void showCursor(QPointF position);
    QString textAt(QPointF position) const;

    ParallelAxes& axes_;
    Theme& theme_;
    ParallelFrame frame_;
    LineField lines_;
    std::function<QString(Index)> description_;
    std::vector<Index> selected_;
    std::optional<Index> current_, hovered_;
    std::optional<std::size_t> currentAxis_, hoveredAxis_;
    QPointF mouse_;
    QString bubble_;
    bool exporting_ = false;

    Drag drag_ = Drag::none;
    std::size_t dragAxis_ = 0, dragBrush_ = 0;
    bool dragAdds_ = false;
    std::vector<query::Brush> before_;    ///< brushes of the axis when the drag began
    QPointF pressedAt_;
    QRectF grabbed_;                      ///< where the brush that is moved was

    // As drawn last. What is chosen or hovered draws none of the others again.
    struct Pictures {
        QImage all, marked;
        bool allFresh = false, markedFresh = false;
    } pictures_;
    std::uint64_t drawnLayers_ = 0;
};

}  // namespace emca::explorer
