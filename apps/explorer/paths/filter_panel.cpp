#include "paths/filter_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollArea>
#include <QToolButton>
#include <algorithm>

#include "base/grouped.h"
#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/query/vocabulary.h"
#include "paths/query_field.h"
#include "paths/rule_row.h"

namespace emca::explorer {
namespace {

QLabel* label(const QString& text, const char* role) {
    auto* made = new QLabel(text);
    made->setProperty("role", role);
    made->setWordWrap(true);
    return made;
}

/// Questions that every renderer can answer (docs/queries.md).
struct Example {
    const char *title, *query;
};
constexpr Example kExamples[] = {
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Fireflies: far brighter than the others"), "luminance > 20 * mean(luminance)"},
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Caustics: diffuse, then mirrors or glass, then a light"), "lpe(\"C.*DS+[OB]\")"},
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Light that came through glass"), "lpe(\"C.*<TS>L\")"},
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Not a number, or infinite"), "nan(estimate) or inf(estimate)"},
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Negative light"), "any(c.value.r < 0 or c.value.g < 0 or c.value.b < 0)"},
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Light that its MIS weight threw away"), "any(c.weight < 0.01)"},
    {QT_TRANSLATE_NOOP("emca::explorer::FilterPanel", "Surfaces that are hit again at once"),
     "any(v.segment < 1e-4) or any(not n.visible and distance(n.position, v.position) < 1e-4)"},
};

}  // namespace

FilterPanel::FilterPanel(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), selection_(selection), theme_(theme), model_(new FilterModel(this)),
      rowLayout_(new QVBoxLayout), ruleArea_(new QWidget),
      ruleHint_(label(tr("Add a rule, choose an example, or write a query below."), "muted")), handNote_(new QWidget),
      add_(new QToolButton), examples_(new QToolButton), field_(new QueryField(theme)), error_(label({}, "error")),
      count_(label({}, "title")), note_(label({}, "muted")), automatic_(new QCheckBox(tr("select on new pixels"))),
      select_(new QPushButton(tr("Select in views"))), clear_(new QPushButton(tr("Clear"))),
      datasetListening_(dataset, [this](std::uint32_t parts) {
          if (parts & client::DatasetPart::currentTrace) reload();
      }) {
    build();
    reload();
}

void FilterPanel::build() {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::small, Spacing::medium, Spacing::small);
    layout->setSpacing(Spacing::small);
    layout->addWidget(makeRules(), 1);
    layout->addWidget(makeQuery());
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(Spacing::small);
    buttons->addWidget(automatic_);
    buttons->addStretch(1);
    buttons->addWidget(clear_);
    buttons->addWidget(select_);
    layout->addLayout(buttons);
    select_->setProperty("primary", true);
    select_->setToolTip(tr("Makes these paths the selection of all views (Enter in the query)"));
    automatic_->setToolTip(tr("Selects what the query takes whenever another pixel is shown"));
    clear_->setToolTip(tr("Forgets query and rules, and selects nothing"));

    connect(add_, &QToolButton::clicked, this, [this] { addRule(); });
    connect(field_, &QPlainTextEdit::textChanged, this, &FilterPanel::queryEdited);
    connect(field_, &QueryField::accepted, this, &FilterPanel::select);
    connect(select_, &QPushButton::clicked, this, &FilterPanel::select);
    connect(clear_, &QPushButton::clicked, this, &FilterPanel::clear);
    connect(automatic_, &QCheckBox::toggled, this, [this](bool on) {
        if (on && !writing_ && model_->state() != FilterModel::State::empty) select();
        if (!writing_) emit edited();
    });
    connect(model_, &FilterModel::changed, this, &FilterPanel::showAnswer);
    addExamples();
}

QWidget* FilterPanel::makeRules() {
    auto* part = new QWidget;
    auto* layout = new QVBoxLayout(part);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::small);
    auto* top = new QHBoxLayout;
    top->setSpacing(Spacing::tiny);
    add_->setText(tr("+ Rule"));
    add_->setToolTip(tr("Adds a rule; all rules have to hold"));
    add_->setObjectName(QStringLiteral("addRule"));
    examples_->setText(tr("Examples"));
    examples_->setToolTip(tr("Questions that every renderer can answer"));
    examples_->setPopupMode(QToolButton::InstantPopup);
    top->addWidget(label(tr("All of these hold"), "title"), 1);
    top->addWidget(examples_);
    top->addWidget(add_);
    layout->addLayout(top);

    auto* note = new QHBoxLayout(handNote_);
    note->setContentsMargins(0, 0, 0, 0);
    note->setSpacing(Spacing::small);
    note->addWidget(label(tr("The query was edited by hand: these rules do not apply."), "warning"), 1);
    auto* back = new QPushButton(tr("Back to the rules"));
    back->setObjectName(QStringLiteral("backToRules"));
    back->setToolTip(tr("Writes the query anew, as the rules say"));
    connect(back, &QPushButton::clicked, this, &FilterPanel::backToRules);
    note->addWidget(back, 0, Qt::AlignTop);
    handNote_->hide();
    layout->addWidget(handNote_);

    rowLayout_->setContentsMargins(0, 0, 0, 0);
    rowLayout_->setSpacing(Spacing::medium);
    auto* content = new QWidget;
    auto* outer = new QVBoxLayout(content);
    outer->setContentsMargins(0, 0, 0, 0);
    ruleArea_->setLayout(rowLayout_);
    outer->addWidget(ruleHint_);
    outer->addWidget(ruleArea_);
    outer->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(content);
    scroll->setMinimumHeight(Spacing::control * 2 + Spacing::small);
    layout->addWidget(scroll, 1);
    return part;
}

