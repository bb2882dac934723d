#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emca/query/query.h"
#include "emca/query/rules.h"

/// Quantities of paths as axes (parallel coordinates, plots over anything), and what a person marks on them.
/// Source: Inselberg, "The plane with parallel coordinates", The Visual Computer 1(2), 1985; brushes that are joined by
/// and: Martin and Ward, "High Dimensional Brushing for Interactive Exploration of Multivariate Data", IEEE Vis 1995.
namespace emca::query {

/// One number per path.
struct AxisValues {
    ExpressionType type = ExpressionType::missing;  ///< number, boolean or text; missing: no path has it
    std::vector<double> numbers;           ///< booleans: 0 and 1; texts: place in `categories`; NaN is a value
    std::vector<std::uint8_t> known;       ///< 1 per path that has a value
    std::vector<std::string> categories;   ///< of texts those that occur, of booleans "false" and "true"; else empty
    bool integral = false;                 ///< no finite number has a fraction
    std::size_t size() const { return numbers.size(); }
};

/// Values of an expression for an axis. Categories are in the order of the alphabet, so that they stay where they are
/// from pixel to pixel. Errors: as Query::evaluate; parseFailed for colours and vectors, which are several numbers.
Result<AxisValues> axisValues(const Query& query, const PathSet& paths, const EvaluationLimits& limits = {});

/// What is marked on an axis: an interval, both ends included, and the two places beside the numbers.
struct Brush {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();   ///< below `low`: no number at all
    bool nan = false, missing = false;
    bool contains(double value, bool known) const {
        if (!known) return missing;
        return value != value ? nan : value >= low && value <= high;
    }
    bool hasNumbers() const { return low <= high; }
    friend bool operator==(const Brush&, const Brush&) = default;
};
struct BrushedAxis {
    const AxisValues* values = nullptr;    ///< as many as there are paths
    std::span<const Brush> brushes;        ///< none: the axis takes every path
};
/// Paths that lie in a brush of every axis that has any; ascending.
std::vector<Index> brushedPaths(std::span<const BrushedAxis> axes, Index pathCount);

/// The condition that is true for exactly the paths that lie in one of the brushes: `x >= 2 and x <= 5`.
/// Empty without brushes. \param expression  the one that gave `values`
std::string brushQuery(std::string_view expression, const AxisValues& values, std::span<const Brush> brushes);
/// The same as rules, which are joined by and; nothing where rules cannot say it: several intervals, or numbers and NaN.
std::optional<std::vector<Rule>> brushRules(std::string_view expression, const AxisValues& values, std::span<const Brush> brushes);

}  // namespace emca::query
