#pragma once

#include <string_view>

#include "emca/query/query.h"

namespace emca::query {

/// The value of an expression at every vertex, in the order of the set: `v.depth` and `v.pdf` are those of the vertex,
/// `luminance` that of its path, `sum(luminance(c.value))` that of its contributions. Entries of PathValues belong to
/// vertices here. Errors: as Query::evaluate; parseFailed also for c. and n. outside of a reduction.
Result<PathValues> vertexValues(std::string_view expression, const PathSet& paths, const EvaluationLimits& limits = {},
                                QueryError* where = nullptr);

}  // namespace emca::query
