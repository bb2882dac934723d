#include "paths/outlier_panel.h"

#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSpinBox>
#include <QTableView>
#include <algorithm>

#include "base/grouped.h"
#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "base/state_overlay.h"
#include "base/table_text.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "paths/outlier_model.h"
#include "paths/table_delegate.h"
#include "paths/value_rules.h"

namespace emca::explorer {

using analysis::OutlierMethod;
using analysis::PathQuantity;

namespace {

constexpr PathQuantity kQuantities[] = {PathQuantity::luminance, PathQuantity::red, PathQuantity::green,
                                        PathQuantity::blue, PathQuantity::depth};

QString number(double value) { return toQString(analysis::formatNumber(value)); }
/// As queries name it.
const char* queryName(PathQuantity quantity) {
    switch (quantity) {
        case PathQuantity::red: return "estimate.r";
        case PathQuantity::green: return "estimate.g";
        case PathQuantity::blue: return "estimate.b";
        case PathQuantity::depth: return "depth";
        default: return "luminance";
    }
}

}  // namespace

OutlierPanel::OutlierPanel(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent),
      dataset_(dataset),
      selection_(selection),
      model_(new OutlierModel(this)),
      quantity_(new QComboBox),
      method_(new QComboBox),
      deviations_(new QDoubleSpinBox),
      maximum_(new QSpinBox),
      significance_(new QDoubleSpinBox),
      upperOnly_(new QCheckBox(tr("bright side only"))),
      perPixel_(new QCheckBox(tr("each pixel for itself"))),
      automatic_(new QCheckBox(tr("select on new pixels"))),
      summary_(new QLabel),
      table_(new QTableView),
      select_(new QPushButton(tr("Select in views"))),
      overlay_(new StateOverlay(theme, table_)),
      datasetListening_(dataset,
                        [this](std::uint32_t parts) {
                            if (parts & client::DatasetPart::currentTrace) reload();
                        }),
      selectionListening_(selection, [this](std::uint32_t parts) {
          if (parts & client::SelectionPart::paths) follow();
      }) {
    table_->setItemDelegate(new TableDelegate(theme, this));
    build();
    detect();
}

void OutlierPanel::build() {
    for (const PathQuantity quantity : kQuantities) quantity_->addItem(toQString(analysis::label(quantity)));
    deviations_->setLocale(QLocale::c());
    deviations_->setRange(0.1, 1000);
    deviations_->setDecimals(1);
    deviations_->setSingleStep(0.5);
    deviations_->setValue(options_.deviations);
    deviations_->setSuffix(QStringLiteral(" σ"));
    deviations_->setPrefix(tr("mean ± "));
    method_->addItem(tr("Mean ± m·σ"), int(OutlierMethod::meanDeviation));
    method_->addItem(tr("Generalized ESD"), int(OutlierMethod::generalizedEsd));
    method_->setToolTip(tr("Generalized ESD (Rosner 1983) removes the farthest value, one after the other, and tests each against\n"
                           "those that are left: outliers do not hide each other by widening the deviation."));
    maximum_->setLocale(QLocale::c());
    maximum_->setRange(1, 100000);
    maximum_->setPrefix(tr("at most "));
    maximum_->setValue(int(options_.maximum));
    maximum_->setToolTip(tr("How many outliers are looked for"));
    significance_->setLocale(QLocale::c());
    significance_->setDecimals(4);
    significance_->setRange(0.0001, 0.5);
    significance_->setSingleStep(0.01);
    significance_->setPrefix(tr("α = "));
    significance_->setValue(options_.significance);
    significance_->setToolTip(tr("The chance to find any outlier where there is none, if values are normally distributed"));
    summary_->setProperty("role", "muted");
    summary_->setWordWrap(true);
    styleTable();

    auto* top = new QHBoxLayout;
    top->setSpacing(Spacing::small);
    top->addWidget(quantity_, 1);
    top->addWidget(method_, 1);
    auto* parameters = new QHBoxLayout;
    parameters->setSpacing(Spacing::small);
    parameters->addWidget(deviations_, 1);
    parameters->addWidget(maximum_, 1);
    parameters->addWidget(significance_, 1);
    auto* switches = new QHBoxLayout;
    switches->setSpacing(Spacing::large);
    switches->addWidget(upperOnly_);
    switches->addWidget(automatic_);
    switches->addStretch(1);
    auto* bottom = new QHBoxLayout;
    bottom->addWidget(summary_, 1);
    bottom->addWidget(select_, 0, Qt::AlignTop);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::small);
    layout->setSpacing(Spacing::small);
    layout->addLayout(top);
    layout->addLayout(parameters);
    layout->addLayout(switches);
    layout->addWidget(perPixel_);   // a line of its own: three would make the panel wider
    layout->addWidget(table_, 1);
    layout->addLayout(bottom);
    showParameters();
    connectControls();
}

