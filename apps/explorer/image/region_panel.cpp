#include "image/region_panel.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QRunnable>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "base/grouped.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "image/region_histogram.h"

namespace emca::explorer {

/// A row of the table: what it says of a channel.
struct RegionStatistic {
    const char* name;
    const char* tip;
    double (*value)(const analysis::ChannelStatistics&);
    bool count;      ///< how many: 0 is nothing to say
};

namespace {

/// Regions up to this many pixels are computed at once: about a millisecond.
constexpr std::size_t kAtOnce = 1u << 14;
constexpr int kPreviewMilliseconds = 500, kQueryMilliseconds = 600;

QString number(double value) { return toQString(analysis::formatNumber(value)); }
QLabel* label(const char* role) {
    auto* made = new QLabel;
    made->setProperty("role", role);
    made->setWordWrap(true);
    return made;
}

QToolButton* toggle(const QString& text, const QString& tip) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setToolTip(tip);
    made->setCheckable(true);
    return made;
}

using Statistic = RegionStatistic;
constexpr Statistic kStatistics[] = {
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "mean"), QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Mean of the finite values"),
     [](const analysis::ChannelStatistics& c) { return c.summary.mean; }, false},
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "variance"),
     QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Variance over the pixels (divided by n - 1), in squared units"),
     [](const analysis::ChannelStatistics& c) { return c.summary.variance; }, false},
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "min"), QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Smallest finite value"),
     [](const analysis::ChannelStatistics& c) { return c.summary.min; }, false},
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "median"), QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Half of the finite values are smaller"),
     [](const analysis::ChannelStatistics& c) { return c.median; }, false},
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "max"), QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Largest finite value"),
     [](const analysis::ChannelStatistics& c) { return c.summary.max; }, false},
    {"NaN", QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Values that are not a number"),
     [](const analysis::ChannelStatistics& c) { return double(c.summary.nan); }, true},
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "infinite"), QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Infinite values"),
     [](const analysis::ChannelStatistics& c) { return double(c.summary.positiveInfinite + c.summary.negativeInfinite); }, true},
    {QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "negative"), QT_TRANSLATE_NOOP("emca::explorer::RegionPanel", "Negative values"),
     [](const analysis::ChannelStatistics& c) { return double(c.negative); }, true},
};

/// A line of the table.
struct Row {
    const Statistic* statistic;
    bool ofReference;
};

/// Counts stand there only where there is something to count.
std::vector<Row> rowsOf(const RegionNumbers& numbers) {
    std::vector<Row> rows;
    for (const Statistic& statistic : kStatistics) {
        const bool any = std::ranges::any_of(numbers.channels, [&](const RegionChannel& channel) { return statistic.value(channel.image) > 0; });
        if (statistic.count && !any) continue;
        rows.push_back({&statistic, false});
        if (numbers.hasReference && !statistic.count) rows.push_back({&statistic, true});
    }
    return rows;
}

}  // namespace

RegionPanel::RegionPanel(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), selection_(selection), theme_(theme), title_(label("title")), about_(label("muted")),
      paths_(label("normal")), warning_(label("warning")), table_(new QTableWidget), histogram_(new RegionHistogram(theme)),
      logValues_(toggle(tr("Log values"), tr("Logarithmic values (L)"))),
      logCounts_(toggle(tr("Log counts"), tr("Logarithmic numbers of pixels: single ones are seen beside thousands"))),
      onlyMatches_(new QCheckBox(tr("only paths that the filter takes"))), trace_(new QPushButton), clear_(new QPushButton(tr("Clear"))),
      overlay_(nullptr),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          using client::DatasetPart;
          if (parts & DatasetPart::currentImage) changed(true);
          else if (parts & DatasetPart::pixels) changed(false);
          if (parts & (DatasetPart::currentTrace | DatasetPart::currentImage)) showPaths();
      }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & (client::SelectionPart::region | client::SelectionPart::pixel)) {
              changed(true);
              showPaths();
          }
      }) {
    pool_.setMaxThreadCount(1);
    later_.setSingleShot(true);
    queryLater_.setSingleShot(true);
    connect(&later_, &QTimer::timeout, this, &RegionPanel::compute);
    connect(&queryLater_, &QTimer::timeout, this, &RegionPanel::tellQuery);
    connect(&theme_, &Theme::themeChanged, this, &RegionPanel::fillTable);
    build();
    showPaths();
}

RegionPanel::~RegionPanel() { pool_.waitForDone(); }

