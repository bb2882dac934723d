#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "emca/core/image.h"
#include "emca/core/pixel.h"

namespace emca::analysis {

/// A pixel that stands out of its neighbourhood.
struct Firefly {
    Pixel pixel;
    float luminance = 0;      ///< of the pixel
    float neighbours = 0;     ///< median luminance of its neighbours, without itself
    float ratio = 0;          ///< luminance / (neighbours + floor); infinity for NaN and infinite pixels
};

struct FireflyOptions {
    int radius = 2;               ///< 2: the 24 neighbours of a 5x5 window, fewer at the border
    float ratio = 10;             ///< smallest ratio reported
    /// At most this share of the neighbours (but one) may be a quarter as bright as the pixel: so that the corner of a
    /// lamp, whose neighbours are mostly dark, is no firefly.
    float company = 0.125f;
    std::size_t maximum = 100;    ///< at most so many, the most striking ones
    /// Added to the neighbours' median, as a share of the mean luminance that has fireflies cut away: so that a dim
    /// spot in a black corner is not the image's first firefly.
    float floor = 0.05f;
};

/// Most striking first; equal ones in reading order. Empty for images below 2x2 pixels.
std::vector<Firefly> findFireflies(const Image& image, const FireflyOptions& options = {});

}  // namespace emca::analysis
