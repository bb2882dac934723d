#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "emca/core/image.h"
#include "emca/core/result.h"

/// FLIP: the difference that a person sees who alternates between two images on a screen.
/// Sources, cited as [LDR] and [HDR]:
/// [LDR] Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for Alternating
///       Images". Proc. ACM on Computer Graphics and Interactive Techniques 3(2) (HPG), 2020.
/// [HDR] Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in Rendered High Dynamic Range Images".
///       Eurographics Short Papers, 2021.
namespace emca::analysis {

enum class FlipRange : std::uint8_t {
    low = 0,   ///< LDR-FLIP of the images as a screen shows them: values above 1 are clipped
    high = 1,  ///< HDR-FLIP: the largest LDR-FLIP of each pixel over a series of exposures, through a tone mapper
};

/// Pixels of a screen per degree of the visual field ([LDR] section 4, "viewing conditions").
/// \param distance, width  of the screen, in one unit; both positive
/// \param pixels  across that width
double flipPixelsPerDegree(double distance, double width, double pixels);

/// The exposures of HDR-FLIP, evenly spaced, in stops.
struct FlipExposures {
    double start = 0, stop = 0;
    std::uint32_t count = 1;
    double at(std::uint32_t i) const { return count < 2 ? start : start + (stop - start) * i / (count - 1); }
};

struct FlipOptions {
    FlipRange range = FlipRange::high;
    double pixelsPerDegree = flipPixelsPerDegree(0.7, 0.7, 3840);  ///< about 67: the papers' default; at most 1000
    std::optional<FlipExposures> exposures;  ///< high only; nothing: automaticExposures() of the reference
    /// Called after each row with the share that is done, in the calling thread; false ends the work.
    std::function<bool(double fraction)> progress = {};
};

struct FlipResult {
    Image error;              ///< one channel "FLIP", in [0, 1]; 0: no visible difference
    FlipExposures exposures;  ///< high only
};

/// From the shortest exposure, in which the brightest pixel of the reference is tone mapped to 0.85, to the longest, in
/// which the median of its luminances is ([HDR] section 3.1); max(2, ceil(stop - start)) of them. Where the papers say
/// nothing: of an even number of pixels the median is the larger of the middle two (as the authors' program has it); pixels
/// that are NaN or infinite are left out; a median of 0 is replaced by that of the positive luminances;
/// a reference of one luminance has one exposure, one without light exposure 0.
FlipExposures automaticExposures(const Image& reference);

/// Compares two images of linear Rec. 709 (grey, if they have fewer than three channels). Low is symmetric in its
/// arguments; high is not if the exposures come from the reference. Negative values count as 0, infinite ones as white.
/// A pixel that is NaN in one image only is NaN in the result; for its neighbours NaN counts as black.
/// 1920x1080 takes some 0.4 s per exposure on one thread, and memory for the result besides a few dozen rows.
/// Errors: invalidArgument (sizes differ; pixelsPerDegree, exposures out of range); cancelled (by progress).
Result<FlipResult> flip(const Image& image, const Image& reference, const FlipOptions& options = {});

}  // namespace emca::analysis
