#include "paths/rule_row.h"

#include <QComboBox>
#include <QGridLayout>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <QToolButton>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/query/vocabulary.h"

namespace emca::explorer {
namespace {

constexpr int kWide = 480;  ///< from here on a rule stands in one line

QStringList quantifiers(query::Owner owner) {
    switch (owner) {
        case query::Owner::vertex:
            return {RuleRow::tr("any vertex"), RuleRow::tr("every vertex"), RuleRow::tr("no vertex"), RuleRow::tr("first vertex"), RuleRow::tr("last vertex")};
        case query::Owner::contribution:
            return {RuleRow::tr("any contribution"), RuleRow::tr("every contribution"), RuleRow::tr("no contribution"), RuleRow::tr("first contribution"), RuleRow::tr("last contribution")};
        case query::Owner::shadowTest:
            return {RuleRow::tr("any shadow test"), RuleRow::tr("every shadow test"), RuleRow::tr("no shadow test"), RuleRow::tr("first shadow test"), RuleRow::tr("last shadow test")};
        default: return {};
    }
}

}  // namespace

RuleRow::RuleRow(const PathSet& paths, QWidget* parent)
    : QWidget(parent), paths_(paths), layout_(new QGridLayout(this)), over_(new QComboBox), quantity_(new CompletingField),
      operator_(new QComboBox), value_(new CompletingField), remove_(new QToolButton) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setHorizontalSpacing(Spacing::tiny);
    layout_->setVerticalSpacing(Spacing::tiny);
    quantity_->setPlaceholderText(tr("quantity"));
    quantity_->setToolTip(tr("A name, or an expression such as luminance(v.throughput)"));
    value_->setPlaceholderText(tr("value"));
    value_->setToolTip(tr("A number in the quantity's unit, an expression such as 20 * mean(luminance), or a text; “one of” takes several with commas"));
    over_->setToolTip(tr("Of many values of a path: for which of them the rule has to hold"));
    operator_->setToolTip(tr("How quantity and value compare"));
    remove_->setText(QStringLiteral("×"));
    remove_->setToolTip(tr("Remove this rule"));
    remove_->setFixedSize(Spacing::control, Spacing::control);
    remove_->setStyleSheet(QStringLiteral("padding: 0; font-size: 16px;"));
    over_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    operator_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    operator_->setMinimumContentsLength(8);
    fitOperators();
    arrange(false);
    connect(quantity_, &CompletingField::edited, this, [this] {
        fitOperators();
        emit changed();
    });
    connect(value_, &CompletingField::edited, this, &RuleRow::changed);
    connect(over_, qOverload<int>(&QComboBox::activated), this, &RuleRow::changed);
    connect(operator_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
        value_->setVisible(query::needsValue(rule().op));
        emit changed();
    });
    connect(remove_, &QToolButton::clicked, this, &RuleRow::removeWanted);
}

query::Rule RuleRow::rule() const {
    query::Rule rule;
    rule.quantity = quantity_->text().toStdString();
    rule.over = static_cast<query::Quantifier>(std::max(0, over_->currentIndex()));
    rule.op = static_cast<query::RuleOperator>(operator_->currentData().toInt());
    rule.value = value_->text().toStdString();
    return rule;
}

void RuleRow::setRule(const query::Rule& rule) {
    const QSignalBlocker a(over_), b(operator_);
    quantity_->setText(toQString(rule.quantity));
    fitOperators();
    if (over_->count() > 0) over_->setCurrentIndex(static_cast<int>(rule.over));
    if (const int at = operator_->findData(static_cast<int>(rule.op)); at >= 0) operator_->setCurrentIndex(at);
    value_->setText(toQString(rule.value));
    value_->setVisible(query::needsValue(this->rule().op));
}

void RuleRow::refresh() { fitOperators(); }

void RuleRow::fitOperators() {
    const std::string expression = quantity_->text().toStdString();
    const auto quantity = query::describe(expression, paths_);
    const query::ExpressionType type = quantity ? quantity->type : query::ExpressionType::missing;
    const query::Owner owner = quantity ? quantity->owner : query::Owner::path;
    {
        const QSignalBlocker blocked(operator_);
        const QVariant before = operator_->currentData();
        operator_->clear();
        for (const query::RuleOperator op : query::operatorsOf(type)) operator_->addItem(toQString(query::label(op)), static_cast<int>(op));
        const int same = operator_->findData(before);
        operator_->setCurrentIndex(same >= 0 ? same : 0);
    }
    if (owner_ != static_cast<int>(owner)) {
        owner_ = static_cast<int>(owner);
        const QSignalBlocker blocked(over_);
        const int before = over_->currentIndex();
        over_->clear();
        over_->addItems(quantifiers(owner));
        if (over_->count() > 0) over_->setCurrentIndex(std::max(0, before));
        over_->setVisible(owner != query::Owner::path);
        arrange(wide_);
    }
    value_->setVisible(query::needsValue(rule().op));
    if (type == query::ExpressionType::text) {
        value_->setChoicesLater([this, expression] {
            std::vector<CompletingField::Choice> choices;
            for (const std::string& text : query::textsOf(expression, paths_)) choices.push_back({toQString(text), {}});
            return choices;
        });
    } else {
        value_->setChoices({});
    }
}

void RuleRow::arrange(bool wide) {
    wide_ = wide;
    for (QWidget* widget : std::initializer_list<QWidget*>{over_, quantity_, operator_, value_, remove_}) layout_->removeWidget(widget);
    if (wide) {
        layout_->addWidget(over_, 0, 0);
        layout_->addWidget(quantity_, 0, 1);
        layout_->addWidget(operator_, 0, 2);
        layout_->addWidget(value_, 0, 3);
        layout_->addWidget(remove_, 0, 4);
    } else {
        layout_->addWidget(over_, 0, 0);
        // A path has one value: its name begins where "any vertex" would.
        const int first = over_->isHidden() ? 0 : 1;
        layout_->addWidget(quantity_, 0, first, 1, 3 - first);
        layout_->addWidget(remove_, 0, 3);
        layout_->addWidget(operator_, 1, 0);
        layout_->addWidget(value_, 1, 1, 1, 2);
    }
    layout_->setColumnStretch(1, 3);
    layout_->setColumnStretch(3, wide ? 2 : 0);
}

void RuleRow::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    if (const bool wide = width() >= kWide; wide != wide_) arrange(wide);
}

}  // namespace emca::explorer