QWidget* FilterPanel::makeQuery() {
    auto* part = new QWidget;
    auto* layout = new QVBoxLayout(part);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    layout->addWidget(label(tr("Query"), "title"));
    field_->setPlaceholderText(QStringLiteral("luminance > 20 * mean(luminance)"));
    QStringList names;
    for (const query::Quantity& quantity : query::coreQuantities()) names += toQString(quantity.expression);
    field_->setToolTip(tr("<p>An expression over one path. <b>Enter</b> selects, <b>Shift+Enter</b> begins a line.</p>"
                          "<p>Of a path, of its vertices (v.), contributions (c.) and shadow tests (n.): %1, and data such as v.`BSDF pdf`.</p>"
                          "<p>any, all, none, count, first, last, sum, mean, min, max, quantile; lpe(\"C.*DS+L\"); and, or, not.</p>")
                           .arg(names.join(QStringLiteral(", "))));
    layout->addWidget(field_);
    layout->addWidget(error_);
    layout->addWidget(count_);
    layout->addWidget(note_);
    return part;
}

void FilterPanel::addExamples() {
    auto* menu = new QMenu(examples_);
    menu->setToolTipsVisible(true);
    for (const Example& example : kExamples) {
        QAction* action = menu->addAction(tr(example.title));
        action->setToolTip(QString::fromUtf8(example.query));
        connect(action, &QAction::triggered, this, [this, example] { setQueryText(QString::fromUtf8(example.query)); });
    }
    examples_->setMenu(menu);
}

QString FilterPanel::queryText() const { return field_->toPlainText(); }

void FilterPanel::setQueryText(const QString& text) { field_->write(text); }

RuleRow& FilterPanel::makeRow() {
    auto* row = new RuleRow(model_->paths());
    rows_.push_back(row);
    rowLayout_->addWidget(row);
    row->show();
    connect(row, &RuleRow::changed, this, &FilterPanel::rulesChanged);
    connect(row, &RuleRow::removeWanted, this, [this, row] { removeRule(row); });
    return *row;
}

RuleRow& FilterPanel::addRule(const query::Rule& rule) {
    RuleRow& row = makeRow();
    updateRules();
    if (!rule.quantity.empty()) {
        row.setRule(rule);
        applyRules();
    }
    row.quantity().setFocus();
    emit edited();
    return row;
}

void FilterPanel::dropRow(RuleRow* row) {
    rows_.erase(std::remove(rows_.begin(), rows_.end(), row), rows_.end());
    row->hide();
    row->deleteLater();
}

void FilterPanel::removeRule(RuleRow* row) {
    dropRow(row);
    if (byHand_) updateRules();
    else applyRules();
    emit edited();
}

std::vector<query::Rule> FilterPanel::rules() const {
    std::vector<query::Rule> rules;
    for (const RuleRow* row : rows_) rules.push_back(row->rule());
    return rules;
}

void FilterPanel::rulesChanged() {
    applyRules();
    emit edited();
}

/// Writes the query that the rules stand for. While none is complete, what stands in the field is left alone.
void FilterPanel::applyRules() {
    const auto text = query::toQuery(rules(), model_->paths());
    ruleError_ = text ? QString() : tr("Rule: %1").arg(toQString(text.error().message));
    if (text && (!text->empty() || !ruleQuery_.isEmpty())) {
        ruleQuery_ = toQString(*text);
        const QScopedValueRollback<bool> guard(writing_, true);
        byHand_ = false;
        field_->write(ruleQuery_);
    }
    updateRules();
    showAnswer();
}

void FilterPanel::queryEdited() {
    model_->setQuery(field_->text());
    if (writing_) return;
    byHand_ = !rows_.empty() && queryText() != ruleQuery_;
    updateRules();
    emit edited();
}

void FilterPanel::backToRules() {
    byHand_ = false;
    rulesChanged();
}

/// What can be named, and whether the rules hold.
void FilterPanel::updateRules() {
    ruleHint_->setVisible(rows_.empty());
    ruleArea_->setEnabled(!byHand_);
    handNote_->setVisible(byHand_);
    add_->setEnabled(!byHand_);
    std::vector<CompletingField::Choice> choices;
    const auto add = [&](const query::Quantity& quantity, const QString& meaning) {
        choices.push_back({toQString(quantity.expression), meaning});
        for (const query::Quantity& part : query::partsOf(quantity)) choices.push_back({toQString(part.expression), meaning});
    };
    if (!rows_.empty()) {
        // What only this renderer knows comes first: the rest is the same everywhere.
        for (const query::Quantity& quantity : query::dataOf(model_->paths()))
            add(quantity, tr("recorded by the renderer: %1").arg(toQString(query::name(quantity.type))));
        for (const query::Quantity& quantity : query::coreQuantities()) add(quantity, toQString(quantity.meaning));
        for (RuleRow* row : rows_) row->setQuantities(choices);
    }
}

