#pragma once

#include <optional>
#include <string_view>

#include "emca/core/color.h"

namespace emca::render {

/// Index of refraction of a dielectric by name ("bk7", "water ice"), at the sodium line and room temperature; the names
/// and values that int_ior and ext_ior have in scene files (Mitsuba 0.6, documentation, section 8.2). Any case.
std::optional<double> mediumIor(std::string_view name);

/// Complex index of refraction of a conductor, relative to vacuum.
struct MetalIor {
    Color eta;  ///< real part
    Color k;    ///< extinction
};
/// By symbol ("Cu", "Au"); case matters.
std::optional<MetalIor> metalIor(std::string_view name);

}  // namespace emca::render
