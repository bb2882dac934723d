#include "window/vertex_view.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QScrollBar>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

#include "base/state_overlay.h"
#include "base/theme.h"
#include "emca/analysis/tone_map.h"
#include "paths/swatch.h"
#include "window/selection_steps.h"

namespace emca::explorer {
namespace {

/// Text as the table has it; colours with their swatch before the numbers; headings as quiet bands.
class DetailDelegate : public QStyledItemDelegate {
  public:
    DetailDelegate(DetailModel& model, Theme& theme, QObject* parent) : QStyledItemDelegate(parent), model_(model), theme_(theme) {}

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const DetailRow& row = model_.rows()[static_cast<std::size_t>(index.row())];
        const ThemeColors& c = theme_.colors();
        const bool selected = option.state & QStyle::State_Selected;
        painter->fillRect(option.rect, selected ? c.selectedRow : row.heading() ? c.panel : c.ground);
        QRect box = option.rect.adjusted(Spacing::medium, 0, -Spacing::small, 0);
        if (index.column() == 1 && row.swatch) {
            QRect swatch(box.left(), box.center().y() - 7, 30, 15);
            analysis::ToneMapper mapper(theme_.toneMap());
            paintSwatch(*painter, swatch, *row.swatch, mapper, theme_);
            box.setLeft(swatch.right() + Spacing::small);
        }
        if (index.column() == 1) box.setLeft(box.left() - Spacing::tiny);
        painter->setFont(row.heading() ? theme_.smallFont() : index.column() == 1 ? theme_.numberFont() : theme_.font());
        painter->setPen(row.heading() || index.column() == 0 ? c.mutedText : row.warning ? c.warning : c.text);
        const QString text = index.data().toString();
        painter->drawText(box, Qt::AlignLeft | Qt::AlignVCenter, painter->fontMetrics().elidedText(text, Qt::ElideRight, box.width()));
    }

  private:
    DetailModel& model_;
    Theme& theme_;
};

}  // namespace

DetailModel::DetailModel(Theme& theme, QObject* parent) : QAbstractTableModel(parent), theme_(theme) {}

void DetailModel::setRows(std::vector<DetailRow> rows) {
    beginResetModel();
    rows_ = std::move(rows);
    endResetModel();
}

int DetailModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : static_cast<int>(rows_.size()); }
int DetailModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : 2; }

QVariant DetailModel::data(const QModelIndex& index, int role) const {
    const DetailRow& row = rows_[static_cast<std::size_t>(index.row())];
    if (role == Qt::DisplayRole) return index.column() == 0 ? row.name : row.value;
    if (role == Qt::ToolTipRole && index.column() == 1) return row.full;
    return {};
}

QVariant DetailModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (role != Qt::DisplayRole || orientation != Qt::Horizontal) return {};
    return section == 0 ? tr("Quantity") : tr("Value");
}

Qt::ItemFlags DetailModel::flags(const QModelIndex& index) const {
    return rows_[static_cast<std::size_t>(index.row())].heading() ? Qt::NoItemFlags : Qt::ItemIsEnabled | Qt::ItemIsSelectable;
}

VertexView::VertexView(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), selection_(selection), theme_(theme), model_(new DetailModel(theme, this)),
      table_(new QTableView), title_(new QLabel), overlay_(nullptr),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          if (parts & (client::DatasetPart::currentTrace | client::DatasetPart::meshes)) reload();
      }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & (client::SelectionPart::currentPath | client::SelectionPart::vertex)) reload();
      }) {
    auto* header = new QHBoxLayout;
    header->setContentsMargins(Spacing::medium, Spacing::tiny, Spacing::small, Spacing::tiny);
    title_->setProperty("role", "title");
    header->addWidget(title_, 1);
    const auto step = [&](const QString& text, const QString& tip, int by) {
        auto* button = new QToolButton;
        button->setText(text);
        button->setToolTip(tip);
        connect(button, &QToolButton::clicked, this, [this, by] { stepVertex(dataset_, selection_, by); });
        header->addWidget(button);
    };
    step(QStringLiteral("‹"), tr("Previous vertex (,)"), -1);
    step(QStringLiteral("›"), tr("Next vertex (.)"), +1);

    table_->setModel(model_);
    table_->setItemDelegate(new DetailDelegate(*model_, theme, this));
    table_->setShowGrid(false);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(Spacing::row);
    table_->horizontalHeader()->hide();
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->setColumnWidth(0, 128);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    table_->setContextMenuPolicy(Qt::CustomContextMenu);
    table_->setWordWrap(false);
    connect(table_, &QTableView::customContextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu;
        connect(menu.addAction(tr("Copy")), &QAction::triggered, this, [this] { copy(false); });
        connect(menu.addAction(tr("Copy table")), &QAction::triggered, this, [this] { copy(true); });
        menu.exec(table_->viewport()->mapToGlobal(at));
    });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(header);
    layout->addWidget(table_, 1);
    overlay_ = new StateOverlay(theme, this);
    for (auto signal : {&Theme::themeChanged, &Theme::toneMapChanged})
        connect(&theme, signal, table_->viewport(), qOverload<>(&QWidget::update));
    reload();
}

QString VertexView::title() const { return title_->text(); }

void VertexView::reload() {
    const PathSet& paths = dataset_.paths();
    const auto path = currentPath(dataset_, selection_);
    const auto vertex = currentVertex(dataset_, selection_);
    const int scroll = table_->verticalScrollBar()->value();
    if (!path) {
        model_->setRows({});
        overlay_->showEmpty(tr("No vertex selected"), paths.empty() ? tr("Click a pixel in the image, then a path.")
                                                                    : tr("Click a vertex in the 3D view or a row of the tree."));
        return;
    }
    overlay_->clear();
    const auto meshes = dataset_.meshes();
    if (vertex) {
        title_->setText(tr("Sample %1 · depth %2 of %3").arg(paths.sample(*path)).arg(paths.depthIndex(*vertex)).arg(paths.depth(*path)));
        model_->setRows(vertexRows(paths, *vertex, meshes ? std::span<const Mesh>(*meshes) : std::span<const Mesh>()));
    } else {
        title_->setText(tr("Sample %1 · whole path").arg(paths.sample(*path)));
        model_->setRows(pathRows(paths, *path));
    }
    table_->clearSpans();
    for (std::size_t i = 0; i < model_->rows().size(); ++i)
        if (model_->rows()[i].heading()) table_->setSpan(static_cast<int>(i), 0, 1, 2);
    table_->verticalScrollBar()->setValue(scroll);
}

void VertexView::copy(bool wholeTable) {
    QStringList lines;
    const auto* chosen = table_->selectionModel();
    for (std::size_t i = 0; i < model_->rows().size(); ++i) {
        const DetailRow& row = model_->rows()[i];
        if (row.heading() || (!wholeTable && !chosen->isRowSelected(static_cast<int>(i), {}))) continue;
        lines += row.name.trimmed() + '\t' + row.full;
    }
    QApplication::clipboard()->setText(lines.join('\n'));
}

}  // namespace emca::explorer
