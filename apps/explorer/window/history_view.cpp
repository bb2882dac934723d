#include "window/history_view.h"

#include <QListView>
#include <QMenu>
#include <QPainter>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QVBoxLayout>
#include <algorithm>

#include "base/grouped.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/table_text.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "emca/analysis/tone_map.h"
#include "paths/swatch.h"

namespace emca::explorer {
namespace {

constexpr int kRowHeight = 46;

class HistoryDelegate : public QStyledItemDelegate {
  public:
    HistoryDelegate(HistoryModel& model, Theme& theme, QObject* parent) : QStyledItemDelegate(parent), model_(model), theme_(theme) {}
    QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {160, kRowHeight}; }

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const auto trace = model_.trace(index.row());
        if (!trace || trace->pixels.empty()) return;
        const ThemeColors& c = theme_.colors();
        const bool selected = option.state & QStyle::State_Selected, hovered = option.state & QStyle::State_MouseOver;
        painter->fillRect(option.rect, selected ? c.selectedRow : hovered ? c.panel : c.ground);
        const QRect box = option.rect.adjusted(Spacing::medium, 6, -Spacing::medium, -6);
        const HistoryModel::Entry& entry = model_.entry(index.row());
        const ReplayCounts& counts = entry.counts;
        const Replay& replay = entry.replay;
        paintSwatch(*painter, QRect(box.left(), box.top(), 34, box.height()), replay.replayed, analysis::ToneMapper(theme_.toneMap()), theme_);
        const QRect text = box.adjusted(44, 0, 0, 0);
        painter->setFont(theme_.numberFont());
        painter->setPen(c.text);
        painter->drawText(text, Qt::AlignLeft | Qt::AlignTop, entry.name);
        painter->setPen(replay.verdict == Verdict::exact ? c.success : replay.verdict == Verdict::different ? c.warning : c.mutedText);
        painter->drawText(text, Qt::AlignRight | Qt::AlignTop, counts.pixels > 1 && counts.exact > 0 && counts.exact < counts.pixels
                              ? QObject::tr("%1 of %2 exact").arg(counts.exact).arg(counts.pixels)
                              : toQString(name(replay.verdict)));
        painter->setFont(theme_.smallNumberFont());
        painter->setPen(c.mutedText);
        painter->drawText(text, Qt::AlignLeft | Qt::AlignBottom,
                          QStringLiteral("Y %1").arg(toQString(analysis::formatNumber(double(luminance(replay.replayed))))));
        painter->drawText(text, Qt::AlignRight | Qt::AlignBottom,
                          trace->matches ? QObject::tr("%1 of %2 paths").arg(grouped(trace->paths.pathCount()), grouped(trace->matches->paths))
                                         : QObject::tr("%1 paths").arg(grouped(trace->paths.pathCount())));
    }

  private:
    HistoryModel& model_;
    Theme& theme_;
};

}  // namespace

HistoryModel::HistoryModel(client::Dataset& dataset, QObject* parent) : QAbstractListModel(parent), dataset_(dataset) { reload(); }

void HistoryModel::reload() {
    beginResetModel();
    std::vector<Entry> before = std::move(entries_);
    entries_.clear();
    for (const auto& trace : dataset_.traces()) {
        const auto known = std::ranges::find(before, trace, &Entry::trace);
        entries_.push_back(known != before.end() ? std::move(*known) : entryOf(trace));
    }
    endResetModel();
}

HistoryModel::Entry HistoryModel::entryOf(std::shared_ptr<const client::Trace> trace) {
    Entry entry;
    entry.counts = countReplays(trace->replays);
    entry.replay.verdict = entry.counts.worst();
    for (const Replay& one : trace->replays) entry.replay.replayed += one.replayed / float(entry.counts.pixels);
    if (trace->pixels.size() == 1) entry.name = toQString(analysis::formatPixel(trace->pixels.front()));
    else entry.name = toQString(client::PixelRegion(trace->pixels).text());
    entry.trace = std::move(trace);
    return entry;
}

int HistoryModel::rowCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : static_cast<int>(entries_.size()); }

std::shared_ptr<const client::Trace> HistoryModel::trace(int row) const {
    return row >= 0 && row < rowCount() ? entries_[static_cast<std::size_t>(row)].trace : nullptr;
}

