#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "emca/core/color.h"

namespace emca {

/// How a replayed pixel compares with the rendered one.
enum class Verdict : std::uint8_t {
    unknown = 0,    ///< there is no image to compare with, or none with the same settings
    exact = 1,      ///< equal bits in every channel (NaN equals NaN)
    close = 2,      ///< relative error at most 1e-4 in every channel
    different = 3,  ///< beyond: what one sees is not what was rendered
};

/// Whether the recorded final estimates (and splats) add up to the replayed pixel, to 1e-3 relative: a renderer that
/// forgets to record a part is found out.
enum class SumCheck : std::uint8_t { unknown = 0, matches = 1, differs = 2 };

/// Comparison that comes with every traced pixel.
struct Replay {
    Verdict verdict = Verdict::unknown;
    SumCheck sums = SumCheck::unknown;
    Color rendered;   ///< from the image; black if verdict is unknown
    Color replayed;   ///< from the renderer's film code, just now
};

/// The comparisons of several pixels, counted.
struct ReplayCounts {
    std::size_t pixels = 0;
    std::size_t exact = 0, close = 0, different = 0, unknown = 0;
    std::size_t sumsDiffer = 0;   ///< pixels whose recorded estimates do not add up
    /// The worst of them; unknown if there are only unknown ones or none.
    Verdict worst() const;
};
ReplayCounts countReplays(std::span<const Replay> replays);

const char* name(Verdict verdict);
const char* name(SumCheck check);

/// Exact, close or different; never unknown.
Verdict compare(Color rendered, Color replayed);

}  // namespace emca
