#include "plots/plot_axis.h"

#include <qwt_plot.h>
#include <qwt_scale_engine.h>
#include <qwt_scale_widget.h>
#include <qwt_text.h>

#include <cstdlib>

#include "base/qt_compat.h"
#include "base/theme.h"

namespace emca::explorer {

QString tickText(const std::string& label) {
    const QString text = toQString(label);
    const int e = text.indexOf(QLatin1Char('e'));
    if (e < 0) return text;
    const int exponent = text.mid(e + 1).toInt();
    const QString mantissa = text.left(e);
    if (exponent >= -3 && exponent <= 3 && mantissa.size() <= 2)
        return QString::number(text.toDouble(), 'f', exponent < 0 ? -exponent : 0);
    static const QString kRaised = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    QString power = exponent < 0 ? QStringLiteral("⁻") : QString();
    for (const QChar digit : QString::number(std::abs(exponent))) power += kRaised[digit.digitValue()];
    const QString ten = QStringLiteral("10") + power;
    if (mantissa == QLatin1String("1")) return ten;
    if (mantissa == QLatin1String("-1")) return QStringLiteral("-") + ten;
    return mantissa + QStringLiteral("·") + ten;
}

PlotAxisDraw::PlotAxisDraw(bool labels) {
    enableComponent(Backbone, false);
    enableComponent(Ticks, false);
    enableComponent(Labels, labels);
    setSpacing(6);
}

void PlotAxisDraw::setLabels(const std::vector<analysis::Tick>& ticks, std::vector<EdgeLabel> edges) {
    labels_ = std::move(edges);
    for (const analysis::Tick& tick : ticks)
        if (tick.major) labels_.push_back({tick.value, tickText(tick.label), QColor()});
    invalidateCache();
}

QwtText PlotAxisDraw::label(double value) const {
    for (const EdgeLabel& label : labels_) {
        if (label.value != value) continue;
        QwtText text(label.text);
        if (label.color.isValid()) text.setColor(label.color);
        return text;
    }
    return QwtText(QString());
}

void applyAxis(QwtPlot& plot, int axis, const analysis::ValueRange& spanned, const std::vector<analysis::Tick>& ticks,
               std::vector<EdgeLabel> edges) {
    const bool log = plot.axisScaleEngine(axis)->transformation() != nullptr;
    if (spanned.log != log) {
        if (spanned.log) {
            plot.setAxisScaleEngine(axis, new QwtLogScaleEngine);
        } else {
            plot.setAxisScaleEngine(axis, new QwtLinearScaleEngine);
        }
    }
    QList<double> major, minor;
    for (const analysis::Tick& tick : ticks) (tick.major ? major : minor).append(tick.value);
    for (const EdgeLabel& edge : edges) major.append(edge.value);
    QwtScaleDiv division(spanned.min, spanned.max);
    division.setTicks(QwtScaleDiv::MajorTick, major);
    division.setTicks(QwtScaleDiv::MinorTick, minor);
    auto* draw = static_cast<PlotAxisDraw*>(plot.axisScaleDraw(axis));
    draw->setLabels(ticks, std::move(edges));
    plot.setAxisScaleDiv(axis, division);
}

void styleAxis(QwtPlot& plot, int axis, const QString& title, const Theme& theme) {
    plot.setAxisFont(axis, theme.smallNumberFont());
    QwtText text(title);
    text.setFont(theme.smallFont());
    text.setColor(theme.colors().mutedText);
    plot.setAxisTitle(axis, text);
    QPalette palette = plot.axisWidget(axis)->palette();
    for (const auto role : {QPalette::WindowText, QPalette::Text}) palette.setColor(role, theme.colors().mutedText);
    plot.axisWidget(axis)->setPalette(palette);
    plot.axisWidget(axis)->setMargin(0);
    plot.axisWidget(axis)->setSpacing(6);
}

}  // namespace emca::explorer
