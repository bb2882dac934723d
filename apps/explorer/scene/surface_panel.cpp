#include "surface_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

constexpr double kMostStops = 12;

QLabel* muted(const QString& text) {
    auto* label = new QLabel(text);
    label->setProperty("role", "muted");
    return label;
}

QString number(double value) { return toQString(analysis::formatNumber(value)); }
QString whole(std::uint64_t value) { return toQString(analysis::formatInteger(static_cast<std::int64_t>(value))); }

QHBoxLayout* rowOf(QWidget* row) {
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    return layout;
}

}  // namespace

SurfacePanel::SurfacePanel(client::Dataset& dataset, SurfaceModel& model, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), model_(model), theme_(theme), listening_(dataset, [this](std::uint32_t parts) {
          if (parts & (client::DatasetPart::info | client::DatasetPart::surface)) showList();
      }) {
    column_ = new QVBoxLayout(this);
    column_->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::medium);
    column_->setSpacing(Spacing::small);

    listPlace_ = section(tr("Layers"));
    none_ = muted({});
    none_->setObjectName("layerHint");
    none_->setWordWrap(true);
    render_ = new QPushButton;
    render_->setObjectName("renderLayers");
    render_->setToolTip(tr("Renders the image and collects the ticked layers meanwhile (Ctrl+R)"));
    column_->addWidget(none_);
    column_->addWidget(render_);
    connect(render_, &QPushButton::clicked, this, &SurfacePanel::renderWanted);

    colors_ = new QWidget;
    column_->addWidget(colors_);
    auto* inner = new QVBoxLayout(colors_);
    inner->setContentsMargins(0, 0, 0, 0);
    inner->setSpacing(Spacing::small);
    addColors(inner);
    column_->addStretch(1);

    connect(&model_, &SurfaceModel::surfaceChanged, this, &SurfacePanel::showList);
    connect(&model_, &SurfaceModel::styleChanged, this, &SurfacePanel::showStyle);
    showList();
}

QVBoxLayout* SurfacePanel::section(const QString& title) {
    auto* label = new QLabel(title);
    label->setFont(theme_.strongFont());
    column_->addWidget(label);
    auto* place = new QVBoxLayout;
    place->setContentsMargins(0, 0, 0, 0);
    column_->addLayout(place);
    return place;
}

// Colours ----------------------------------------------------------------------------------------

