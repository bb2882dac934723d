#pragma once

#include <QString>

#include "emca/core/result.h"

class QWidget;

namespace emca::explorer {

/// Writes a picture of a widget: SVG by the ending .svg (with text and points as vectors), else pixels at twice the
/// size on screen. Errors: fileUnwritable.
Result<void> exportPicture(QWidget& widget, const QString& file);
/// Errors: fileUnwritable.
Result<void> exportText(const QString& text, const QString& file);

}  // namespace emca::explorer
