#pragma once

#include <cstdint>

#include "emca/core/path_set.h"
#include "emca/core/replay.h"

namespace emca {

/// Whether what was recorded of a pixel adds up to its replayed value: the final estimates of its paths divided by the
/// samples per pixel, and the splats on it, which are in the film's units already. Relative tolerance 1e-3 per channel.
///
/// \param complete  false if a budget or the choice of columns left something out: then the answer is unknown
SumCheck checkSums(const PathSet& paths, Pixel pixel, std::uint32_t samplesPerPixel, Color replayed, bool complete);

/// The same for many pixels at once; one walk over the paths. \param pixels  without duplicates, any order
std::vector<SumCheck> checkSums(const PathSet& paths, const std::vector<Pixel>& pixels, std::uint32_t samplesPerPixel,
                                const std::vector<Color>& replayed, bool complete);

}  // namespace emca
