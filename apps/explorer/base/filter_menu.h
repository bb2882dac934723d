#pragma once

#include <QString>
#include <functional>
#include <string>
#include <vector>

#include "emca/query/rules.h"

class QMenu;

namespace emca::explorer {

/// A condition that a value offers for the filter: it holds for the path that the value is of.
struct ValueRule {
    QString title;         ///< "luminance ≥ 4.120"
    query::Rule rule;      ///< with the value in full
};

/// \param shown  the value as people read it; not used where the operator needs none
ValueRule valueRule(const std::string& quantity, query::RuleOperator op, const std::string& value, const QString& shown);

/// Of a number that a view shows: at least, at most, equal; NaN and infinite ones by their word.
/// \param quantity  as a query names it
std::vector<ValueRule> rulesForNumber(const std::string& quantity, double value);

/// "Filter by this value" with the conditions below it; nothing if there are none.
void addFilterMenu(QMenu& menu, const std::vector<ValueRule>& rules, std::function<void(const query::Rule&)> chosen);

}  // namespace emca::explorer
