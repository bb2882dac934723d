#pragma once

#include <vector>

#include "base/filter_menu.h"
#include "emca/core/path_set.h"
#include "paths/path_entries.h"

namespace emca::explorer {

/// Conditions that a value offers: equal, at least and at most for numbers, equal for texts and truths, for colours by
/// their luminance. None of what no query can name with one number, such as positions.
std::vector<ValueRule> rulesFor(const PathSet& paths, const Entry& entry);
/// Of what happened at a vertex: its label, lobe, event and depth.
std::vector<ValueRule> rulesForVertex(const PathSet& paths, Index vertex);

}  // namespace emca::explorer
