#pragma once

#include "syntax.h"

namespace emca::query::detail {

/// Compiles the light path expressions of a tree and checks its regular expressions. False: `error` says what is wrong.
bool prepare(Node& root, QueryError& error);

/// Bytes that the intermediate results of one chunk may need.
std::size_t temporaryBytes(const Node& root, const class Chunk& chunk);

}  // namespace emca::query::detail
