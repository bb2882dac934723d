#pragma once

#include <QString>
#include <vector>

#include "image/value_line.h"
#include "emca/core/pixel.h"

namespace emca::explorer {

class ImageModel;

/// What is known of a pixel, for the line below the picture: colours of the image (and the reference, in a second row),
/// samples and variance, the number that false colour shows. No rows outside the image.
std::vector<ValueLine::Row> pixelRows(const ImageModel& model, Pixel pixel);
/// The same as text for the clipboard, in full digits.
QString pixelText(const ImageModel& model, Pixel pixel);

}  // namespace emca::explorer