void SurfacePanel::addColors(QVBoxLayout* into) {
    auto* title = new QLabel(tr("Colours"));
    title->setFont(theme_.strongFont());
    into->addSpacing(Spacing::small);
    into->addWidget(title);
    form_ = new QFormLayout;
    form_->setContentsMargins(0, 0, 0, 0);
    form_->setHorizontalSpacing(Spacing::medium);
    form_->setVerticalSpacing(Spacing::tiny);
    form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    into->addLayout(form_);
    const auto add = [&](const QString& label, QWidget* field, std::vector<QWidget*>* rows) {
        auto* text = new QLabel(label);
        text->setBuddy(field);
        form_->addRow(text, field);
        if (!rows) return;
        rows->push_back(text);
        rows->push_back(field);
    };

    map_ = new QComboBox;
    map_->setObjectName("layerMap");
    for (std::size_t i = 0; i < analysis::kColorMapCount; ++i) map_->addItem(toQString(analysis::name(static_cast<analysis::ColorMapId>(i))));
    connect(map_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
        SurfaceStyle style = model_.style();
        style.map = static_cast<analysis::ColorMapId>(index);
        model_.setStyle(style);
    });
    add(tr("Map"), map_, &scalarRows_);
    add(tr("Range"), rangeRow(), &scalarRows_);
    add(tr("By area"), percentRow(), &scalarRows_);

    exposureValue_ = new QDoubleSpinBox;
    exposureValue_->setObjectName("layerExposureValue");
    exposureValue_->setRange(-kMostStops, kMostStops);
    exposureValue_->setSingleStep(0.5);
    exposureValue_->setDecimals(1);
    exposureValue_->setSuffix(tr(" EV"));
    exposureValue_->setFont(theme_.smallNumberFont());
    exposureValue_->setAlignment(Qt::AlignRight);
    exposureValue_->setFixedWidth(78);
    QWidget* exposureRow = sliderRow(exposure_, exposureValue_);
    exposure_->setObjectName("layerExposure");
    exposure_->setRange(static_cast<int>(-kMostStops * 10), static_cast<int>(kMostStops * 10));
    const auto expose = [this](double stops) {
        if (reading_) return;
        SurfaceStyle style = model_.style();
        style.exposure = static_cast<float>(stops);
        model_.setStyle(style);
    };
    connect(exposure_, &QSlider::valueChanged, this, [expose](int v) { expose(v / 10.0); });
    connect(exposureValue_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, expose);
    add(tr("Exposure"), exposureRow, &colorRows_);

    opacityValue_ = new QLabel;
    opacityValue_->setFont(theme_.smallNumberFont());
    opacityValue_->setMinimumWidth(44);
    opacityValue_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    QWidget* opacityRow = sliderRow(opacity_, opacityValue_);
    opacity_->setObjectName("layerOpacity");
    opacity_->setRange(0, 100);
    opacity_->setToolTip(tr("Of the surfaces while a layer is shown; below 100 % paths behind them show through"));
    connect(opacity_, &QSlider::valueChanged, this, [this](int v) {
        if (reading_) return;
        SurfaceStyle style = model_.style();
        style.opacity = static_cast<float>(v) / 100;
        model_.setStyle(style);
    });
    add(tr("Opacity"), opacityRow, nullptr);

    complaint_ = new QLabel;
    complaint_->setObjectName("rangeComplaint");
    complaint_->setWordWrap(true);
    complaint_->hide();
    into->addWidget(complaint_);

    numbers_ = new QWidget;
    numberGrid_ = new QGridLayout(numbers_);
    numberGrid_->setContentsMargins(0, 0, 0, 0);
    numberGrid_->setHorizontalSpacing(Spacing::medium);
    numberGrid_->setVerticalSpacing(2);
    numberGrid_->setColumnStretch(1, 1);
    auto* numbersTitle = new QLabel(tr("Numbers"));
    numbersTitle->setFont(theme_.strongFont());
    into->addSpacing(Spacing::small);
    into->addWidget(numbersTitle);
    into->addWidget(numbers_);
    coarse_ = new QLabel;
    coarse_->setObjectName("coarseWords");
    coarse_->setWordWrap(true);
    into->addWidget(coarse_);
}

QWidget* SurfacePanel::rangeRow() {
    auto* row = new QWidget;
    auto* layout = rowOf(row);
    minimum_ = new QLineEdit;
    maximum_ = new QLineEdit;
    minimum_->setObjectName("rangeMinimum");
    maximum_->setObjectName("rangeMaximum");
    for (QLineEdit* edit : {minimum_, maximum_}) {
        edit->setAlignment(Qt::AlignRight);
        edit->setFont(theme_.smallNumberFont());
        edit->setMinimumWidth(60);
        edit->setToolTip(tr("Value of the first and of the last colour; Enter applies it"));
        connect(edit, &QLineEdit::editingFinished, this, &SurfacePanel::rangeTyped);
    }
    log_ = new QCheckBox(tr("Log"));
    log_->setObjectName("layerLog");
    log_->setToolTip(tr("Logarithmic colours"));
    connect(log_, &QCheckBox::toggled, this, [this](bool on) {
        if (reading_) return;
        complain({});
        // A range by hand that no logarithm can span goes back to the percentiles.
        const auto limits = model_.style().of(model_.style().layer).limits;
        if (on && limits && !(limits->min > 0)) model_.setLimits(std::nullopt);
        model_.setLog(on);
    });
    layout->addWidget(minimum_, 1);
    layout->addWidget(muted(QStringLiteral("–")));
    layout->addWidget(maximum_, 1);
    layout->addWidget(log_);
    return row;
}

