#include "base/filter_menu.h"

#include <QMenu>
#include <QObject>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"

namespace emca::explorer {

using query::RuleOperator;

ValueRule valueRule(const std::string& quantity, RuleOperator op, const std::string& value, const QString& shown) {
    const QString sign = op == RuleOperator::greaterEqual ? QStringLiteral("≥") : op == RuleOperator::lessEqual ? QStringLiteral("≤") : QStringLiteral("=");
    QString title = toQString(quantity);
    if (op == RuleOperator::isTrue || op == RuleOperator::isFalse || op == RuleOperator::isNan || op == RuleOperator::isInfinite)
        title += ' ' + toQString(query::label(op));
    else title += ' ' + sign + ' ' + shown;
    return {title, {quantity, query::Quantifier::any, op, value}};
}

std::vector<ValueRule> rulesForNumber(const std::string& quantity, double value) {
    if (std::isnan(value)) return {valueRule(quantity, RuleOperator::isNan, {}, {})};
    if (std::isinf(value)) return {valueRule(quantity, RuleOperator::isInfinite, {}, {})};
    const std::string full = analysis::formatFull(value);
    const QString shown = toQString(analysis::formatNumber(value));
    return {valueRule(quantity, RuleOperator::greaterEqual, full, shown), valueRule(quantity, RuleOperator::lessEqual, full, shown),
            valueRule(quantity, RuleOperator::equal, full, shown)};
}

void addFilterMenu(QMenu& menu, const std::vector<ValueRule>& rules, std::function<void(const query::Rule&)> chosen) {
    if (rules.empty()) return;
    QMenu* below = menu.addMenu(QObject::tr("Filter by this value"));
    below->setObjectName(QStringLiteral("filterByValue"));
    for (const ValueRule& offered : rules) {
        QString title = offered.title;
        title.replace('&', QStringLiteral("&&"));
        QObject::connect(below->addAction(title), &QAction::triggered, below, [chosen, rule = offered.rule] { chosen(rule); });
    }
}

}  // namespace emca::explorer
