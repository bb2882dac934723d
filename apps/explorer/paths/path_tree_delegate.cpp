#include "paths/path_tree_delegate.h"

#include <QPainter>

#include "base/theme.h"
#include "paths/path_tree_model.h"
#include "paths/swatch.h"
#include "paths/value_cells.h"

namespace emca::explorer {
namespace {

using Kind = PathTreeModel::Node::Kind;

/// Draws one line, cut with "…" where the room ends. Returns where it ended.
int drawText(QPainter& painter, const QRect& rect, const QString& text, const QFont& font, const QColor& color) {
    painter.setFont(font);
    painter.setPen(color);
    const QFontMetrics metrics(font);
    const QString shown = metrics.elidedText(text, Qt::ElideRight, rect.width());
    painter.drawText(rect, Qt::AlignLeft | Qt::AlignVCenter, shown);
    return rect.left() + metrics.horizontalAdvance(shown);
}

}  // namespace

PathTreeDelegate::PathTreeDelegate(Theme& theme, QObject* parent)
    : QStyledItemDelegate(parent), theme_(theme), mapper_(theme.toneMap()) {
    connect(&theme_, &Theme::toneMapChanged, this, [this] { mapper_ = analysis::ToneMapper(theme_.toneMap()); });
}

QSize PathTreeDelegate::sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const { return {80, Spacing::row}; }

void PathTreeDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
    paintRowBackground(*painter, option);

    painter->save();
    const QRect rect = option.rect.adjusted(Spacing::tiny, 0, -Spacing::tiny, 0);
    if (index.column() == PathTreeModel::kItem) {
        paintItem(*painter, rect, index);
    } else if (index.column() == PathTreeModel::kValue) {
        paintValue(*painter, rect, index);
    } else if (const QVariant color = index.data(PathTreeModel::kColorRole); color.isValid()) {
        paintSwatch(*painter, QRect(rect.left(), rect.center().y() - 7, qMin(rect.width(), 44), 15),
                    color.value<Color>(), mapper_, theme_);
    }
    painter->restore();
}

void PathTreeDelegate::paintItem(QPainter& painter, const QRect& rect, const QModelIndex& index) const {
    const ThemeColors& c = theme_.colors();
    const auto kind = Kind(index.data(PathTreeModel::kNodeKindRole).toInt());
    const QString text = index.data(Qt::DisplayRole).toString();
    const bool leaf = kind >= Kind::infoEntry;
    const bool quiet = leaf || kind == Kind::infoGroup || kind == Kind::dataGroup;
    if (leaf && !highlight_.isEmpty()) {
        const int at = text.indexOf(highlight_, 0, Qt::CaseInsensitive);
        if (at >= 0) {
            const QFontMetrics metrics(theme_.font());
            const int left = rect.left() + metrics.horizontalAdvance(text.left(at));
            QColor mark = c.accent;
            mark.setAlphaF(0.3);
            painter.fillRect(QRect(left, rect.top() + 4, metrics.horizontalAdvance(text.mid(at, highlight_.size())),
                                   rect.height() - 8),
                             mark);
        }
    }
    const int end = drawText(painter, rect, text, theme_.font(), quiet ? c.mutedText : c.text);
    const QString note = index.data(PathTreeModel::kNoteRole).toString();
    if (!note.isEmpty()) {
        const QRect room(end + Spacing::medium, rect.top(), rect.right() - end - Spacing::medium, rect.height());
        if (room.width() > 30) drawText(painter, room, note, theme_.smallFont(), c.mutedText);
    }
}

void PathTreeDelegate::paintValue(QPainter& painter, const QRect& rect, const QModelIndex& index) const {
    const ThemeColors& c = theme_.colors();
    const auto kind = Kind(index.data(PathTreeModel::kNodeKindRole).toInt());
    const auto tone = Tone(index.data(PathTreeModel::kToneRole).toInt());
    const QStringList numbers = index.data(PathTreeModel::kNumbersRole).toStringList();
    if (numbers.isEmpty()) {
        const bool quiet = kind != Kind::infoEntry && kind != Kind::dataEntry && kind != Kind::vertexEntry;
        drawText(painter, rect, index.data(Qt::DisplayRole).toString(), theme_.numberFont(),
                 quiet ? c.mutedText : c.text);
        return;
    }
    paintNumbers(painter, rect, numbers, c.text, theme_);
    const QString note = index.data(PathTreeModel::kNoteRole).toString();
    if (note.isEmpty()) return;
    const int left = rect.left() + numbers.size() * numberCellWidth(theme_.numberFont()) + Spacing::tiny;
    drawText(painter, QRect(left, rect.top(), rect.right() - left, rect.height()), note, theme_.smallFont(),
             toneColor(tone, c, c.mutedText));
}

}  // namespace emca::explorer
