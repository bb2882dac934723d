#pragma once

#include <span>

#include "cursor_impl.h"
#include "emca/core/path_set.h"
#include "emca/core/result.h"

namespace emca::detail {

/// Puts together what all threads recorded, in the order (pixel, sample, part, subpath, depth), and adds up what was
/// left out.
Result<PathSet> assemble(const RecordingShared& shared, std::span<CursorImpl* const> cursors, RecordingStats& stats);

}  // namespace emca::detail
