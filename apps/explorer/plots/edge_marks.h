#pragma once

class QPainter;

namespace emca::explorer {

class Theme;
struct ScatterContent;

/// Paints what the range of a plot does not hold into the rows at its edges: arrows with values, dots for what a
/// logarithmic axis has no place for, and words for NaN and infinity. Labels that would overlap are left out, the
/// selected and the farthest come first.
void paintEdgeMarks(QPainter& painter, const ScatterContent& content, const Theme& theme);

}  // namespace emca::explorer
