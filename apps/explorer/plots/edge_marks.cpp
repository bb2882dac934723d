#include "plots/edge_marks.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "plots/points_item.h"

namespace emca::explorer {
namespace {

struct Mark {
    std::uint32_t point = 0;
    QPointF at;
    bool selected = false, current = false;
    double weight = 0;  ///< how far beyond
};

/// Stretches of a row that have something on them.
class Taken {
  public:
    bool free(double from, double to) const {
        return std::none_of(spans_.begin(), spans_.end(), [&](auto s) { return from < s.second && to > s.first; });
    }
    void take(double from, double to) { spans_.emplace_back(from, to); }

  private:
    std::vector<std::pair<double, double>> spans_;
};

std::vector<Mark> marksOf(const ScatterContent& content, PlotRow row) {
    std::vector<Mark> marks;
    for (std::uint32_t i = 0; i < content.xs.size(); ++i) {
        const double y = content.ys[i];
        if (content.frame.row(y) != row) continue;
        const std::optional<QPointF> at = content.frame.place(content.xs[i], y);
        if (!at) continue;
        const bool current = content.current && *content.current == i;
        marks.push_back({i, *at, content.isSelected(i), current, std::isnan(y) ? 0 : std::abs(y)});
    }
    std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) {
        if (a.current != b.current) return a.current;
        if (a.selected != b.selected) return a.selected;
        return a.weight > b.weight;
    });
    return marks;
}

QPainterPath arrow(QPointF at, bool up) {
    const double s = up ? 1 : -1;
    QPainterPath path;
    path.moveTo(at + QPointF(0, -5 * s));
    path.lineTo(at + QPointF(4.5, 3.5 * s));
    path.lineTo(at + QPointF(-4.5, 3.5 * s));
    path.closeSubpath();
    return path;
}

class RowPainter {
  public:
    RowPainter(QPainter& painter, const ScatterContent& content, const Theme& theme)
        : painter_(painter), content_(content), theme_(theme), c_(theme.colors()), metrics_(theme.smallNumberFont()) {}

    void paint(PlotRow row) {
        const std::vector<Mark> marks = marksOf(content_, row);
        Taken symbols, labels;
        // The least important first, so that selected marks end on top.
        for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark) symbol(*mark, row);
        for (const Mark& mark : marks) {
            if (hasWord(mark)) continue;
            if (symbols.free(mark.at.x() - 1, mark.at.x() + 1)) symbols.take(mark.at.x() - 5, mark.at.x() + 5);
        }
        constexpr int kLabels = 12;
        int shown = 0;
        for (const Mark& mark : marks) {
            if (shown == kLabels) break;
            if (wantsLabel(mark) && label(mark, symbols, labels)) ++shown;
        }
    }

  private:
    double value(const Mark& mark) const { return content_.ys[mark.point]; }
    bool hasWord(const Mark& mark) const { return !std::isfinite(value(mark)); }
    /// 0 and negative values of a logarithmic axis: the axis names their row, there may be hundreds.
    bool isCommon(const Mark& mark) const { return content_.frame.y().range.log && value(mark) <= 0; }
    bool wantsLabel(const Mark& mark) const { return !isCommon(mark) || (mark.selected && value(mark) != 0); }

    QColor colorOf(const Mark& mark) const {
        if (mark.selected) return c_.selected;
        if (hasWord(mark)) return c_.warning;
        QColor color = content_.colorOf(mark.point);
        if (!content_.selected.empty()) color.setAlphaF(0.4);
        return color;
    }

    void symbol(const Mark& mark, PlotRow row) {
        painter_.setPen(mark.selected ? QPen(c_.halo, 1) : QPen(Qt::NoPen));
        painter_.setBrush(colorOf(mark));
        if (hasWord(mark)) {
            painter_.fillRect(QRectF(mark.at.x() - 0.75, mark.at.y() - 6, 1.5, 12), colorOf(mark));
        } else if (isCommon(mark)) {
            const double r = PointsItem::radius(content_.xs.size()) + (mark.selected ? 1 : 0);
            painter_.drawEllipse(mark.at, r, r);
        } else {
            painter_.drawPath(arrow(mark.at, row == PlotRow::above));
        }
    }

    QString textOf(const Mark& mark) const {
        const double y = value(mark);
        if (std::isnan(y)) return QStringLiteral("NaN");
        if (std::isinf(y)) return y > 0 ? QStringLiteral("Inf") : QStringLiteral("−Inf");
        return toQString(analysis::formatNumber(y));
    }

    bool label(const Mark& mark, const Taken& symbols, Taken& labels) {
        const QString text = textOf(mark);
        const double width = metrics_.horizontalAdvance(text), gap = mark.current ? 12 : 7;
        for (const bool right : {true, false}) {
            const double from = right ? mark.at.x() + gap : mark.at.x() - gap - width;
            if (from < 2 || from + width > content_.frame.canvas().width() - 2) continue;
            if (!symbols.free(from, from + width) || !labels.free(from - 4, from + width + 4)) continue;
            labels.take(from, from + width);
            painter_.setFont(theme_.smallNumberFont());
            painter_.setPen(mark.selected ? c_.selected : hasWord(mark) ? c_.warning : c_.text);
            const double h = PlotFrame::kRowHeight;
            painter_.drawText(QRectF(from, mark.at.y() - h / 2, width + 1, h), Qt::AlignLeft | Qt::AlignVCenter, text);
            return true;
        }
        return false;
    }

    QPainter& painter_;
    const ScatterContent& content_;
    const Theme& theme_;
    const ThemeColors& c_;
    QFontMetricsF metrics_;
};

}  // namespace

void paintEdgeMarks(QPainter& painter, const ScatterContent& content, const Theme& theme) {
    RowPainter rows(painter, content, theme);
    if (content.frame.rows().above) rows.paint(PlotRow::above);
    if (content.frame.rows().below) rows.paint(PlotRow::below);
    if (content.frame.rows().nan) rows.paint(PlotRow::nan);
}

}  // namespace emca::explorer