QWidget* SurfacePanel::percentRow() {
    auto* row = new QWidget;
    auto* layout = rowOf(row);
    lower_ = new QDoubleSpinBox;
    upper_ = new QDoubleSpinBox;
    lower_->setObjectName("percentLower");
    upper_->setObjectName("percentUpper");
    lower_->setRange(0, 49);
    upper_->setRange(51, 100);
    for (QDoubleSpinBox* spin : {lower_, upper_}) {
        spin->setDecimals(1);
        spin->setSuffix(" %");
        spin->setFont(theme_.smallNumberFont());
        spin->setKeyboardTracking(false);
        spin->setToolTip(tr("The range leaves out the values of this share of the surface, so that a few faces do not flatten all others"));
        connect(spin, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this] {
            if (reading_) return;
            SurfaceStyle style = model_.style();
            style.lower = lower_->value() / 100;
            style.upper = upper_->value() / 100;
            style.layers[style.layer].limits.reset();
            model_.setStyle(style);
        });
    }
    automatic_ = new QPushButton(tr("Auto"));
    automatic_->setObjectName("rangeReset");
    automatic_->setToolTip(tr("The range by these percentiles of the area again"));
    connect(automatic_, &QPushButton::clicked, this, [this] {
        complain({});
        model_.setLimits(std::nullopt);
        showStyle();
    });
    layout->addWidget(lower_, 1);
    layout->addWidget(muted(QStringLiteral("–")));
    layout->addWidget(upper_, 1);
    layout->addWidget(automatic_);
    return row;
}

QWidget* SurfacePanel::sliderRow(QSlider*& slider, QWidget* value) {
    auto* row = new QWidget;
    auto* layout = rowOf(row);
    slider = new QSlider(Qt::Horizontal);
    layout->addWidget(slider, 1);
    layout->addWidget(value);
    return row;
}

void SurfacePanel::complain(const QString& sentence) {
    complaint_->setText(sentence);
    complaint_->setStyleSheet(QStringLiteral("color: %1;").arg(theme_.colors().warning.name()));
    complaint_->setVisible(!sentence.isEmpty());
}

void SurfacePanel::rangeTyped() {
    if (reading_ || !model_.shown()) return;
    const QString before[2] = {number(model_.range().min), number(model_.range().max)};
    const QString typed[2] = {minimum_->text().trimmed(), maximum_->text().trimmed()};
    // What is shown has fewer digits than what is kept: only a change of the text is an edit.
    if (typed[0] == before[0] && typed[1] == before[1]) return complain({});
    double ends[2] = {model_.range().min, model_.range().max};
    for (int i = 0; i < 2; ++i) {
        if (typed[i] == before[i]) continue;
        bool ok = false;
        ends[i] = typed[i].toDouble(&ok);
        if (!ok || !std::isfinite(ends[i])) {
            showStyle();
            return complain(tr("“%1” is not a number; the range stays as it was.").arg(typed[i]));
        }
    }
    QString objection;
    if (!(ends[0] < ends[1])) objection = tr("A range from %1 to %2 is empty; the range stays as it was.").arg(typed[0], typed[1]);
    else if (model_.range().log && !(ends[0] > 0)) objection = tr("Logarithmic colours begin above 0; the range stays as it was.");
    if (objection.isEmpty()) model_.setLimits(SurfaceLimits{ends[0], ends[1]});
    showStyle();
    complain(objection);
}

// Current values ---------------------------------------------------------------------------------