void OutlierPanel::styleTable() {
    table_->setModel(model_);
    quantity_->setToolTip(tr("What stands out: radiance in W/(sr m²), or depth in vertices"));
    deviations_->setToolTip(tr("Paths farther from the mean than so many standard deviations σ"));
    upperOnly_->setToolTip(tr("Only paths above the mean"));
    perPixel_->setToolTip(tr("Each path against the paths of its own pixel. Otherwise against those of the whole region,\n"
                             "where the paths of a bright pixel stand out from those of a dark one."));
    automatic_->setToolTip(tr("Selects what is found whenever another pixel is shown"));
    select_->setToolTip(tr("Makes these paths the selection of all views"));
    table_->setContextMenuPolicy(Qt::CustomContextMenu);
    enableTableCopy(*table_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setShowGrid(false);
    table_->setFrameShape(QFrame::NoFrame);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(Spacing::row);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setResizeContentsPrecision(64);  // rows that are measured
    table_->horizontalHeader()->setSectionResizeMode(OutlierModel::kPath, QHeaderView::Stretch);
    table_->horizontalHeader()->setMinimumSectionSize(fontMetrics().horizontalAdvance(QStringLiteral("Path 1,023")));
}

void OutlierPanel::connectControls() {
    connect(quantity_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int i) {
        options_.quantity = kQuantities[i];
        detect();
    });
    connect(deviations_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double value) {
        options_.deviations = value;
        detect();
    });
    connect(method_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
        options_.method = static_cast<OutlierMethod>(method_->currentData().toInt());
        showParameters();
        detect();
    });
    connect(maximum_, qOverload<int>(&QSpinBox::valueChanged), this, [this](int value) {
        options_.maximum = static_cast<std::size_t>(value);
        detect();
    });
    connect(significance_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double value) {
        options_.significance = value;
        detect();
    });
    connect(upperOnly_, &QCheckBox::toggled, this, [this](bool on) {
        options_.upperOnly = on;
        detect();
    });
    connect(perPixel_, &QCheckBox::toggled, this, &OutlierPanel::detect);
    connect(automatic_, &QCheckBox::toggled, this, [this](bool on) {
        if (on) selectFound();
    });
    connect(select_, &QPushButton::clicked, this, &OutlierPanel::selectFound);
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &OutlierPanel::choose);
    connect(table_, &QWidget::customContextMenuRequested, this, &OutlierPanel::showMenu);
}

void OutlierPanel::showMenu(const QPoint& position) {
    const QModelIndex index = table_->indexAt(position);
    if (!index.isValid()) return;
    const OutlierModel::Found found = model_->found()[static_cast<std::size_t>(index.row())];
    QMenu menu(this);
    menu.addAction(tr("Select only this path"), this, [this, found] { selection_.setPaths({found.id}); });
    menu.addAction(tr("Show only this path"), this, [this, found] { emit showOnlyWanted(found.id); });
    addFilterMenu(menu, rulesForNumber(queryName(options_.quantity), found.value), [this](const query::Rule& rule) { emit filterWanted(rule); });
    menu.addSeparator();
    menu.addAction(tr("Copy value"), this, [found] { QApplication::clipboard()->setText(toQString(analysis::formatFull(found.value))); });
    addTableActions(menu, *table_);
    menu.exec(table_->viewport()->mapToGlobal(position));
}

