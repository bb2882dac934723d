#pragma once

#include <QStyledItemDelegate>

namespace emca::explorer {

class Theme;

/// Rows of tables of numbers: equal digits, NaN and infinity in warning colour, selected rows with an orange bar.
class TableDelegate : public QStyledItemDelegate {
    Q_OBJECT
  public:
    TableDelegate(Theme& theme, QObject* parent) : QStyledItemDelegate(parent), theme_(theme) {}
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;

  protected:
    void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;

  private:
    Theme& theme_;
};

}  // namespace emca::explorer
