#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/pixel.h"
#include "emca/core/result.h"

// Numbers that a person typed: whole, without sign, blanks or letters, or a sentence about what is wrong.
namespace emca::cli {

/// Errors: invalidArgument, naming `what` and the range.
Result<std::uint64_t> parseWhole(const std::string& what, const std::string& text, std::uint64_t smallest,
                                 std::uint64_t largest);
/// A finite number, with a point if it has a fraction. Errors: invalidArgument, naming `what` and the range.
Result<double> parseReal(const std::string& what, const std::string& text, double smallest, double largest);
/// The words between commas, without blanks around them; empty ones are left out.
std::vector<std::string> splitList(const std::string& text);
Result<Pixel> parsePixel(const std::string& x, const std::string& y);

/// Options that name how to render; empty: as the scene says.
struct SettingsArguments {
    std::string samples, seed, integrator, sampler;
};
struct Settings {
    std::uint32_t samplesPerPixel = 0;
    std::uint64_t seed = 0;
    bool hasSeed = false;
    std::string integrator, sampler;
};
Result<Settings> parseSettings(const SettingsArguments& arguments);

/// Copies settings into client::RenderOptions or client::TraceOptions.
template <typename Options>
void apply(const Settings& settings, Options& options) {
    options.samplesPerPixel = settings.samplesPerPixel;
    options.seed = settings.seed;
    options.hasSeed = settings.hasSeed;
    options.integrator = settings.integrator;
    options.sampler = settings.sampler;
}

}  // namespace emca::cli
