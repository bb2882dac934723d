#pragma once

#include <string>

#include "emca/core/path_set.h"

namespace emca::test {

/// All that a set of paths says, every bit of it, in one canonical text: two sets are equal if their texts are, however
/// they are stored.
std::string pathText(const PathSet& paths);

}  // namespace emca::test
