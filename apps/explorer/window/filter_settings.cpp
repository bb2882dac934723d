#include "window/filter_settings.h"

#include <QSettings>
#include <QStringList>

#include "base/qt_compat.h"

namespace emca::explorer {
namespace {

constexpr int kFields = 4;         // quantity, over, operator, value
constexpr int kMostRules = 1000;   // nobody wrote more

}  // namespace

client::SavedFilter readFilter(const QSettings& settings) {
    client::SavedFilter filter;
    filter.query = settings.value("filter/query").toString().toStdString();
    filter.byHand = settings.value("filter/byHand").toBool();
    filter.automatic = settings.value("filter/automatic").toBool();
    const QStringList texts = settings.value("filter/rules").toStringList();
    for (int i = 0; i + kFields <= texts.size() && i < kMostRules * kFields; i += kFields)
        filter.rules.push_back({texts[i].toStdString(), static_cast<std::uint8_t>(texts[i + 1].toUInt()),
                                static_cast<std::uint8_t>(texts[i + 2].toUInt()), texts[i + 3].toStdString()});
    return filter;
}

void writeFilter(QSettings& settings, const client::SavedFilter& filter) {
    QStringList texts;
    for (const client::SavedFilter::Rule& rule : filter.rules)
        texts << toQString(rule.quantity) << QString::number(rule.over) << QString::number(rule.operation) << toQString(rule.value);
    settings.setValue("filter/query", toQString(filter.query));
    settings.setValue("filter/rules", texts);
    settings.setValue("filter/byHand", filter.byHand);
    settings.setValue("filter/automatic", filter.automatic);
}

}  // namespace emca::explorer
