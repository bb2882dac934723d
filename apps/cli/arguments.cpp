#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

namespace emca::cli {

Result<std::uint64_t> parseWhole(const std::string& what, const std::string& text, std::uint64_t smallest,
                                 std::uint64_t largest) {
    std::uint64_t value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, code] = std::from_chars(text.data(), last, value);
    const bool whole = code == std::errc() && end == last;
    if (whole && value >= smallest && value <= largest) return value;
    return Error{ErrorCode::invalidArgument,
                 fmt::format("{} is \"{}\"; it must be a whole number from {} to {}.", what, text, smallest, largest)};
}

Result<double> parseReal(const std::string& what, const std::string& text, double smallest, double largest) {
    double value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, code] = std::from_chars(text.data(), last, value);
    if (code == std::errc() && end == last && value >= smallest && value <= largest) return value;
    return Error{ErrorCode::invalidArgument, fmt::format("{} is \"{}\"; it must be a number from {:.6g} to {:.6g}.", what, text, smallest, largest)};
}

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::size_t first = text.find_first_not_of(' ', begin), last = text.find_last_not_of(' ', end - 1);
        if (end > begin && first < end) words.push_back(text.substr(first, last + 1 - first));
        begin = end + 1;
    }
    return words;
}

Result<Pixel> parsePixel(const std::string& x, const std::string& y) {
    constexpr std::uint64_t kLargest = std::numeric_limits<std::uint32_t>::max() - 1;
    const Result<std::uint64_t> column = parseWhole("X", x, 0, kLargest);
    if (!column) return column.error();
    const Result<std::uint64_t> row = parseWhole("Y", y, 0, kLargest);
    if (!row) return row.error();
    return Pixel{static_cast<std::uint32_t>(*column), static_cast<std::uint32_t>(*row)};
}

Result<Settings> parseSettings(const SettingsArguments& arguments) {
    Settings settings;
    settings.integrator = arguments.integrator;
    settings.sampler = arguments.sampler;
    if (!arguments.samples.empty()) {
        const auto samples = parseWhole("--spp", arguments.samples, 1, std::numeric_limits<std::uint32_t>::max());
        if (!samples) return samples.error();
        settings.samplesPerPixel = static_cast<std::uint32_t>(*samples);
    }
    if (!arguments.seed.empty()) {
        const auto seed = parseWhole("--seed", arguments.seed, 0, std::numeric_limits<std::uint64_t>::max());
        if (!seed) return seed.error();
        settings.seed = *seed;
        settings.hasSeed = true;
    }
    return settings;
}

}  // namespace emca::cli
