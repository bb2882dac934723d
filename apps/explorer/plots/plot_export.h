#pragma once

#include <QString>
#include <functional>

#include "emca/core/result.h"

class QKeyEvent;
class QMenu;
class QWidget;

namespace emca::explorer {

/// Writes a picture of a widget: SVG by the ending .svg (with text and points as vectors), else PNG.
/// \param scale  pixels of a PNG per pixel on screen. Errors: fileUnwritable.
Result<void> exportPicture(QWidget& widget, const QString& file, int scale = 2);
/// Errors: fileUnwritable.
Result<void> exportText(const QString& text, const QString& file);

/// What every plot offers: pictures, drawings and its data, by menu and by key (Ctrl+Shift+P asks where to, Ctrl+C copies the
/// data, in columns that a spreadsheet takes).
struct PlotExport {
    QWidget* view = nullptr;                   ///< in front of it the dialog appears
    QWidget* picture = nullptr;                ///< what "Copy picture" shows
    QString name;                              ///< of the file that is suggested, without ending
    /// PNG, SVG or CSV by the ending of the name. \param scale  of PNG
    std::function<Result<void>(const QString& file, int scale)> write;
    std::function<QString()> csv;              ///< data, with a line of names
    std::function<void(const QString&)> say;   ///< a sentence for the status bar
};
/// "Copy values", "Copy picture" and the submenu "Export".
void addExportActions(QMenu& menu, const PlotExport& plot);
/// One dialog for all formats; what fails is said.
void askForExport(const PlotExport& plot);
/// Values to the clipboard, with tabs between them.
void copyValues(const PlotExport& plot);
/// Ctrl+Shift+P and Ctrl+C. Returns whether it was one of them.
bool handleExportKeys(const QKeyEvent& event, const PlotExport& plot);

}  // namespace emca::explorer
