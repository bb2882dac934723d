#pragma once

#include <map>
#include <optional>
#include <string>

#include "emca/analysis/color_map.h"

namespace emca::explorer {

/// Ends of a colour range that a person set. Any numbers; ValueRange::repaired() makes a range of them.
struct SurfaceLimits {
    double min = 0, max = 1;
    friend bool operator==(const SurfaceLimits&, const SurfaceLimits&) = default;
};

/// What is remembered of each layer while others are shown.
struct LayerStyle {
    bool log = false;
    std::optional<SurfaceLimits> limits;   ///< nothing: by percentiles
    friend bool operator==(const LayerStyle&, const LayerStyle&) = default;
};

/// How 3D data on surfaces is shown. A plain value: the panel edits one, the command line fills one.
struct SurfaceStyle {
    std::string layer;                     ///< the one that colours the scene; empty: none, plain materials
    analysis::ColorMapId map = analysis::ColorMapId::viridis;
    double lower = 0.01, upper = 0.99;     ///< shares of the area outside of which colours do not change any more
    float exposure = 0;                    ///< of colour layers, in stops
    float opacity = 1;                     ///< of the surfaces while a layer is shown, in [0, 1]
    std::map<std::string, LayerStyle> layers;

    LayerStyle of(const std::string& name) const {
        const auto found = layers.find(name);
        return found == layers.end() ? LayerStyle() : found->second;
    }
    friend bool operator==(const SurfaceStyle&, const SurfaceStyle&) = default;
};

}  // namespace emca::explorer
