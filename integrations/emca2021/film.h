#pragma once

#include "emca/core/color.h"
#include "emca/core/image.h"
#include "messages.h"

// A pixel as it comes out of the published renderer's film, which the wire does not carry.
namespace emca::bridge {

/// Nearest number that 16 bits (IEEE 754 binary16) hold, halfway cases to even; beyond 65504 infinity.
float roundedToHalf(float value);

/// Whether an image was stored in 16 bits a value: all of its numbers survive that.
bool isHalf(const Image& image);

/// Mean over the samples that were asked for of the paths' final estimates, in double precision in the order in which they
/// came; a path that did not come or has none adds nothing. \param half  round as the image file does
Color pixelValue(const PublishedPixel& pixel, std::uint32_t samplesPerPixel, bool half);

}  // namespace emca::bridge
