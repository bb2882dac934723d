#include "base/table_text.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QSaveFile>
#include <QTableView>
#include <QToolTip>
#include <QTreeView>
#include <algorithm>
#include <vector>

namespace emca::explorer {
namespace {

QStringList cellsOf(const QVariant& full, const QVariant& shown) {
    if (!full.isValid()) return {shown.toString()};
    return full.userType() == QMetaType::QStringList ? full.toStringList() : QStringList{full.toString()};
}

QString joined(QStringList cells, TableFormat format) {
    for (QString& cell : cells) {
        if (format == TableFormat::tabs) {
            cell.replace('\t', ' ').replace('\n', ' ').remove('\r');
        } else if (cell.contains(',') || cell.contains('"') || cell.contains('\n') || cell.contains('\r')) {
            cell = '"' + cell.replace('"', QStringLiteral("\"\"")) + '"';
        }
    }
    return cells.join(format == TableFormat::tabs ? '\t' : ',') + '\n';
}

/// Rows in the order on screen: columns as they are shown, and what is open below them.
class Rows {
  public:
    Rows(const QAbstractItemView& view, TableFormat format, bool selectedOnly)
        : view_(view), model_(*view.model()), format_(format), tree_(qobject_cast<const QTreeView*>(&view)) {
        const auto* table = qobject_cast<const QTableView*>(&view);
        const QHeaderView* header = table ? table->horizontalHeader() : tree_ ? tree_->header() : nullptr;
        for (int i = 0; i < model_.columnCount(view.rootIndex()); ++i) {
            const int column = header ? header->logicalIndex(i) : i;
            if (!header || !header->isSectionHidden(column)) columns_.push_back(column);
        }
        only_ = selectedOnly && view.selectionModel() && view.selectionModel()->hasSelection();
    }

    QString text() {
        QStringList names;
        bool named = tree_ || qobject_cast<const QTableView*>(&view_);   // a list has no names but the number of its column
        for (const int column : columns_) {
            const QVariant full = model_.headerData(column, Qt::Horizontal, kCopyRole);
            named |= full.isValid();
            names += cellsOf(full, model_.headerData(column, Qt::Horizontal));
        }
        if (named) text_ += joined(names, format_);
        append(view_.rootIndex(), 0);
        return std::move(text_);
    }

  private:
    void append(const QModelIndex& parent, int level) {
        for (int row = 0; row < model_.rowCount(parent); ++row) {
            const QModelIndex first = model_.index(row, 0, parent);
            if (tree_ && tree_->isRowHidden(row, parent)) continue;
            if (!only_ || isSelected(row, parent)) {
                QStringList cells;
                for (const int column : columns_) {
                    const QModelIndex cell = model_.index(row, column, parent);
                    cells += cellsOf(cell.data(kCopyRole), cell.data(Qt::DisplayRole));
                }
                if (!cells.isEmpty() && level > 0) cells.front().prepend(QString(2 * level, ' '));
                text_ += joined(cells, format_);
            }
            if (tree_ && tree_->isExpanded(first)) append(first, level + 1);
        }
    }
    bool isSelected(int row, const QModelIndex& parent) const {
        return std::any_of(columns_.begin(), columns_.end(),
                           [&](int column) { return view_.selectionModel()->isSelected(model_.index(row, column, parent)); });
    }

    const QAbstractItemView& view_;
    const QAbstractItemModel& model_;
    TableFormat format_;
    const QTreeView* tree_;
    std::vector<int> columns_;
    bool only_ = false;
    QString text_;
};

void copyRows(const QAbstractItemView& view, bool selectedOnly) {
    QApplication::clipboard()->setText(tableText(view, TableFormat::tabs, selectedOnly));
}

void exportRows(QAbstractItemView& view) {
    QString file = QFileDialog::getSaveFileName(&view, QObject::tr("Export table"), QStringLiteral("table.csv"), QObject::tr("CSV values (*.csv)"));
    if (file.isEmpty()) return;
    if (!file.endsWith(QLatin1String(".csv"), Qt::CaseInsensitive)) file += QLatin1String(".csv");
    QSaveFile out(file);
    const bool written = out.open(QIODevice::WriteOnly) && out.write(tableText(view, TableFormat::csv, false).toUtf8()) >= 0 && out.commit();
    if (!written)
        QToolTip::showText(view.mapToGlobal(QPoint(8, 8)),
                           QObject::tr("Could not write \"%1\": %2; choose another folder or name.").arg(file, out.errorString()), &view);
}

class CopyKeys : public QObject {
  public:
    explicit CopyKeys(QAbstractItemView& view) : QObject(&view), view_(view) {
        view.installEventFilter(this);
        if (view.contextMenuPolicy() != Qt::DefaultContextMenu) return;
        view.setContextMenuPolicy(Qt::CustomContextMenu);
        connect(&view, &QWidget::customContextMenuRequested, this, [this](const QPoint& at) {
            QMenu menu(&view_);
            addTableActions(menu, view_);
            menu.exec(view_.viewport()->mapToGlobal(at));
        });
    }

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride) return QObject::eventFilter(watched, event);
        const auto& key = static_cast<QKeyEvent&>(*event);
        const bool all = key.key() == Qt::Key_C && key.modifiers() == (Qt::ControlModifier | Qt::ShiftModifier);
        if (!all && !key.matches(QKeySequence::Copy)) return QObject::eventFilter(watched, event);
        // Qt itself would copy the current cell alone.
        event->accept();
        if (event->type() == QEvent::KeyPress) copyRows(view_, !all);
        return true;
    }

  private:
    QAbstractItemView& view_;
};

}  // namespace

QString tableText(const QAbstractItemView& view, TableFormat format, bool selectedOnly) {
    return view.model() ? Rows(view, format, selectedOnly).text() : QString();
}

QString tabsFromCsv(const QString& csv) {
    QString out;
    out.reserve(csv.size());
    bool quoted = false;
    for (int i = 0; i < csv.size(); ++i) {
        const QChar c = csv[i];
        if (c == '"') {
            if (quoted && i + 1 < csv.size() && csv[i + 1] == '"') out += csv[++i];
            else quoted = !quoted;
        } else if (quoted && (c == '\t' || c == '\n')) {
            out += ' ';
        } else {
            out += !quoted && c == ',' ? QChar('\t') : c;
        }
    }
    return out;
}

void enableTableCopy(QAbstractItemView& view) { new CopyKeys(view); }

void addTableActions(QMenu& menu, QAbstractItemView& view) {
    const bool some = view.selectionModel() && view.selectionModel()->hasSelection();
    menu.addAction(QObject::tr("Copy rows"), &view, [&view] { copyRows(view, true); }, QKeySequence::Copy)->setEnabled(some);
    addTableExport(menu, view);
}

void addTableExport(QMenu& menu, QAbstractItemView& view) {
    menu.addAction(QObject::tr("Copy all rows"), &view, [&view] { copyRows(view, false); }, QKeySequence("Ctrl+Shift+C"));
    menu.addAction(QObject::tr("Export as CSV…"), &view, [&view] { exportRows(view); });
}

}  // namespace emca::explorer