void RegionPanel::build() {
    table_->setObjectName(QStringLiteral("regionTable"));
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionMode(QAbstractItemView::NoSelection);
    table_->setFocusPolicy(Qt::NoFocus);
    table_->setShowGrid(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->setFont(theme_.numberFont());
    table_->verticalHeader()->setDefaultSectionSize(Spacing::row - 4);
    table_->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    table_->verticalHeader()->hide();
    table_->horizontalHeader()->setHighlightSections(false);
    table_->horizontalHeader()->setMinimumSectionSize(48);
    table_->horizontalHeader()->setStyleSheet(QStringLiteral("QHeaderView::section { border: none; }"));
    table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    table_->setContextMenuPolicy(Qt::ActionsContextMenu);
    auto* copyAction = new QAction(tr("Copy table"), table_);
    connect(copyAction, &QAction::triggered, this, &RegionPanel::copy);
    table_->addAction(copyAction);
    onlyMatches_->setToolTip(tr("The renderer replays the region and sends only those paths: so a region may be as large as the image.\n"
                                "What is asked is the query of the filter view."));
    trace_->setProperty("primary", true);
    clear_->setToolTip(tr("Gives the region up (Esc)"));

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::small);
    layout->setSpacing(Spacing::small);
    auto* top = new QHBoxLayout;
    top->addWidget(title_, 1);
    top->addWidget(clear_);
    layout->addLayout(top);
    layout->addWidget(about_);
    layout->addWidget(table_);
    auto* switches = new QHBoxLayout;
    switches->setSpacing(Spacing::tiny);
    auto* caption = label("muted");
    caption->setText(tr("Histogram, W/(sr m²)"));
    switches->addWidget(caption, 1);
    switches->addWidget(logValues_);
    switches->addWidget(logCounts_);
    layout->addLayout(switches);
    layout->addWidget(histogram_, 1);
    layout->addWidget(paths_);
    layout->addWidget(warning_);
    auto* bottom = new QHBoxLayout;
    bottom->addWidget(onlyMatches_, 1);
    bottom->addWidget(trace_);
    layout->addLayout(bottom);
    overlay_ = new StateOverlay(theme_, this);

    connect(logValues_, &QToolButton::clicked, this, &RegionPanel::setLog);
    connect(logCounts_, &QToolButton::clicked, histogram_, &RegionHistogram::setLogCounts);
    connect(onlyMatches_, &QCheckBox::toggled, this, &RegionPanel::tellQuery);
    connect(trace_, &QPushButton::clicked, this, &RegionPanel::traceWanted);
    connect(clear_, &QPushButton::clicked, this, [this] { selection_.setRegion({}); });
}

void RegionPanel::setReference(std::shared_ptr<const RenderedImage> reference, const QString& title) {
    if (reference == reference_ && title == referenceTitle_) return;
    reference_ = std::move(reference);
    referenceTitle_ = title;
    changed(true);
}

void RegionPanel::setFilter(const QString& query) {
    if (query == filter_) return;
    filter_ = query;
    showPaths();
    // Somebody writes: not each letter is a question.
    if (onlyMatches_->isChecked()) queryLater_.start(kQueryMilliseconds);
}

void RegionPanel::tellQuery() {
    queryLater_.stop();
    const QString query = onlyMatches() ? filter_ : QString();
    if (query == told_) return;
    told_ = query;
    emit queryWanted(query);
}

bool RegionPanel::onlyMatches() const { return onlyMatches_->isChecked(); }
void RegionPanel::setOnlyMatches(bool on) { onlyMatches_->setChecked(on); }

void RegionPanel::setTracing(const Tracing& tracing) {
    if (tracing == tracing_) return;
    tracing_ = tracing;
    showPaths();
}

void RegionPanel::setLog(bool log) {
    log_ = log;
    logValues_->setChecked(log);
    changed(true);
}

void RegionPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) compute();
}

void RegionPanel::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy)) copy();
    else QWidget::keyPressEvent(event);
}

/// \param soon  not after a pause, as while an image is being rendered
void RegionPanel::changed(bool soon) {
    stale_ = true;
    if (!isVisible()) return;
    if (soon) compute();
    else if (!later_.isActive()) later_.start(kPreviewMilliseconds);
}

