#include "parallel/parallel_axes.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "emca/analysis/path_quantities.h"
#include "emca/query/vocabulary.h"

namespace emca::explorer {
namespace {

using query::ExpressionType;

/// Unit of a core quantity, of one of its components, or of a reduction that keeps it.
QString unitOf(QString x) {
    for (const char* reduction : {"max(", "min(", "mean(", "sum(", "first(", "last(", "luminance("})
        if (x.startsWith(QLatin1String(reduction)) && x.endsWith(')')) x = x.mid(int(qstrlen(reduction)), x.size() - int(qstrlen(reduction)) - 1);
    const QString whole = x.section('.', 0, x.startsWith("v.") || x.startsWith("c.") ? 1 : 0);
    static const QStringList kRadiance{"luminance", "estimate", "v.luminance", "v.estimate", "v.emission", "c.luminance", "c.value"};
    if (kRadiance.contains(whole)) return toQString(analysis::unit(analysis::PathQuantity::luminance));
    if (x == QLatin1String("v.segment") || whole == QLatin1String("v.position") || whole == QLatin1String("origin")) return QStringLiteral("scene units");
    return {};
}

}  // namespace

QString ParallelAxis::valueText(Index path) const {
    if (!error.isEmpty() || path >= values.size() || !values.known[path]) return QObject::tr("not recorded");
    const double value = values.numbers[path];
    if (isText()) return toQString(values.categories[static_cast<std::size_t>(value)]);
    if (values.integral && std::abs(value) < 1e15) return toQString(analysis::formatInteger(std::llround(value)));
    return toQString(analysis::formatNumber(value));
}

std::vector<AxisWish> ParallelAxes::defaults() {
    return {{"sample"}, {"depth"}, {"max(c.luminance)", true}, {"luminance", true}, {"min(v.segment)", true}, {"last(v.event)"}};
}

void ParallelAxes::setPaths(const PathSet& paths) {
    paths_ = paths;
    for (ParallelAxis& axis : axes_) {
        axis.brushes.clear();   // categories may be others
        evaluate(axis);
    }
}

void ParallelAxes::evaluate(ParallelAxis& axis) const {
    axis.error.clear();
    auto values = query::axisValues(*axis.parsed, paths_);
    if (!values) axis.error = toQString(values.error().message);
    axis.values = values ? std::move(*values) : query::AxisValues{};
    axis.values.integral &= axis.unit.isEmpty();   // radiance is no count, even where it happens to be 1 and 2
    scale(axis);
}

void ParallelAxes::scale(ParallelAxis& axis) const {
    analysis::AxisScaleOptions options;
    options.log = axis.isLog();
    options.integral = axis.values.integral;
    options.categories = static_cast<std::uint32_t>(axis.values.categories.size());
    options.includeZero = !axis.unit.isEmpty() && axis.wish.expression != QLatin1String("origin");
    axis.scale = analysis::axisScale(axis.values.numbers, axis.values.known, options);
}

void ParallelAxes::setWishes(const std::vector<AxisWish>& wishes) {
    axes_.clear();
    for (const AxisWish& wish : wishes) (void)add(wish);
}

std::vector<AxisWish> ParallelAxes::wishes() const {
    std::vector<AxisWish> wishes;
    for (const ParallelAxis& axis : axes_) wishes.push_back(axis.wish);
    return wishes;
}

Result<void> ParallelAxes::add(const AxisWish& wish) {
    if (axes_.size() >= kMost)
        return Error{ErrorCode::tooLarge, "There are " + std::to_string(kMost) + " axes already: remove one first."};
    auto parsed = query::Query::parse(wish.expression.trimmed().toStdString());
    if (!parsed) return parsed.error();
    ParallelAxis axis;
    axis.wish = wish;
    axis.wish.expression = wish.expression.trimmed();
    axis.parsed = std::move(*parsed);
    axis.unit = unitOf(axis.wish.expression);
    evaluate(axis);
    if (!axis.error.isEmpty()) return Error{ErrorCode::parseFailed, axis.error.toStdString()};
    axes_.push_back(std::move(axis));
    return {};
}

void ParallelAxes::remove(std::size_t axis) { axes_.erase(axes_.begin() + std::ptrdiff_t(axis)); }

void ParallelAxes::move(std::size_t from, std::size_t to) {
    const auto at = [&](std::size_t i) { return axes_.begin() + std::ptrdiff_t(i); };
    if (from < to) std::rotate(at(from), at(from + 1), at(to + 1));
    else std::rotate(at(to), at(from), at(from + 1));
}

void ParallelAxes::setLog(std::size_t axis, bool log) {
    axes_[axis].wish.log = log;
    scale(axes_[axis]);
}

void ParallelAxes::setFlipped(std::size_t axis, bool flipped) { axes_[axis].wish.flipped = flipped; }

void ParallelAxes::setBrushes(std::size_t axis, std::vector<query::Brush> brushes) { axes_[axis].brushes = std::move(brushes); }

void ParallelAxes::clearBrushes() {
    for (ParallelAxis& axis : axes_) axis.brushes.clear();
}

bool ParallelAxes::hasBrushes() const {
    return std::any_of(axes_.begin(), axes_.end(), [](const ParallelAxis& axis) { return !axis.brushes.empty(); });
}

std::vector<Index> ParallelAxes::brushed() const {
    std::vector<query::BrushedAxis> all;
    for (const ParallelAxis& axis : axes_) all.push_back({&axis.values, axis.brushes});
    return query::brushedPaths(all, paths_.pathCount());
}

QString ParallelAxes::condition(std::size_t axis) const {
    QStringList parts;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if ((axis != kAll && axis != i) || axes_[i].brushes.empty()) continue;
        parts += toQString(query::brushQuery(axes_[i].wish.expression.toStdString(), axes_[i].values, axes_[i].brushes));
    }
    return parts.join(QStringLiteral(" and "));
}

