#pragma once

#include <QWidget>

#include "emca/core/path_set.h"
#include "emca/query/rules.h"
#include "paths/completing_field.h"

class QComboBox;
class QGridLayout;
class QToolButton;

namespace emca::explorer {

/// One rule as a form: for which vertices, quantity, operator, value. Operators are those of the quantity's type.
class RuleRow : public QWidget {
    Q_OBJECT
  public:
    /// \param paths  those that are shown; outlive the row
    explicit RuleRow(const PathSet& paths, QWidget* parent = nullptr);

    query::Rule rule() const;
    void setRule(const query::Rule& rule);
    void setQuantities(std::vector<CompletingField::Choice> choices) { quantity_->setChoices(std::move(choices)); }
    /// Other paths: types and texts may be others.
    void refresh();

    CompletingField& quantity() { return *quantity_; }
    CompletingField& value() { return *value_; }
    QComboBox& over() { return *over_; }
    QComboBox& op() { return *operator_; }
    QToolButton& removal() { return *remove_; }

  signals:
    void changed();
    void removeWanted();

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void arrange(bool wide);
    void fitOperators();
    const PathSet& paths_;
    QGridLayout* layout_;
    QComboBox* over_;
    CompletingField* quantity_;
    QComboBox* operator_;
    CompletingField* value_;
    QToolButton* remove_;
    int owner_ = -1;
    bool wide_ = false;
};

}  // namespace emca::explorer
