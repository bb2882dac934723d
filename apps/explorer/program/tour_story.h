#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "emca/analysis/firefly.h"
#include "emca/analysis/outliers.h"
#include "emca/client/dataset.h"
#include "emca/client/selection.h"

namespace emca::explorer {

/// What a person would look for in a traced pixel: the path that stands out and the vertex that made it so.
struct Suspect {
    Index path = 0;
    std::optional<Index> vertex;
    analysis::OutlierReport report;       ///< of the luminance, mean + 3 sigma
    double luminance = 0;                 ///< of the path's final estimate
    double share = 0;                     ///< of the pixel's sum, in [0, 1]
    struct Light {
        Index contribution = 0;           ///< position among the contributions
        Index vertex = 0;                 ///< where it was added
    };
    std::optional<Light> light;           ///< what dominates the path, where the renderer records contributions
    std::optional<double> before, after;  ///< largest component of the throughput that arrives there and at the next one
};
/// Nothing if no path has a final estimate.
std::optional<Suspect> findSuspect(const PathSet& paths);

/// The image's most striking firefly, else its brightest pixel.
struct StrikingPixel {
    Pixel pixel;
    std::optional<analysis::Firefly> firefly;
};
std::optional<StrikingPixel> strikingPixel(const Image& image);

/// The tour as Markdown: what was rendered, what stands out and why, with the numbers of the data.
/// \param pictures  file names with captions, in order
QString tourStory(const client::Dataset& dataset, Pixel pixel, const Suspect& suspect,
                  const std::vector<std::pair<QString, QString>>& pictures);

}  // namespace emca::explorer