QVariant HistoryModel::data(const QModelIndex& index, int role) const {
    const auto held = trace(index.row());
    if (!held || held->pixels.empty()) return {};
    const QString& name = entry(index.row()).name;
    if (role == Qt::DisplayRole) return name;
    if (role == kCopyRole) {
        const Replay& replay = entry(index.row()).replay;   // of a region: mean and worst verdict
        return QStringList{name, QString::number(held->samplesPerPixel), QString::number(held->paths.pathCount()),
                           toQString(analysis::formatFull(replay.replayed.r)), toQString(analysis::formatFull(replay.replayed.g)),
                           toQString(analysis::formatFull(replay.replayed.b)), toQString(emca::name(replay.verdict)),
                           toQString(analysis::formatFull(held->renderSeconds))};
    }
    if (role != Qt::ToolTipRole) return {};
    const QString told = tr("%1: %2 samples per pixel, %3 paths, %4 vertices. The renderer took %5.")
                             .arg(held->pixels.size() == 1 ? tr("Pixel %1").arg(name) : name.left(1).toUpper() + name.mid(1)).arg(held->samplesPerPixel)
                             .arg(grouped(held->paths.pathCount()), grouped(held->paths.vertexCount()),
                                  toQString(analysis::formatDuration(held->renderSeconds)));
    if (!held->matches) return told;
    return told + tr(" Only what a filter takes: %1 of %2 paths.").arg(grouped(held->matches->matched), grouped(held->matches->paths));
}

QVariant HistoryModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (role != kCopyRole) return QAbstractListModel::headerData(section, orientation, role);
    return QStringList{tr("pixel"), tr("samples per pixel"), tr("paths"), tr("red"), tr("green"), tr("blue"), tr("replay"), tr("seconds")};
}

HistoryView::HistoryView(client::Dataset& dataset, client::Selection&, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), model_(new HistoryModel(dataset, this)), list_(new QListView), overlay_(nullptr),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          if (parts & client::DatasetPart::traces) reload();
          if (parts & (client::DatasetPart::traces | client::DatasetPart::currentTrace)) follow();
      }) {
    list_->setModel(model_);
    enableTableCopy(*list_);
    list_->setItemDelegate(new HistoryDelegate(*model_, theme, this));
    list_->setMouseTracking(true);
    list_->setUniformItemSizes(true);
    list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    list_->setContextMenuPolicy(Qt::CustomContextMenu);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(list_);
    overlay_ = new StateOverlay(theme, this);
    connect(list_, &QListView::activated, this, [this](const QModelIndex& i) { emit traceChosen(model_->trace(i.row())); });
    connect(list_, &QListView::clicked, this, [this](const QModelIndex& i) { emit traceChosen(model_->trace(i.row())); });
    connect(list_, &QListView::customContextMenuRequested, this, [this](const QPoint& at) {
        const auto trace = model_->trace(list_->indexAt(at).row());
        if (!trace) return;
        QMenu menu;
        connect(menu.addAction(tr("Show")), &QAction::triggered, this, [this, trace] { emit traceChosen(trace); });
        connect(menu.addAction(tr("Trace again")), &QAction::triggered, this, [this, trace] {
            emit traceChosen(trace);
            emit traceAgainWanted();
        });
        menu.addSeparator();
        addTableActions(menu, *list_);
        menu.exec(list_->viewport()->mapToGlobal(at));
    });
    for (auto signal : {&Theme::themeChanged, &Theme::toneMapChanged})
        connect(&theme, signal, list_->viewport(), qOverload<>(&QWidget::update));
    reload();
    follow();
}

void HistoryView::reload() {
    model_->reload();
    if (dataset_.traces().empty()) overlay_->showEmpty(tr("No pixels yet"), tr("Traced pixels and regions are kept here. Click a pixel in the image."));
    else overlay_->clear();
}

void HistoryView::follow() {
    for (int row = 0; row < model_->rowCount(); ++row) {
        if (dataset_.current().size() != 1 || model_->trace(row) != dataset_.current().front()) continue;
        list_->setCurrentIndex(model_->index(row, 0));
        return;
    }
    list_->clearSelection();
}

}  // namespace emca::explorer
