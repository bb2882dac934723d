#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "scene_panels.h"

namespace emca::explorer {

PathColorPanel::PathColorPanel(SceneView& view, Theme& theme, QWidget* parent) : QWidget(parent), view_(view), theme_(theme) {
    auto* form = new QFormLayout(this);
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(Spacing::medium);
    form->setVerticalSpacing(Spacing::tiny);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);

    quantity_ = new QComboBox;
    quantity_->setObjectName("pathQuantity");
    quantity_->setEditable(true);
    quantity_->setInsertPolicy(QComboBox::NoInsert);
    quantity_->setMaxVisibleItems(24);
    quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    quantity_->setMinimumContentsLength(12);
    quantity_->completer()->setFilterMode(Qt::MatchContains);
    quantity_->completer()->setCompletionMode(QCompleter::PopupCompletion);
    quantity_->setToolTip("A value of the vertex (v.pdf), of its path (luminance), or any expression of the query language.\n"
                          "A segment has the colour of the vertex that it leads to.");
    form->addRow("Colour by", quantity_);
    connect(quantity_, qOverload<int>(&QComboBox::activated), this, [this] { quantityEntered(); });
    connect(quantity_->lineEdit(), &QLineEdit::returnPressed, this, [this] { quantityEntered(); });

    map_ = new QComboBox;
    map_->setObjectName("pathMap");
    for (std::size_t i = 0; i < analysis::kColorMapCount; ++i) map_->addItem(toQString(analysis::name(static_cast<analysis::ColorMapId>(i))));
    form->addRow("Map", map_);
    connect(map_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
        PathColorStyle style = view_.options().colors;
        style.map = static_cast<analysis::ColorMapId>(index);
        change(style);
    });

    auto* range = new QWidget;
    auto* row = new QHBoxLayout(range);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(Spacing::tiny);
    minimum_ = new QLineEdit;
    maximum_ = new QLineEdit;
    minimum_->setObjectName("pathMinimum");
    maximum_->setObjectName("pathMaximum");
    for (QLineEdit* edit : {minimum_, maximum_}) {
        edit->setAlignment(Qt::AlignRight);
        edit->setFont(theme_.smallNumberFont());
        edit->setMinimumWidth(48);
        edit->setToolTip("Value of the first and of the last colour; Enter applies it");
        connect(edit, &QLineEdit::editingFinished, this, [this] { rangeTyped(); });
        row->addWidget(edit, 1);
    }
    log_ = new QCheckBox("Log");
    log_->setObjectName("pathLog");
    log_->setToolTip("Logarithmic colours");
    connect(log_, &QCheckBox::toggled, this, [this](bool on) {
        PathColorStyle style = view_.options().colors;
        style.log = on;
        if (on && style.limits && !(style.limits->min > 0)) style.limits.reset();   // no logarithm spans it
        change(style);
    });
    row->addWidget(log_);
    automatic_ = new QPushButton("Auto");
    automatic_->setObjectName("pathAutomatic");
    automatic_->setToolTip("Most of the values; a few far ones do not flatten the rest");
    connect(automatic_, &QPushButton::clicked, this, [this] {
        PathColorStyle style = view_.options().colors;
        style.limits.reset();
        change(style);
    });
    row->addWidget(automatic_);
    form->addRow("Range", range);
    complaint_ = new QLabel;
    complaint_->setObjectName("pathComplaint");
    complaint_->setWordWrap(true);
    form->addRow(complaint_);
    rows_ = {map_, form->labelForField(map_), range, form->labelForField(range)};

    connect(&view_, &SceneView::optionsChanged, this, &PathColorPanel::read);
    connect(&view_, &SceneView::pathsChanged, this, &PathColorPanel::fill);
    fill();
}

void PathColorPanel::fill() {
    QStringList names;
    for (const std::string& name : colorableQuantities(view_.paths())) names << toQString(name);
    if (names != names_ || quantity_->count() == 0) {
        names_ = names;
        reading_ = true;
        quantity_->clear();
        quantity_->addItem("What a segment is");
        quantity_->addItems(names_);
        reading_ = false;
    }
    read();
}

void PathColorPanel::read() {
    reading_ = true;
    const PathColorStyle& style = view_.options().colors;
    const PathColoring& coloring = view_.pathColors();
    if (!quantity_->lineEdit()->isModified() || style.quantity == quantity_->currentText().toStdString()) {
        const int place = style.quantity.empty() ? 0 : quantity_->findText(toQString(style.quantity));
        if (place >= 0) quantity_->setCurrentIndex(place);
        else quantity_->setEditText(toQString(style.quantity));
        quantity_->lineEdit()->setModified(false);
    }
    map_->setCurrentIndex(static_cast<int>(style.map));
    log_->setChecked(style.log);
    log_->setEnabled(coloring.categories().empty());
    for (auto [edit, value] : {std::pair(minimum_, coloring.range().min), std::pair(maximum_, coloring.range().max)}) {
        edit->setText(coloring.isOn() ? toQString(analysis::formatNumber(value)) : QString());
        edit->setCursorPosition(0);
        edit->setModified(false);
        edit->setEnabled(coloring.isOn() && coloring.categories().empty());
    }
    automatic_->setEnabled(style.limits.has_value());
    for (QWidget* row : rows_) row->setVisible(!style.quantity.empty());
    complaint_->setText(coloring.error());
    complaint_->setStyleSheet(QStringLiteral("color: %1;").arg(theme_.colors().warning.name()));
    complaint_->setVisible(!coloring.error().isEmpty());
    reading_ = false;
}

void PathColorPanel::change(const PathColorStyle& style) {
    if (reading_) return;
    SceneOptions options = view_.options();
    options.colors = style;
    view_.setOptions(options);
}

void PathColorPanel::quantityEntered() {
    if (reading_) return;
    const QString text = quantity_->currentText().trimmed();
    PathColorStyle style = view_.options().colors;
    const std::string before = style.quantity;
    style.quantity = text == quantity_->itemText(0) ? std::string() : text.toStdString();
    if (style.quantity != before) style.limits.reset();   // they were those of another quantity
    quantity_->lineEdit()->setModified(false);
    change(style);
}

void PathColorPanel::rangeTyped() {
    if (reading_ || (!minimum_->isModified() && !maximum_->isModified())) return;
    bool low = false, high = false;
    const double min = minimum_->text().toDouble(&low), max = maximum_->text().toDouble(&high);
    PathColorStyle style = view_.options().colors;
    if (low && high && analysis::ValueRange{min, max, style.log}.isValid()) style.limits = SurfaceLimits{min, max};
    if (style == view_.options().colors) return read();   // what cannot be is replaced by what is
    change(style);
}

}  // namespace emca::explorer
