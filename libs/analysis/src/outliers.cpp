#include "emca/analysis/outliers.h"

#include <cmath>

#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"

namespace emca::analysis {

Result<OutlierReport> detectOutliers(std::span<const double> values, const OutlierOptions& options) {
    if (!(options.deviations > 0) || !std::isfinite(options.deviations))
        return Error{ErrorCode::invalidArgument,
                     "The number of standard deviations beyond which a path is an outlier is " +
                         formatNumber(options.deviations) + "; it must be positive."};
    const Summary summary = summarize(values);
    OutlierReport report;
    report.considered = summary.finite;
    report.notFinite = summary.count - summary.finite;
    report.mean = summary.mean;
    report.deviation = summary.deviation();
    report.lower = report.mean - options.deviations * report.deviation;
    report.upper = report.mean + options.deviations * report.deviation;
    // The mean of equal values may differ from them by rounding; they are no outliers of each other.
    const bool spread = summary.finite > 1 && summary.min < summary.max;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double v = values[i];
        const bool beyond = spread && (v > report.upper || (!options.upperOnly && v < report.lower));
        if (!std::isfinite(v) || beyond) report.outliers.push_back(static_cast<Index>(i));
    }
    return report;
}

Result<OutlierReport> detectOutliers(const PathSet& paths, const OutlierOptions& options) {
    const PathSeries series = pathSeries(paths, options.quantity);
    Result<OutlierReport> report = detectOutliers(std::span<const double>(series.values), options);
    if (!report) return report;
    report->withoutValue = paths.pathCount() - series.size();
    for (Index& i : report->outliers) i = series.paths[i];
    return report;
}

}  // namespace emca::analysis
