#pragma once

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
};

struct OutlierOptions {
    OutlierMethod method = OutlierMethod::meanDeviation;
    PathQuantity quantity = PathQuantity::luminance;
    double deviations = 3;    ///< m of mean +- m * sigma; positive and finite
    bool upperOnly = false;   ///< ignore values below
};

struct OutlierReport {
    std::vector<Index> outliers;  ///< positions (in the PathSet or in the values), ascending, each once
    std::size_t considered = 0;   ///< finite values that entered mean and deviation
    std::size_t notFinite = 0;    ///< NaN and infinite: always among the outliers, never in mean and deviation
    std::size_t withoutValue = 0; ///< paths that have no final estimate: never outliers
    double mean = 0, deviation = 0;
    double lower = 0, upper = 0;  ///< limits; values on them are no outliers
};

/// Paths whose quantity stands out. With fewer than two finite values only NaN and infinite ones are outliers.
/// Errors: invalidArgument (deviations).
Result<OutlierReport> detectOutliers(const PathSet& paths, const OutlierOptions& options = {});
/// The same on any values; `quantity` is not read.
Result<OutlierReport> detectOutliers(std::span<const double> values, const OutlierOptions& options = {});

}  // namespace emca::analysis
