#pragma once

#include <QStyledItemDelegate>

#include "emca/analysis/tone_map.h"

namespace emca::explorer {

class Theme;

/// Draws a VertexTableModel: the vertex's own values in aligned cells with swatches, its neighbours' small and quiet.
class VertexTableDelegate : public QStyledItemDelegate {
    Q_OBJECT
  public:
    VertexTableDelegate(Theme& theme, QObject* parent);
    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;

  private:
    Theme& theme_;
    analysis::ToneMapper mapper_;
};

}  // namespace emca::explorer
