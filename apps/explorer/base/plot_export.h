#pragma once

#include <QString>
#include <functional>

#include "emca/core/result.h"

class QEvent;
class QKeyEvent;
class QMenu;
class QWidget;

namespace emca::explorer {

/// What every plot offers: pictures, drawings and its data, by menu and by key (Ctrl+Shift+P asks where to, Ctrl+C copies the
/// data, in columns that a spreadsheet takes).
struct PlotExport {
    QWidget* view = nullptr;                   ///< in front of it the dialog appears
    QWidget* picture = nullptr;                ///< what pictures show
    QString name;                              ///< of the file that is suggested, without ending
    std::function<void(bool)> setExporting;    ///< around each picture: a cursor has no place in it. Or empty
    std::function<QString()> csv;              ///< data, with a line of names
    std::function<void(const QString&)> say;   ///< a sentence for the status bar
};
/// "Copy values", "Copy picture" and the submenu "Export".
void addExportActions(QMenu& menu, const PlotExport& plot);
/// PNG, SVG or CSV by the ending of the name. \param scale  pixels of a PNG per pixel on screen. Errors: fileUnwritable.
Result<void> writeExport(const PlotExport& plot, const QString& file, int scale);
/// One dialog for all formats; what fails is said.
void askForExport(const PlotExport& plot);
/// Values to the clipboard, with tabs between them.
void copyValues(const PlotExport& plot);
/// Ctrl+Shift+P and Ctrl+C. Returns whether it was one of them.
bool handleExportKeys(const QKeyEvent& event, const PlotExport& plot);
/// For QWidget::event: accepts the question whether a shortcut of the window is wanted here as a key. Copying belongs to the
/// plot that has the focus, whatever the window uses its keys for.
bool claimExportKeys(QEvent& event);

}  // namespace emca::explorer
