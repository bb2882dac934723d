#pragma once

#include "emca/query/query.h"
#include "texts.h"
#include "values.h"

namespace emca::query::detail {

/// Says of what type the values of a result are.
void setType(Type type, int components, PathValues& out);

/// Appends the first `size` values to a result of their type. \param texts  needed for texts alone
void append(const Values& values, std::size_t size, const Texts* texts, PathValues& out);

}  // namespace emca::query::detail
