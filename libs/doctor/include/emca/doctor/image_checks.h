#pragma once

#include <cstddef>

#include "emca/core/image.h"
#include "emca/core/pixel.h"
#include "emca/doctor/finding.h"

namespace emca::doctor {

/// How two images of one size differ, bit by bit (NaN equals NaN).
struct ImageDifference {
    bool sameSize = true;
    std::size_t pixels = 0;            ///< compared
    std::size_t different = 0;         ///< pixels of which a channel has other bits
    double largest = 0;                ///< relative difference |a - b| / max(|a|, |b|); infinite where one is not finite
    Pixel worst;                       ///< where; (0, 0) if there is no difference
    bool equal() const { return sameSize && different == 0; }
};
ImageDifference compareImages(const Image& a, const Image& b);

/// Relative difference of the channels that differ most; 0 for equal bits.
double relativeDifference(Color a, Color b);

/// NaN, infinite and negative pixels counted; an image without any light.
Finding checkImage(const Image& image);

/// Two renders with the same settings.
/// \param deterministic  whether the renderer says that it is
void checkRepeated(Finding& finding, const ImageDifference& difference, bool deterministic);

}  // namespace emca::doctor
