#pragma once

#include <optional>

#include "emca/client/dataset.h"
#include "emca/client/selection.h"

namespace emca::explorer {

/// Makes the next (by +1) or previous (-1) path current: among the selected paths if there are several, else among all.
/// Wraps around; does nothing without paths.
void stepPath(const client::Dataset& dataset, client::Selection& selection, int by);

/// Goes along the current path; begins at its first (+1) or last (-1) vertex and stops at the ends. Without a current
/// path it takes the first.
void stepVertex(const client::Dataset& dataset, client::Selection& selection, int by);

/// Positions of what is selected, if it is loaded.
std::optional<Index> currentPath(const client::Dataset& dataset, const client::Selection& selection);
std::optional<Index> currentVertex(const client::Dataset& dataset, const client::Selection& selection);

}  // namespace emca::explorer
