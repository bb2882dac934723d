#pragma once

#include <QRect>

#include "emca/analysis/tone_map.h"
#include "emca/core/color.h"

class QPainter;

namespace emca::explorer {

class Theme;

/// Paints an HDR colour as the image view shows it. A colour brighter than the screen says by how many stops ("+3.7"),
/// so that bright ones can be told apart; NaN and infinity are words in warning colour; a negative channel gets a bar.
void paintSwatch(QPainter& painter, const QRect& rect, Color color, const analysis::ToneMapper& mapper,
                 const Theme& theme);

}  // namespace emca::explorer
