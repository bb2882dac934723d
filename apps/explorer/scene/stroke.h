#pragma once

#include <cstdint>
#include <vector>

#include <QColor>

#include "emca/core/vector.h"

namespace emca::explorer {

/// How a stroke is drawn. All sizes are pixels of the screen, whatever the distance.
enum class StrokeStyle : std::uint8_t {
    line = 0,    ///< from end to end, round caps
    dashed = 1,  ///< dashes of equal length on the screen
    arrow = 2,   ///< a head a little behind the middle of the segment, pointing to its end; left out on short ones
    dot = 3,     ///< a disc at `from`
    head = 4,    ///< an arrow head whose tip is the end
};

/// One mark of the 3D view. World space.
struct Stroke {
    Vec3f from, to;
    float width = 2;      ///< pixels: of the line, of the whole arrow head, diameter of a dot
    StrokeStyle style = StrokeStyle::line;
    QColor color;         ///< with alpha
};

}  // namespace emca::explorer
