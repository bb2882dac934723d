#include "paths/table_delegate.h"

#include <QPainter>

#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {

void TableDelegate::initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const {
    QStyledItemDelegate::initStyleOption(option, index);
    option->state &= ~QStyle::State_HasFocus;
    option->font = index.column() == 0 ? theme_.font() : theme_.numberFont();
    if (!analysis::isNonFiniteWord(option->text.toStdString())) return;
    for (const auto role : {QPalette::Text, QPalette::HighlightedText})
        option->palette.setColor(role, theme_.colors().warning);
}

void TableDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
    QStyledItemDelegate::paint(painter, option, index);
    if (index.column() == 0 && (option.state & QStyle::State_Selected))
        painter->fillRect(QRect(option.rect.left(), option.rect.top() + 2, 3, option.rect.height() - 4),
                          theme_.colors().selected);
}

}  // namespace emca::explorer
