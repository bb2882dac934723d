#pragma once

#include <QRect>
#include <QString>
#include <QStringList>

#include "paths/path_entries.h"

class QPainter;
class QColor;
class QFont;
class QStyleOptionViewItem;

namespace emca::explorer {

class Theme;
struct ThemeColors;

/// Width of one number in a column of numbers: the longest that analysis::formatNumber makes, and a gap.
int numberCellWidth(const QFont& font);

/// Paints numbers right-aligned in cells of equal width, so that components stand below each other; then the note.
/// Words for NaN and infinity are in warning colour.
void paintNumbers(QPainter& painter, const QRect& rect, const QStringList& numbers, const QColor& color,
                  const Theme& theme);

/// The colour that a value is written in; `normal` where it has no meaning of its own.
QColor toneColor(Tone tone, const ThemeColors& colors, const QColor& normal);

/// What lies behind a cell (selection, hover), without the frame of the keyboard's focus.
void paintRowBackground(QPainter& painter, const QStyleOptionViewItem& option);

}  // namespace emca::explorer
