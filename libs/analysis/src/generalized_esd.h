#pragma once

#include <cstddef>
#include <span>

#include "emca/analysis/outliers.h"

namespace emca::analysis {

/// Rosner's critical value lambda_i for n values, 1 <= i <= n - 2 (1983):
/// (n - i) t / sqrt((n - i - 1 + t^2) (n - i + 1)), where Student's t with n - i - 1 degrees of freedom exceeds t with
/// probability alpha / (2 (n - i + 1)); one-sided: alpha / (n - i + 1).
double esdCritical(std::size_t n, std::size_t i, double alpha, bool oneSided);

/// All of a report but `withoutValue`. The options have been checked.
OutlierReport generalizedEsd(std::span<const double> values, const OutlierOptions& options);

}  // namespace emca::analysis
