#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emca/analysis/path_quantities.h"
#include "emca/core/path_set.h"
#include "emca/core/result.h"

namespace emca::analysis {

/// How outliers are told from the rest. The numbers are stable (settings, scripts).
enum class OutlierMethod : std::uint8_t {
    meanDeviation = 0,  ///< beyond mean +- deviations * (unbiased) standard deviation
    /// Generalized extreme studentized deviate test: how many of at most `maximum` are outliers, if the rest is normal.
    /// Outliers do not hide each other, as they do where they widen the deviation that they are measured by.
    /// Source: B. Rosner, "Percentage Points for a Generalized ESD Many-Outlier Procedure", Technometrics 25(2), 1983.
    generalizedEsd = 1,
};

struct OutlierOptions {
    OutlierMethod method = OutlierMethod::meanDeviation;
    PathQuantity quantity = PathQuantity::luminance;
    double deviations = 3;    ///< m of mean +- m * sigma; positive and finite
    bool upperOnly = false;   ///< ignore values below; generalizedEsd: the one-sided test
    std::size_t maximum = 10;    ///< generalizedEsd: r, at least 1; never more than the smaller half of the values
    double significance = 0.05;  ///< generalizedEsd: alpha, the chance to find any where there is none; in (0, 1)
};

/// Step i of the generalized ESD test (counted from 1): the value farthest from the mean of those that are left.
struct EsdStep {
    Index index = 0;          ///< position, as in OutlierReport::outliers
    double value = 0;
    double mean = 0, deviation = 0;   ///< of the values that were left, this one included
    double statistic = 0;     ///< R_i = |value - mean| / deviation
    double critical = 0;      ///< lambda_i
    bool significant() const { return statistic > critical; }
};

struct OutlierReport {
    std::vector<Index> outliers;  ///< positions (in the PathSet or in the values), ascending, each once
    std::size_t considered = 0;   ///< finite values that entered mean and deviation
    std::size_t notFinite = 0;    ///< NaN and infinite: always among the outliers, never in mean and deviation
    std::size_t withoutValue = 0; ///< paths that have no final estimate: never outliers
    double mean = 0, deviation = 0;  ///< meanDeviation: of all finite values; generalizedEsd: of those that are no outliers
    double lower = 0, upper = 0;  ///< limits; values on them are no outliers. generalizedEsd: the extremes of the others,
                                  ///< so that values equal to a limit may be outliers if not all of them were tested
    std::vector<EsdStep> steps;   ///< generalizedEsd: in the order of removal, outliers or not; at most `maximum`
    /// generalizedEsd: every value that was tested is an outlier, so that there may be more of them.
    bool maximumReached() const { return !steps.empty() && outliers.size() - notFinite == steps.size(); }
};

/// Paths whose quantity stands out. With fewer than two finite values only NaN and infinite ones are outliers; for
/// generalizedEsd these are fewer than three. Takes O(n + r log r) for n values and r = `maximum`.
/// Errors: invalidArgument (deviations; maximum, significance).
Result<OutlierReport> detectOutliers(const PathSet& paths, const OutlierOptions& options = {});
/// The same on any values; `quantity` is not read.
Result<OutlierReport> detectOutliers(std::span<const double> values, const OutlierOptions& options = {});

/// The outliers of one pixel among several.
struct PixelOutliers {
    Pixel pixel;
    OutlierReport report;   ///< indices are positions in the PathSet
};
/// Each path against the paths of its own pixel: in a region, where the pixels of a lamp are brighter than all others, these
/// are the paths that make noise. One entry for each pixel that has paths, in their order. Errors: as detectOutliers.
Result<std::vector<PixelOutliers>> detectOutliersPerPixel(const PathSet& paths, const OutlierOptions& options = {});

}  // namespace emca::analysis
