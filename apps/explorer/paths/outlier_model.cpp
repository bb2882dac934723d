#include "paths/outlier_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/path_ids.h"
#include "base/qt_compat.h"
#include "base/table_text.h"
#include "emca/analysis/format.h"
#include "paths/path_entries.h"

namespace emca::explorer {

void OutlierModel::add(const PathSet& paths, const analysis::OutlierReport& report, analysis::PathQuantity quantity) {
    tested_ = tested_ || !report.steps.empty();
    const bool several = severalPixels(paths);
    for (const Index path : report.outliers) {
        const double value =
            analysis::pathValue(paths, path, quantity).value_or(std::numeric_limits<double>::quiet_NaN());
        const double deviations = report.deviation > 0 && std::isfinite(value)
                                      ? (value - report.mean) / report.deviation
                                      : std::numeric_limits<double>::quiet_NaN();
        const auto step = std::find_if(report.steps.begin(), report.steps.end(),
                                       [path](const analysis::EsdStep& s) { return s.index == path; });
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        found_.push_back({pathId(paths, path), pathText(paths, path, several), value, deviations,
                          step == report.steps.end() ? kNone : step->statistic,
                          step == report.steps.end() ? kNone : step->critical});
    }
}

void OutlierModel::setReports(const PathSet& paths, std::span<const analysis::PixelOutliers> reports, analysis::PathQuantity quantity) {
    beginResetModel();
    found_.clear();
    tested_ = false;
    for (const analysis::PixelOutliers& one : reports) add(paths, one.report, quantity);
    const auto rank = [](const Found& f) {
        return std::isfinite(f.deviations) ? std::abs(f.deviations) : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(found_.begin(), found_.end(), [&](const Found& a, const Found& b) { return rank(a) > rank(b); });
    const std::string_view unit = analysis::unit(quantity);
    quantity_ = toQString(analysis::label(quantity));
    if (!unit.empty()) quantity_ += QStringLiteral(", ") + toQString(unit);
    endResetModel();
}

std::vector<client::PathId> OutlierModel::ids() const {
    std::vector<client::PathId> ids;
    for (const Found& found : found_) ids.push_back(found.id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

QVariant OutlierModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Found& found = found_[static_cast<std::size_t>(index.row())];
    if (role == Qt::TextAlignmentRole)
        return int(Qt::AlignVCenter | (index.column() == kPath ? Qt::AlignLeft : Qt::AlignRight));
    if (role == kCopyRole && index.column() == kValue) return toQString(analysis::formatFull(found.value));
    if (role != Qt::DisplayRole) return {};
    switch (index.column()) {
        case kPath:
            return found.name;
        case kValue:
            return toQString(analysis::formatNumber(found.value));
        case kDeviations:
            if (tested_)
                return std::isfinite(found.statistic) ? toQString(analysis::formatNumber(found.statistic)) + QStringLiteral(" > ") +
                                                            toQString(analysis::formatNumber(found.critical))
                                                      : QStringLiteral("–");
            if (!std::isfinite(found.deviations)) return QStringLiteral("–");
            return QString(found.deviations < 0 ? QStringLiteral("−") : QStringLiteral("+")) +
                   toQString(analysis::formatNumber(std::abs(found.deviations))) + QStringLiteral(" σ");
        default:
            return {};
    }
}

QVariant OutlierModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole)
        return int(Qt::AlignVCenter | (section == kPath ? Qt::AlignLeft : Qt::AlignRight));
    if (role == Qt::ToolTipRole)
        return section == kPath    ? tr("Sample index; with several pixels, pixel too")
               : section == kValue ? tr("%1; radiance in W/(sr m²), depth in vertices").arg(quantity_)
               : tested_           ? tr("Statistic R of the generalized ESD test and the limit that it exceeds, in standard deviations")
                                   : tr("Distance from the mean in standard deviations σ");
    if (role != Qt::DisplayRole) return {};
    switch (section) {
        case kPath:
            return QStringLiteral("Path");
        case kValue:
            return quantity_;
        case kDeviations:
            return tested_ ? QStringLiteral("R > limit") : QStringLiteral("deviation");
        default:
            return {};
    }
}

}  // namespace emca::explorer