void RegionPanel::compute() {
    const client::ImageEntry* entry = dataset_.currentImage();
    RegionWish wish{entry ? entry->image : nullptr, nullptr, selection_.state().region, log_};
    if (reference_ && wish.image && reference_ != wish.image && reference_->color.width() == wish.image->color.width() &&
        reference_->color.height() == wish.image->color.height())
        wish.reference = reference_;
    const bool preview = entry && entry->preview;
    if (wish == wish_ && computing_) return;
    stale_ = false;
    later_.stop();
    wish_ = wish;
    const std::uint64_t question = ++question_;
    computing_ = false;
    const std::size_t pixels = !wish.image ? 0 : wish.region.empty() ? std::size_t(wish.image->color.width()) * wish.image->color.height() : wish.region.size();
    // A preview is written to by this thread, so that no other may read it; large ones wait until they are complete.
    if (pixels <= kAtOnce || preview) return take(preview && pixels > 16 * kAtOnce ? RegionNumbers() : regionNumbers(wish));
    computing_ = true;
    pool_.start(QRunnable::create([this, question, wish = std::move(wish)] {
        auto found = std::make_shared<RegionNumbers>(regionNumbers(wish));
        QMetaObject::invokeMethod(this, [this, question, found] { if (question == question_) take(std::move(*found)); }, Qt::QueuedConnection);
    }));
}

void RegionPanel::take(RegionNumbers numbers) {
    computing_ = false;
    numbers_ = std::move(numbers);
    histogram_->show(numbers_, titleText());
    fillTable();
    showPaths();
}

QString RegionPanel::titleText() const {
    const client::PixelRegion& region = selection_.state().region;
    const client::ImageEntry* entry = dataset_.currentImage();
    if (region.empty()) return entry && entry->image ? tr("Whole image") : QString();
    QString text = toQString(region.text());
    text[0] = text[0].toUpper();
    return text;
}

void RegionPanel::fillTable() {
    title_->setText(titleText());
    clear_->setVisible(!selection_.state().region.empty());
    if (numbers_.channels.empty()) {
        table_->setRowCount(0);
        const bool image = dataset_.currentImage() != nullptr;
        overlay_->showEmpty(image ? tr("The image is being rendered") : tr("Numbers of a region"),
                            image ? tr("Numbers of all its pixels come when it is complete. Hold Shift and drag in the image to choose some.")
                                  : tr("Render or open an image, then hold Shift and drag in it"));
        return;
    }
    overlay_->clear();
    about_->setText(aboutText());
    table_->clear();
    const std::vector<Row> rows = rowsOf(numbers_);
    QStringList columns{QString()};
    for (const RegionChannel& channel : numbers_.channels) columns << (channel.image.channel == "luminance" ? QStringLiteral("Y") : toQString(channel.image.channel));
    table_->setRowCount(static_cast<int>(rows.size()));
    table_->setColumnCount(columns.size());
    table_->setHorizontalHeaderLabels(columns);
    for (int column = 0; column < columns.size(); ++column) {
        table_->horizontalHeaderItem(column)->setTextAlignment(int(Qt::AlignRight | Qt::AlignVCenter));
        table_->horizontalHeaderItem(column)->setToolTip(column == 0 ? tr("What of the region's pixels") : tr("Channel %1, in the image's unit: of renders W/(sr m²)").arg(columns[column]));
        table_->horizontalHeader()->setSectionResizeMode(column, column == 0 ? QHeaderView::ResizeToContents : QHeaderView::Stretch);
    }
    for (int row = 0; row < table_->rowCount(); ++row) fillRow(row, *rows[static_cast<std::size_t>(row)].statistic, rows[static_cast<std::size_t>(row)].ofReference);
    table_->setFixedHeight(table_->horizontalHeader()->sizeHint().height() + table_->rowCount() * table_->verticalHeader()->defaultSectionSize() + 2);
}

QString RegionPanel::aboutText() const {
    QString text = tr("%1 pixels").arg(grouped(numbers_.pixels));
    const bool faults = std::ranges::any_of(numbers_.channels, [](const RegionChannel& channel) {
        return std::ranges::any_of(kStatistics, [&](const Statistic& s) { return s.count && s.value(channel.image) > 0; });
    });
    if (!faults) text += tr(", none NaN, infinite or negative");
    if (numbers_.hasReference) text += tr("; grey: %1").arg(referenceTitle_);
    if (selection_.state().region.empty()) text += tr(". Hold Shift and drag in the image, or press R, to choose some.");
    return text;
}