std::optional<std::vector<query::Rule>> ParallelAxes::rules(std::size_t axis) const {
    std::vector<query::Rule> all;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if ((axis != kAll && axis != i) || axes_[i].brushes.empty()) continue;
        const auto rules = query::brushRules(axes_[i].wish.expression.toStdString(), axes_[i].values, axes_[i].brushes);
        if (!rules) return std::nullopt;
        all.insert(all.end(), rules->begin(), rules->end());
    }
    return all;
}

QString ParallelAxes::csv() const {
    const auto quoted = [](const QString& text) {
        static const QString kSpecial = QStringLiteral(",\"\n\r");
        const bool plain = std::none_of(text.begin(), text.end(), [&](QChar c) { return kSpecial.contains(c); });
        return plain ? text : '"' + QString(text).replace('"', QStringLiteral("\"\"")) + '"';
    };
    QString text = QStringLiteral("pixel x,pixel y,sample,part");
    for (const ParallelAxis& axis : axes_) text += ',' + quoted(axis.wish.expression);
    text += '\n';
    for (Index path = 0; path < paths_.pathCount(); ++path) {
        const Pixel pixel = paths_.pixel(path);
        text += QStringLiteral("%1,%2,%3,%4").arg(pixel.x).arg(pixel.y).arg(paths_.sample(path)).arg(paths_.part(path));
        for (const ParallelAxis& axis : axes_) {
            text += ',';
            if (path >= axis.values.size() || !axis.values.known[path]) continue;
            text += axis.isText() ? quoted(axis.valueText(path)) : toQString(analysis::formatFull(axis.values.numbers[path]));
        }
        text += '\n';
    }
    return text;
}

QString toText(const std::vector<AxisWish>& wishes) {
    QJsonArray all;
    for (const AxisWish& wish : wishes) {
        QJsonObject one{{"expression", wish.expression}};
        if (wish.log) one["log"] = true;
        if (wish.flipped) one["flipped"] = true;
        all.append(one);
    }
    return QString::fromUtf8(QJsonDocument(all).toJson(QJsonDocument::Compact));
}

std::vector<AxisWish> wishesFrom(const QString& text) {
    std::vector<AxisWish> wishes;
    for (const QJsonValue& value : QJsonDocument::fromJson(text.toUtf8()).array()) {
        const QJsonObject one = value.toObject();
        if (const QString expression = one["expression"].toString(); !expression.isEmpty())
            wishes.push_back({expression, one["log"].toBool(), one["flipped"].toBool()});
    }
    return wishes;
}

std::vector<AxisSuggestion> axisSuggestions(const PathSet& paths) {
    std::vector<AxisSuggestion> all;
    const auto add = [&](const QString& expression, const QString& meaning) { all.push_back({expression, meaning}); };
    const auto suggest = [&](const query::Quantity& quantity, const QString& meaning) {
        const QString x = toQString(quantity.expression);
        if (quantity.type == ExpressionType::spectrum) return;
        if (quantity.owner == query::Owner::path) return add(x, meaning);
        const QString of = quantity.owner == query::Owner::vertex ? QObject::tr("of the vertices")
                           : quantity.owner == query::Owner::contribution ? QObject::tr("of the contributions") : QObject::tr("of the shadow tests");
        const auto reduced = [&](const char* function, const QString& word) {
            add(QStringLiteral("%1(%2)").arg(QLatin1String(function), x), QStringLiteral("%1 %2: %3").arg(word, of, meaning));
        };
        if (quantity.type == ExpressionType::text) {
            reduced("first", QObject::tr("first"));
            reduced("last", QObject::tr("last"));
        } else if (quantity.type == ExpressionType::boolean) {
            reduced("any", QObject::tr("at any"));
            reduced("count", QObject::tr("how many"));
        } else {
            reduced("max", QObject::tr("largest"));
            reduced("min", QObject::tr("smallest"));
            reduced("mean", QObject::tr("mean"));
            reduced("last", QObject::tr("last"));
        }
    };
    const auto parts = [&](const query::Quantity& quantity, const QString& meaning) {
        const std::vector<query::Quantity> inside = query::partsOf(quantity);
        if (inside.empty()) suggest(quantity, meaning);
        for (const query::Quantity& part : inside) suggest(part, meaning);
    };
    // What only this renderer knows comes first: the rest is the same everywhere.
    for (const query::Quantity& quantity : query::dataOf(paths)) parts(quantity, QObject::tr("recorded by the renderer"));
    for (const query::Quantity& quantity : query::coreQuantities()) parts(quantity, toQString(quantity.meaning));
    return all;
}

}  // namespace emca::explorer