void SurfacePanel::showStyle() {
    const SurfaceStyle& style = model_.style();
    const SurfaceLayerData* layer = model_.shown();
    colors_->setVisible(layer != nullptr);
    if (list_)
        for (QRadioButton* button : list_->findChildren<QRadioButton*>())
            if (button->objectName() == "show:" + (layer ? toQString(style.layer) : QString())) button->setChecked(true);
    if (!layer) return;
    reading_ = true;
    const QSignalBlocker quiet(map_);
    for (QWidget* row : scalarRows_) row->setVisible(!model_.isColor());
    for (QWidget* row : colorRows_) row->setVisible(model_.isColor());
    map_->setCurrentIndex(static_cast<int>(style.map));
    log_->setChecked(style.of(style.layer).log);
    minimum_->setText(number(model_.range().min));
    maximum_->setText(number(model_.range().max));
    lower_->setValue(style.lower * 100);
    upper_->setValue(style.upper * 100);
    automatic_->setEnabled(model_.isRangeByHand());
    exposure_->setValue(static_cast<int>(std::lround(style.exposure * 10)));
    exposureValue_->setValue(double(style.exposure));
    opacity_->setValue(static_cast<int>(std::lround(style.opacity * 100)));
    opacityValue_->setText(QStringLiteral("%1 %").arg(std::lround(style.opacity * 100)));
    reading_ = false;
    showNumbers();
}

void SurfacePanel::showNumbers() {
    const SurfaceLayerData* layer = model_.shown();
    const analysis::SurfaceStatistics* s = model_.statistics();
    if (!layer || !s) return;
    const SurfaceCounts& counts = model_.surface()->field->counts;
    std::vector<std::pair<QString, QString>> rows{
        {tr("Unit"), layer->description.unit.empty() ? tr("none") : toQString(layer->description.unit)},
        {model_.isColor() ? tr("Mean luminance") : tr("Mean"), number(s->mean)},
        {tr("Deviation"), number(s->deviation)},
        {tr("Least, most"), number(s->min) + QStringLiteral(", ") + number(s->max)},
    };
    if (layer->description.kind == LayerKind::density) rows.push_back({tr("Over the surface"), number(s->integral)});
    rows.push_back({tr("Samples"), whole(layer->samples)});
    rows.push_back({tr("Places"), whole(counts.points)});
    rows.push_back({tr("Faces"), whole(model_.surface()->dataFaces)});
    rows.push_back({tr("Memory"), toQString(analysis::formatBytes(counts.bytesUsed)) + tr(" of ") + toQString(analysis::formatBytes(counts.budgetBytes))});
    if (counts.invalid > 0) rows.push_back({tr("Not kept"), whole(counts.invalid)});
    for (int i = 0; i < static_cast<int>(rows.size()) || numberGrid_->itemAtPosition(i, 0); ++i) {
        for (int column = 0; column < 2; ++column) {
            auto* label = numberGrid_->itemAtPosition(i, column) ? static_cast<QLabel*>(numberGrid_->itemAtPosition(i, column)->widget()) : nullptr;
            if (!label) {
                label = column == 0 ? muted({}) : new QLabel;
                if (column == 1) label->setFont(theme_.smallNumberFont());
                if (column == 1) label->setTextInteractionFlags(Qt::TextSelectableByMouse);
                numberGrid_->addWidget(label, i, column);
            }
            const bool used = i < static_cast<int>(rows.size());
            label->setVisible(used);
            if (used) label->setText(column == 0 ? rows[static_cast<std::size_t>(i)].first : rows[static_cast<std::size_t>(i)].second);
        }
    }
    QString words;
    if (counts.coarse > 0)
        words = tr("The memory for layers was used up: %1 of %2 places (%3 %) lie in bins shared by neighbouring faces. No sample is "
                   "lost, but there the picture is coarser than it could be.")
                    .arg(whole(counts.coarse), whole(counts.points), number(100 * double(counts.coarse) / double(std::max<std::uint64_t>(counts.points, 1))));
    else if (counts.refusedDivisions > 0)
        words = tr("The memory for layers was used up: %1 faces would be finer with more of it.").arg(whole(counts.refusedDivisions));
    coarse_->setText(words);
    coarse_->setStyleSheet(QStringLiteral("color: %1;").arg(theme_.colors().warning.name()));
    coarse_->setVisible(!words.isEmpty());
}

}  // namespace emca::explorer
