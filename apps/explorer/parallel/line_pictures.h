#pragma once

#include <QColor>
#include <QImage>
#include <QSizeF>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/path_set.h"

class QPainter;

namespace emca::explorer {

/// Where the lines of all paths cross the axes, in pixels of the canvas.
struct LineField {
    QSizeF canvas;
    std::vector<double> xs;                ///< of the axes, ascending
    std::vector<std::vector<float>> ys;    ///< per axis one per path
    std::size_t lines() const { return ys.empty() ? 0 : ys.front().size(); }
};

/// Up to here each line is drawn; beyond, lines would hide lines and density says more (and is drawn faster).
inline constexpr std::size_t kMostLines = 2048;

/// One line after the other, as shapes: for few lines, and for drawings that keep shapes.
void drawLines(QPainter& painter, const LineField& field, std::span<const Index> paths, const QColor& color, double width);
void drawAllLines(QPainter& painter, const LineField& field, const QColor& color, double width);
/// How opaque a line is drawn where there are so many.
double lineOpacity(std::size_t lines);

/// All lines, or some of them, as a picture of the canvas. Few are drawn one by one, many as density: the more lines
/// pass, the more opaque, by the logarithm of their number. Its devicePixelRatio says how it lies on the canvas.
/// \param paths  nothing: all
QImage linePicture(const LineField& field, std::optional<std::span<const Index>> paths, const QColor& color, double ratio);

/// The path whose line passes a position, within a radius in pixels; of several the nearest, of equally near ones the
/// last.
std::optional<Index> lineAt(const LineField& field, QPointF position, double radius);

}  // namespace emca::explorer
