#pragma once

#include <string>
#include <string_view>

#include "emca/core/result.h"

namespace emca::query::detail {

/// An expression as it may stand beside a comparison: in parentheses if its operator binds as weakly.
/// Errors: parseFailed.
Result<std::string> operand(std::string_view text);

}  // namespace emca::query::detail
