#pragma once

#include <QAbstractItemModel>
#include <QString>

class QAbstractItemView;
class QMenu;

namespace emca::explorer {

/// What a cell copies as where that is not what it shows: numbers in full, for models that have them. A QStringList is
/// several cells, for lists whose entries say many things; the header has their names under the same role.
inline constexpr int kCopyRole = Qt::UserRole + 64;

enum class TableFormat {
    tabs,   ///< what spreadsheets take from the clipboard; no cell keeps a tab or a line break
    csv,    ///< RFC 4180
};

/// The rows of a table, or of what is open in a tree (one step to the right for each level), below a line with the names
/// of the columns. Hidden columns are left out.
/// \param selectedOnly  only selected rows; all of them if none is
QString tableText(const QAbstractItemView& view, TableFormat format, bool selectedOnly);

/// CSV (RFC 4180) as text with tabs.
QString tabsFromCsv(const QString& csv);

/// Makes a table copy: Ctrl+C copies the selected rows, Ctrl+Shift+C all of them. The view's owner adds the same to its
/// context menu by addTableActions; without a context menu of its own the view gets one.
void enableTableCopy(QAbstractItemView& view);
/// "Copy rows", "Copy all rows", "Export as CSV…".
void addTableActions(QMenu& menu, QAbstractItemView& view);
/// The last two, for views that copy rows in a way of their own.
void addTableExport(QMenu& menu, QAbstractItemView& view);

}  // namespace emca::explorer
