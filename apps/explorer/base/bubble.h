#pragma once

#include <QPointF>
#include <QSize>
#include <QString>

class QPainter;

namespace emca::explorer {

class Theme;

/// What is under the cursor, in words: a box beside a place of a plot, at its right or, where there is no room, at its left.
/// \param gap  pixels between the place and the box  \param within  the widget, which the box does not leave
void paintBubble(QPainter& painter, const Theme& theme, const QString& text, QPointF at, double gap, QSize within);

}  // namespace emca::explorer
