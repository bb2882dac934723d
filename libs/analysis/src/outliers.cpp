#include "emca/analysis/outliers.h"

#include <cmath>

#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"
#include "generalized_esd.h"

namespace emca::analysis {

namespace {

Result<void> checkEsd(const OutlierOptions& options) {
    if (options.maximum < 1)
        return Error{ErrorCode::invalidArgument, "The test is to look for at most 0 outliers; it must be 1 or more."};
    if (options.significance > 0 && options.significance < 1) return {};
    return Error{ErrorCode::invalidArgument,
                 "The significance of the test for outliers is " + formatNumber(options.significance) + "; it must be between 0 and 1, as 0.05 is."};
}

}  // namespace

Result<OutlierReport> detectOutliers(std::span<const double> values, const OutlierOptions& options) {
    if (options.method == OutlierMethod::generalizedEsd) {
        if (const Result<void> valid = checkEsd(options); !valid) return valid.error();
        return generalizedEsd(values, options);
    }
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
    for (EsdStep& step : report->steps) step.index = series.paths[step.index];
    return report;
}

}  // namespace emca::analysis
