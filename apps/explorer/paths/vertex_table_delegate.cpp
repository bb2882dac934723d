#include "paths/vertex_table_delegate.h"

#include <QPainter>

#include "base/theme.h"
#include "paths/swatch.h"
#include "paths/value_cells.h"
#include "paths/vertex_table_model.h"

namespace emca::explorer {
namespace {

constexpr int kSwatchWidth = 36;

}  // namespace

VertexTableDelegate::VertexTableDelegate(Theme& theme, QObject* parent)
    : QStyledItemDelegate(parent), theme_(theme), mapper_(theme.toneMap()) {
    connect(&theme_, &Theme::toneMapChanged, this, [this] { mapper_ = analysis::ToneMapper(theme_.toneMap()); });
}

void VertexTableDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
    const auto& model = static_cast<const VertexTableModel&>(*index.model());
    const ThemeColors& c = theme_.colors();
    paintRowBackground(*painter, option);
    painter->save();
    QRect rect = option.rect.adjusted(Spacing::small, 0, -Spacing::tiny, 0);
    const auto text = [&](const QRect& room, const QString& string, const QFont& font, const QColor& color) {
        painter->setFont(font);
        painter->setPen(color);
        painter->drawText(room, Qt::AlignLeft | Qt::AlignVCenter,
                          QFontMetrics(font).elidedText(string, Qt::ElideRight, room.width()));
    };
    if (index.column() == VertexTableModel::kQuantity) {
        text(rect, model.quantity(index.row()), theme_.font(), c.mutedText);
        painter->restore();
        return;
    }
    const VertexTableModel::Cell& cell = model.cell(index.row(), VertexTableModel::Column(index.column()));
    const bool own = index.column() == VertexTableModel::kThis;
    if (own && cell.color) {
        paintSwatch(*painter, QRect(rect.right() - kSwatchWidth, rect.center().y() - 7, kSwatchWidth, 15), *cell.color,
                    mapper_, theme_);
        rect.setRight(rect.right() - kSwatchWidth - Spacing::tiny);
    }
    if (!cell.present) {
        text(rect, QStringLiteral("–"), theme_.smallFont(), c.mutedText);
    } else if (cell.value.numbers.isEmpty()) {
        text(rect, cell.value.text, own ? theme_.numberFont() : theme_.smallNumberFont(), own ? c.text : c.mutedText);
    } else if (own) {
        paintNumbers(*painter, rect, cell.value.numbers, c.text, theme_);
        const int used = cell.value.numbers.size() * numberCellWidth(theme_.numberFont());
        text(rect.adjusted(used, 0, 0, 0), cell.value.note, theme_.smallFont(), toneColor(cell.tone, c, c.mutedText));
    } else {
        text(rect, cell.value.numbers.join(QStringLiteral("  ")), theme_.smallNumberFont(),
             cell.tone == Tone::warning ? c.warning : c.mutedText);
    }
    painter->restore();
}

}  // namespace emca::explorer
