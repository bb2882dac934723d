#pragma once

#include <QLineF>
#include <span>
#include <vector>

#include "emca/core/pixel.h"

namespace emca::explorer {

/// The border of a set of pixels as straight lines in image coordinates (a pixel is one unit wide), each as long as it
/// goes: four for a rectangle. Linear in the number of pixels.
/// \param pixels  in reading order, each once
std::vector<QLineF> regionOutline(std::span<const Pixel> pixels);

}  // namespace emca::explorer
