#pragma once

#include <QColor>

#include "emca/analysis/color_map.h"

namespace emca::explorer {

/// A colour of a colour map for thin lines and dots on a ground: where the two are too close (the dark end of most maps on a
/// dark ground, yellow on a light one), it is mixed with white or darkened until it is seen. Colour bars show the same.
analysis::Color8 seenOn(analysis::Color8 color, const QColor& ground);

}  // namespace emca::explorer
