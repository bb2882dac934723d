#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "base/listeners.h"
#include "emca/client/session.h"
#include "emca/query/rules.h"
#include "paths/filter_model.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QScrollArea;
class QToolButton;
class QVBoxLayout;

namespace emca::explorer {

class QueryField;
class RuleRow;
class Theme;

/// Filters the paths of the shown pixel: rules, the query that they stand for (docs/queries.md), how many paths it
/// takes, and these as the selection of all views. A query that was edited by hand stands alone; the rules are greyed
/// until one goes back to them.
class FilterPanel : public QWidget {
    Q_OBJECT
  public:
    FilterPanel(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);

    QString queryText() const;
    void setQueryText(const QString& text);
    /// With the focus in it, ready to be changed.
    RuleRow& addRule(const query::Rule& rule = {});
    std::vector<query::Rule> rules() const;
    RuleRow& row(std::size_t i) { return *rows_[i]; }
    std::size_t rowCount() const { return rows_.size(); }
    /// The query was changed by hand, so that the rules do not say what it does.
    bool isEditedByHand() const { return byHand_; }
    void backToRules();

    bool isAutomatic() const;
    /// Selects what the query takes whenever another pixel is shown.
    void setAutomatic(bool automatic);
    /// Makes the paths that the query takes the selection; as soon as they are known.
    void select();
    void clear();

    /// All that a person chose here: what sessions and settings keep and what is undone.
    client::SavedFilter state() const;
    /// Selects nothing, whether or not it is automatic: only later pixels do.
    void setState(const client::SavedFilter& state);

    QueryField& field() { return *field_; }
    const FilterModel& model() const { return *model_; }
    QString countText() const;   ///< "12 of 1,024 paths"
    QString noteText() const;    ///< what is unknown or missing; the error
    /// Nothing is being computed.
    bool isSettled() const { return model_->state() != FilterModel::State::running; }

  signals:
    /// state() is another one. Where it comes with another selection, that is told first.
    void edited();

  private:
    void build();
    QWidget* makeRules();
    QWidget* makeQuery();
    void addExamples();
    void removeRule(RuleRow* row);
    void rulesChanged();
    void applyRules();
    RuleRow& makeRow();
    void dropRow(RuleRow* row);
    void queryEdited();
    void reload();
    void showAnswer();
    void updateRules();

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    FilterModel* model_;
    std::vector<RuleRow*> rows_;
    QVBoxLayout* rowLayout_;
    QWidget* ruleArea_;
    QLabel* ruleHint_;
    QWidget* handNote_;
    QToolButton* add_;
    QToolButton* examples_;
    QueryField* field_;
    QLabel *error_, *count_, *note_;
    QCheckBox* automatic_;
    QPushButton *select_, *clear_;
    QString ruleQuery_, ruleError_;
    bool writing_ = false, byHand_ = false, selectLater_ = false;
    DatasetListening datasetListening_;
};

}  // namespace emca::explorer