void OutlierPanel::showParameters() {
    const bool test = options_.method == OutlierMethod::generalizedEsd;
    deviations_->setVisible(!test);
    maximum_->setVisible(test);
    significance_->setVisible(test);
}

void OutlierPanel::setOptions(const analysis::OutlierOptions& options) {
    const auto at = std::find(std::begin(kQuantities), std::end(kQuantities), options.quantity);
    if (at != std::end(kQuantities)) quantity_->setCurrentIndex(int(at - std::begin(kQuantities)));
    method_->setCurrentIndex(method_->findData(int(options.method)));
    deviations_->setValue(options.deviations);
    maximum_->setValue(int(std::min<std::size_t>(options.maximum, 100000)));
    significance_->setValue(options.significance);
    upperOnly_->setChecked(options.upperOnly);
}

bool OutlierPanel::isPerPixel() const { return perPixel_->isChecked(); }

void OutlierPanel::setPerPixel(bool perPixel) { perPixel_->setChecked(perPixel); }

bool OutlierPanel::comparesPixels() const { return isPerPixel() && severalPixels(dataset_.paths()); }

bool OutlierPanel::isAutomatic() const { return automatic_->isChecked(); }

void OutlierPanel::setAutomatic(bool automatic) { automatic_->setChecked(automatic); }

Result<void> OutlierPanel::report() {
    reports_.clear();
    sum_ = {};
    const PathSet& paths = dataset_.paths();
    if (!comparesPixels()) {
        auto all = analysis::detectOutliers(paths, options_);
        if (!all) return all.error();
        sum_ = *all;
        reports_.push_back({paths.empty() ? Pixel() : paths.pixel(0), std::move(all).value()});
        return {};
    }
    auto each = analysis::detectOutliersPerPixel(paths, options_);
    if (!each) return each.error();
    reports_ = std::move(each).value();
    for (const analysis::PixelOutliers& one : reports_) {
        sum_.outliers.insert(sum_.outliers.end(), one.report.outliers.begin(), one.report.outliers.end());
        sum_.considered += one.report.considered;
        sum_.notFinite += one.report.notFinite;
        sum_.withoutValue += one.report.withoutValue;
    }
    return {};
}

void OutlierPanel::detect() {
    const Result<void> reported = report();
    {
        const QScopedValueRollback<bool> guard(marking_, true);
        model_->setReports(dataset_.paths(), reports_, options_.quantity);
    }
    updateState();
    if (!reported) overlay_->showError(toQString(reported.error().message));
    written_.reset();
    follow();
}

void OutlierPanel::reload() {
    detect();
    if (isAutomatic() && !model_->found().empty()) selectFound();
}

QString OutlierPanel::summaryText() const {
    if (dataset_.paths().empty()) return {};
    QString text = tr("%1 of %2 paths").arg(grouped(sum_.outliers.size()), grouped(dataset_.paths().pathCount()));
    text += comparesPixels() ? perPixelText() : limitsText();
    if (sum_.notFinite > 0) text += tr("; %1 NaN or infinite").arg(grouped(sum_.notFinite));
    if (sum_.withoutValue > 0) text += tr("; %1 without final estimate").arg(grouped(sum_.withoutValue));
    return text;
}

QString OutlierPanel::perPixelText() const {
    std::size_t with = 0, full = 0;
    for (const analysis::PixelOutliers& one : reports_) {
        with += !one.report.outliers.empty();
        full += one.report.maximumReached();
    }
    QString text = tr(", in %1 of %2 pixels.").arg(grouped(with), grouped(reports_.size()));
    if (full > 0) text += tr("\nIn %1 of them all that were tested: raise \"at most\", there may be more.").arg(grouped(full));
    return text + tr("\nEach against mean and σ of its own pixel");
}

