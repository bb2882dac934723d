#include "paths/vertex_table.h"

#include <QApplication>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>
#include <QTableView>
#include <QToolButton>

#include "base/path_ids.h"
#include "base/state_overlay.h"
#include "base/table_text.h"
#include "base/text_line.h"
#include "base/theme.h"
#include "base/view_keys.h"
#include "paths/path_entries.h"
#include "paths/value_cells.h"
#include "paths/value_rules.h"
#include "paths/vertex_table_delegate.h"
#include "paths/vertex_table_model.h"

namespace emca::explorer {

VertexTable::VertexTable(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent),
      dataset_(dataset),
      selection_(selection),
      model_(new VertexTableModel(this)),
      title_(new TextLine(theme, Qt::AlignLeft, false)),
      back_(new QToolButton),
      forward_(new QToolButton),
      table_(new QTableView),
      overlay_(new StateOverlay(theme, table_)),
      datasetListening_(dataset,
                        [this](std::uint32_t parts) {
                            if (parts & (client::DatasetPart::currentTrace | client::DatasetPart::meshes)) reload();
                        }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & (client::SelectionPart::vertex | client::SelectionPart::currentPath)) reload();
      }) {
    back_->setText(QStringLiteral("‹"));
    back_->setToolTip(tr("Vertex before on the path ( , )"));
    forward_->setText(QStringLiteral("›"));
    forward_->setToolTip(tr("Next vertex on the path ( . )"));
    table_->setModel(model_);
    table_->setItemDelegate(new VertexTableDelegate(theme, this));
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setShowGrid(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->setContextMenuPolicy(Qt::CustomContextMenu);
    enableTableCopy(*table_);   // after the policy: else the table gets a second menu
    table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);  // columns stay where they are, whatever a vertex has
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(Spacing::row);
    table_->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    QHeaderView* header = table_->horizontalHeader();
    header->setHighlightSections(false);
    header->setMinimumSectionSize(60);
    header->resizeSection(VertexTableModel::kQuantity, 150);
    header->resizeSection(VertexTableModel::kPrevious, 160);
    header->setSectionResizeMode(VertexTableModel::kThis, QHeaderView::Stretch);
    header->resizeSection(VertexTableModel::kNext, 160);

    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(Spacing::small, Spacing::tiny, Spacing::small, Spacing::tiny);
    bar->setSpacing(Spacing::tiny);
    bar->addWidget(back_);
    bar->addWidget(forward_);
    bar->addWidget(title_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(table_, 1);
    connect(back_, &QToolButton::clicked, this, &VertexTable::stepBack);
    connect(forward_, &QToolButton::clicked, this, &VertexTable::stepForward);
    connect(table_, &QWidget::customContextMenuRequested, this, &VertexTable::showMenu);
    const auto repaint = [this] { table_->viewport()->update(); };
    connect(&theme, &Theme::themeChanged, this, repaint);
    connect(&theme, &Theme::toneMapChanged, this, repaint);
    setFocusProxy(table_);
    setViewKeys(*table_, tr("Intersection"), {{"Ctrl+C", tr("Copy the table as text")}});
    reload();
}

void VertexTable::reload() {
    const PathSet& paths = dataset_.paths();
    const auto& selected = selection_.state().vertex;
    const std::optional<Index> vertex = selected ? findVertex(paths, *selected) : std::nullopt;
    table_->viewport()->setUpdatesEnabled(vertex.has_value());  // without a vertex, all of it is covered
    model_->setVertex(paths, vertex, meshesOf(dataset_));
    back_->setEnabled(model_->previous().has_value());
    forward_->setEnabled(model_->next().has_value());
    if (vertex) {
        title_->setText(vertexText(paths, *vertex) + QStringLiteral("  –  ") +
                        pathText(paths, paths.pathOf(*vertex), severalPixels(paths)));
        overlay_->clear();
    } else {
        title_->setText({});
        overlay_->showEmpty(tr("Values of a vertex"), paths.empty()
                                                          ? tr("Click a pixel in the image")
                                                          : tr("Click a vertex in the 3D view or in the tree"));
    }
    // These questions let the table and its headers do now what they put off: later, it would all be painted again.
    table_->indexAt(QPoint());
    table_->verticalHeader()->length();
    table_->horizontalHeader()->length();
}

void VertexTable::stepBack() {
    if (const auto vertex = model_->previous()) selection_.setVertex(vertexId(dataset_.paths(), *vertex));
}

void VertexTable::stepForward() {
    if (const auto vertex = model_->next()) selection_.setVertex(vertexId(dataset_.paths(), *vertex));
}

void VertexTable::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    showNeighbours();
}

void VertexTable::showNeighbours() {
    // Neighbours only where the vertex's own colours keep their room.
    QHeaderView* header = table_->horizontalHeader();
    const int own = 3 * numberCellWidth(table_->font()) + 60;
    const bool room = width() >= own + header->sectionSize(VertexTableModel::kQuantity) + 2 * 150;
    table_->setColumnHidden(VertexTableModel::kPrevious, !room);
    table_->setColumnHidden(VertexTableModel::kNext, !room);
}

void VertexTable::showMenu(const QPoint& position) {
    const QModelIndex index = table_->indexAt(position);
    QMenu menu(this);
    if (index.isValid() && index.column() != VertexTableModel::kQuantity) {
        const QString full = model_->cell(index.row(), VertexTableModel::Column(index.column())).full;
        menu.addAction(tr("Copy value"), this, [full] { QApplication::clipboard()->setText(full); })
            ->setEnabled(!full.isEmpty());
    }
    if (index.isValid()) {
        // On its name, a quantity means the value of the vertex itself.
        const auto column = index.column() == VertexTableModel::kQuantity ? VertexTableModel::kThis : VertexTableModel::Column(index.column());
        const std::optional<Entry> entry = model_->entry(index.row(), column);
        const std::optional<Index> vertex = model_->vertexOf(column);
        addFilterMenu(menu, entry ? rulesFor(dataset_.paths(), *entry) : vertex ? rulesForVertex(dataset_.paths(), *vertex) : std::vector<ValueRule>(),
                      [this](const query::Rule& rule) { emit filterWanted(rule); });
        menu.addSeparator();
    }
    addTableActions(menu, *table_);
    menu.exec(table_->viewport()->mapToGlobal(position));
}

}  // namespace emca::explorer
