#pragma once

#include <QRect>
#include <QString>
#include <QStringList>

class QPainter;
class QColor;
class QFont;

namespace emca::explorer {

class Theme;

/// Width of one number in a column of numbers: the longest that analysis::formatNumber makes, and a gap.
int numberCellWidth(const QFont& font);

/// Paints numbers right-aligned in cells of equal width, so that components stand below each other; then the note.
/// Words for NaN and infinity are in warning colour.
void paintNumbers(QPainter& painter, const QRect& rect, const QStringList& numbers, const QColor& color,
                  const Theme& theme);

}  // namespace emca::explorer
