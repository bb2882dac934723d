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

namespace {

/// Of some neighbours in a series. \param paths  how many there are with and without a value
Result<OutlierReport> detectIn(const PathSeries& series, std::size_t first, std::size_t last, std::size_t paths, const OutlierOptions& options) {
    Result<OutlierReport> report = detectOutliers(std::span<const double>(series.values).subspan(first, last - first), options);
    if (!report) return report;
    report->withoutValue = paths - (last - first);
    for (Index& i : report->outliers) i = series.paths[first + i];
    for (EsdStep& step : report->steps) step.index = series.paths[first + step.index];
    return report;
}

}  // namespace

Result<OutlierReport> detectOutliers(const PathSet& paths, const OutlierOptions& options) {
    const PathSeries series = pathSeries(paths, options.quantity);
    return detectIn(series, 0, series.size(), paths.pathCount(), options);
}

Result<std::vector<PixelOutliers>> detectOutliersPerPixel(const PathSet& paths, const OutlierOptions& options) {
    // So that wrong options are an error whether there are paths or not.
    if (const auto valid = detectOutliers(std::span<const double>(), options); !valid) return valid.error();
    const PathSeries series = pathSeries(paths, options.quantity);
    std::vector<PixelOutliers> result;
    std::size_t first = 0, last = 0;   // of the series; paths are in the order of pixels
    for (Index begin = 0, end = 0; begin < paths.pathCount(); begin = end, first = last) {
        const Pixel pixel = paths.pixel(begin);
        while (end < paths.pathCount() && paths.pixel(end) == pixel) ++end;
        while (last < series.size() && series.paths[last] < end) ++last;
        auto report = detectIn(series, first, last, end - begin, options);
        if (!report) return report.error();
        result.push_back({pixel, std::move(report).value()});
    }
    return result;
}

}  // namespace emca::analysis