void RegionPanel::fillRow(int row, const RegionStatistic& statistic, bool ofReference) {
    const ThemeColors& c = theme_.colors();
    auto* name = new QTableWidgetItem(ofReference ? tr("reference") : tr(statistic.name));
    name->setToolTip(tr(statistic.tip));
    name->setFont(theme_.font());
    name->setForeground(c.mutedText);
    table_->setItem(row, 0, name);
    for (std::size_t i = 0; i < numbers_.channels.size(); ++i) {
        const RegionChannel& channel = numbers_.channels[i];
        auto* item = new QTableWidgetItem;
        item->setTextAlignment(int(Qt::AlignRight | Qt::AlignVCenter));
        table_->setItem(row, static_cast<int>(i) + 1, item);
        if (ofReference && !channel.reference) continue;
        const analysis::ChannelStatistics& shown = ofReference ? *channel.reference : channel.image;
        const double value = statistic.value(shown);
        // Of values that are all NaN or infinite there is no mean.
        const bool none = !statistic.count && shown.summary.finite == 0;
        item->setText(none ? QStringLiteral("–") : statistic.count ? grouped(static_cast<std::uint64_t>(value)) : number(value));
        item->setForeground(statistic.count && value > 0 ? c.warning : ofReference || statistic.count ? c.mutedText : c.text);
        if (ofReference && !none && value != 0)
            item->setToolTip(tr("The image's %1 is %2 times this").arg(tr(statistic.name), number(statistic.value(channel.image) / value)));
    }
}

bool RegionPanel::isTraced() const {
    const client::PixelRegion& region = selection_.state().region;
    if (region.empty() || dataset_.current().empty() || tracing_.heldBack > 0) return false;
    return std::ranges::all_of(dataset_.current(), [&](const auto& trace) {
        return std::ranges::all_of(trace->pixels, [&](Pixel pixel) { return region.contains(pixel); });
    });
}

QString RegionPanel::pathsText() const {
    if (!isTraced()) return {};
    std::vector<Replay> replays;
    std::uint64_t matched = 0, replayed = 0;
    bool query = false;
    for (const auto& trace : dataset_.current()) {
        replays.insert(replays.end(), trace->replays.begin(), trace->replays.end());
        query |= trace->matches.has_value();
        matched += trace->matches ? trace->matches->matched : trace->paths.pathCount();
        replayed += trace->matches ? trace->matches->paths : trace->paths.pathCount();
    }
    const ReplayCounts counts = countReplays(replays);
    QString text = query ? tr("The filter takes %1 of %2 paths of %3 pixels.").arg(grouped(matched), grouped(replayed), grouped(counts.pixels))
                         : tr("%1 paths of %2 pixels.").arg(grouped(dataset_.paths().pathCount()), grouped(counts.pixels));
    if (counts.exact == counts.pixels) text += tr(" All replays are exact.");
    else if (counts.unknown < counts.pixels) text += tr(" Exact replay of %1 pixels.").arg(grouped(counts.exact));
    return text;
}

QString RegionPanel::warningText() const {
    const client::PixelRegion& region = selection_.state().region;
    if (region.empty()) return {};
    if (tracing_.heldBack > 0 && !tracing_.running)
        return tr("%1 paths: many to show at once. Trace them, choose a smaller region, or only what a filter takes.").arg(grouped(tracing_.heldBack));
    if (tracing_.running) return {};
    if (!isTraced()) return tracing_.connected ? tr("These pixels are not traced.") : tr("These pixels are not traced: no renderer is connected.");
    QStringList parts;
    std::uint64_t dropped = 0, omitted = 0;
    for (const auto& trace : dataset_.current()) {
        dropped += trace->stats.droppedByBudget;
        omitted += trace->matches ? trace->matches->omitted : 0;
    }
    if (dropped > 0)
        parts << tr("%1 values did not fit into the memory that the renderer has for a recording, so some paths lack data or are missing. "
                    "Choose fewer pixels, or only what a filter takes.").arg(grouped(dropped));
    if (omitted > 0) parts << tr("%1 of the paths that the filter takes did not fit: ask for less.").arg(grouped(omitted));
    return parts.join(' ');
}

void RegionPanel::showPaths() {
    const bool region = !selection_.state().region.empty();
    const QString paths = tracing_.running && region ? tr("Tracing …") : pathsText(), warning = warningText();
    paths_->setText(paths);
    paths_->setVisible(!paths.isEmpty());
    warning_->setText(warning);
    warning_->setVisible(!warning.isEmpty());
    onlyMatches_->setVisible(region);
    onlyMatches_->setEnabled(!filter_.isEmpty() || onlyMatches_->isChecked());
    trace_->setVisible(region && tracing_.connected && !tracing_.running && !isTraced());
    trace_->setText(tracing_.heldBack > 0 ? tr("Trace %1 paths").arg(grouped(tracing_.heldBack)) : tr("Trace"));
}

void RegionPanel::copy() {
    QString text = titleText();
    for (int column = 1; column < table_->columnCount(); ++column) text += '\t' + table_->horizontalHeaderItem(column)->text();
    for (int row = 0; row < table_->rowCount(); ++row)
        for (int column = 0; column < table_->columnCount(); ++column) text += (column == 0 ? '\n' : '\t') + table_->item(row, column)->text();
    QApplication::clipboard()->setText(text + '\n');
}

}  // namespace emca::explorer