QString OutlierPanel::limitsText() const {
    const bool test = options_.method == OutlierMethod::generalizedEsd;
    QString text(QLatin1Char('.'));
    if (test) text += '\n' + testText();
    text += tr("\n%1: mean %2, σ %3").arg(test ? tr("The others") : tr("All"), number(sum_.mean), number(sum_.deviation));
    // Without limits there is nothing to be beyond.
    if (sum_.considered < 2 || !(sum_.deviation > 0)) return text;
    if (test) return text + tr("; from %1 to %2").arg(number(sum_.lower), number(sum_.upper));
    if (options_.upperOnly) return text + tr("; limit %1").arg(number(sum_.upper));
    return text + tr("; limits %1 and %2").arg(number(sum_.lower), number(sum_.upper));
}

QString OutlierPanel::testText() const {
    if (sum_.maximumReached()) return tr("Every one that was tested: raise \"at most\", there may be more.");
    const std::size_t found = sum_.outliers.size() - sum_.notFinite;
    if (found >= sum_.steps.size()) return {};
    const analysis::EsdStep& next = sum_.steps[found];
    return tr("%1 tested; the next one, %2, has R = %3, its limit is %4.")
        .arg(grouped(sum_.steps.size()), number(next.value), number(next.statistic), number(next.critical));
}

void OutlierPanel::updateState() {
    summary_->setText(summaryText());
    select_->setEnabled(!model_->found().empty());
    perPixel_->setVisible(severalPixels(dataset_.paths()));
    if (dataset_.paths().empty()) {
        overlay_->showEmpty(tr("Outliers of a pixel"), tr("Click a pixel in the image"));
    } else if (model_->found().empty()) {
        const bool test = options_.method == OutlierMethod::generalizedEsd;
        overlay_->showEmpty(test ? tr("No outliers at α = %1").arg(options_.significance) : tr("No outliers beyond %1 σ").arg(options_.deviations),
                            test ? tr("Look for more of them, or try another quantity") : tr("Lower the limit, or try another quantity"));
    } else {
        overlay_->clear();
    }
}

void OutlierPanel::selectFound() {
    if (model_->found().empty()) return;
    client::Selection::State state = selection_.state();
    state.paths = model_->ids();
    state.currentPath = model_->found().front().id;
    selection_.set(std::move(state));
}

void OutlierPanel::follow() {
    if (written_ && selection_.state().paths == *written_) return;
    written_.reset();
    const QScopedValueRollback<bool> guard(marking_, true);
    QItemSelection rows;
    for (std::size_t i = 0; i < model_->found().size(); ++i) {
        if (!selection_.isSelected(model_->found()[i].id)) continue;
        const int row = static_cast<int>(i);
        if (!rows.isEmpty() && rows.last().bottom() + 1 == row) {
            const int top = rows.last().top();
            rows.last() =
                QItemSelectionRange(model_->index(top, 0), model_->index(row, OutlierModel::kColumnCount - 1));
        } else {
            rows.append(QItemSelectionRange(model_->index(row, 0), model_->index(row, OutlierModel::kColumnCount - 1)));
        }
    }
    table_->selectionModel()->reset();
    table_->selectionModel()->select(rows, QItemSelectionModel::Select);
    table_->viewport()->update();
}

void OutlierPanel::choose() {
    if (marking_) return;
    std::vector<client::PathId> ids;
    for (const QModelIndex& row : table_->selectionModel()->selectedRows())
        ids.push_back(model_->found()[static_cast<std::size_t>(row.row())].id);
    std::sort(ids.begin(), ids.end());
    written_ = ids;
    selection_.setPaths(std::move(ids));
}

}  // namespace emca::explorer
