#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/shared_array.h"

namespace emca {

/// What a query found that was sent along with a trace and evaluated beside the renderer.
struct MatchCounts {
    std::uint64_t paths = 0;                     ///< replayed
    std::uint64_t matched = 0;                   ///< for which the query is true
    std::uint64_t unknown = 0;                   ///< for which it is neither true nor false
    std::uint64_t omitted = 0;                   ///< matched, but not in the reply: not asked for, or beyond the budget
    std::vector<std::string> missing;            ///< names that the query reads and no path had, ascending
    SharedArray<std::uint32_t> matchedOfPixel;   ///< one per traced pixel, in that order
    SharedArray<Color> sumOfPixel;               ///< sum of the final estimates of its matches, not divided by samples
};

/// Which of the matching paths a reply brings.
enum class KeepMatches : std::uint8_t {
    all = 0,
    none = 1,        ///< counts and sums alone
    brightest = 2,   ///< those of the highest luminance; NaN counts as the highest of all
};

}  // namespace emca