void FilterPanel::reload() {
    selectLater_ = false;
    model_->setPaths(dataset_.paths());
    for (RuleRow* row : rows_) row->refresh();
    if (!byHand_ && !rows_.empty()) applyRules();
    else updateRules();
    if (isAutomatic() && !dataset_.paths().empty() && model_->state() != FilterModel::State::empty) select();
}

QString FilterPanel::countText() const {
    const bool known = model_->state() == FilterModel::State::done || model_->state() == FilterModel::State::running;
    if (!known || model_->paths().empty()) return {};
    return tr("%1 of %2 paths").arg(grouped(model_->matches().paths.size()), grouped(model_->paths().pathCount()));
}

QString FilterPanel::noteText() const {
    switch (model_->state()) {
        case FilterModel::State::running: return tr("Counting …");
        case FilterModel::State::empty: return model_->paths().empty() ? tr("Click a pixel in the image.") : QString();
        case FilterModel::State::failed: return {};
        case FilterModel::State::done: break;
    }
    if (model_->paths().empty()) return tr("Click a pixel in the image.");
    QStringList parts;
    if (const Index unknown = model_->matches().unknown) parts += tr("%1 unknown: something that it reads was not recorded there.").arg(grouped(unknown));
    QStringList missing;
    for (const std::string& name : model_->matches().missing) missing += toQString(name);
    if (!missing.isEmpty()) parts += tr("No path has %1.").arg(missing.join(QStringLiteral(", ")));
    return parts.join(' ');
}

void FilterPanel::showAnswer() {
    const bool failed = model_->state() == FilterModel::State::failed;
    if (failed) field_->underline(model_->error().where);
    else field_->removeUnderline();
    QString error = ruleError_;
    if (failed) error = toQString(model_->error().message);
    if (!error.isEmpty()) error[0] = error[0].toUpper();
    if (!error.isEmpty() && !error.endsWith('.')) error += '.';
    const auto put = [](QLabel* where, const QString& text) {
        where->setText(text);
        where->setVisible(!text.isEmpty());
    };
    put(error_, error);
    put(count_, countText());
    put(note_, noteText());
    select_->setEnabled(model_->state() == FilterModel::State::running || (model_->state() == FilterModel::State::done && !model_->matches().paths.empty()));
    clear_->setEnabled(!queryText().isEmpty() || !rows_.empty());
    if (selectLater_ && model_->state() != FilterModel::State::running) select();
}

bool FilterPanel::isAutomatic() const { return automatic_->isChecked(); }

void FilterPanel::setAutomatic(bool automatic) { automatic_->setChecked(automatic); }

void FilterPanel::select() {
    selectLater_ = model_->state() == FilterModel::State::running;
    if (model_->state() != FilterModel::State::done) return;
    selection_.setPaths(pathIds(model_->paths(), model_->matches().paths));
}

client::SavedFilter FilterPanel::state() const {
    client::SavedFilter state{field_->text(), {}, byHand_, isAutomatic()};
    for (const query::Rule& rule : rules())
        state.rules.push_back({rule.quantity, static_cast<std::uint8_t>(rule.over), static_cast<std::uint8_t>(rule.op), rule.value});
    return state;
}

void FilterPanel::setState(const client::SavedFilter& state) {
    {
        const QScopedValueRollback<bool> guard(writing_, true);
        selectLater_ = false;
        // Rows that stay keep the focus.
        while (rows_.size() > state.rules.size()) dropRow(rows_.back());
        while (rows_.size() < state.rules.size()) makeRow();
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const client::SavedFilter::Rule& rule = state.rules[i];
            const query::Rule wanted{rule.quantity, static_cast<query::Quantifier>(rule.over), static_cast<query::RuleOperator>(rule.operation), rule.value};
            if (rows_[i]->rule() != wanted) rows_[i]->setRule(wanted);
        }
        const auto text = query::toQuery(rules(), model_->paths());
        ruleQuery_ = text ? toQString(*text) : QString();
        ruleError_.clear();
        byHand_ = state.byHand && !rows_.empty();
        field_->write(toQString(state.query));
        automatic_->setChecked(state.automatic);
    }
    updateRules();
    showAnswer();
    emit edited();
}

void FilterPanel::clear() {
    while (!rows_.empty()) dropRow(rows_.back());
    ruleQuery_.clear();
    ruleError_.clear();
    byHand_ = selectLater_ = false;
    {
        const QScopedValueRollback<bool> guard(writing_, true);
        field_->write({});
    }
    updateRules();
    showAnswer();
    selection_.clearPaths();
    emit edited();
}

}  // namespace emca::explorer
