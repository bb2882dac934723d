#pragma once

#include <QStyledItemDelegate>

#include "emca/analysis/tone_map.h"

namespace emca::explorer {

class Theme;

/// Draws the rows of a PathTreeModel: item with a quiet note, numbers in aligned cells, swatches as the image
/// shows the colours.
class PathTreeDelegate : public QStyledItemDelegate {
    Q_OBJECT
  public:
    PathTreeDelegate(Theme& theme, QObject* parent);

    /// Part of keys that is emphasised; empty: none.
    void setHighlight(const QString& text) { highlight_ = text; }

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

  private:
    void paintItem(QPainter& painter, const QRect& rect, const QModelIndex& index) const;
    void paintValue(QPainter& painter, const QRect& rect, const QModelIndex& index) const;

    Theme& theme_;
    analysis::ToneMapper mapper_;
    QString highlight_;
};

}  // namespace emca::explorer
