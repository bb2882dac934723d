#include "size_check.h"

#include <string>

#include "emca/imageio/imageio.h"
#include "sentences.h"

namespace emca::imageio {

Result<void> checkSize(const std::filesystem::path& file, std::int64_t width, std::int64_t height,
                       std::int64_t channels, std::uintmax_t fileBytes) {
    if (width <= 0 || height <= 0 || channels <= 0) return unreadable(file, "its header promises no pixels");
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width > kMaximumSide || height > kMaximumSide ||
        static_cast<std::uint64_t>(channels) > kMaximumValues / static_cast<std::uint64_t>(width * height))
        return Error{ErrorCode::tooLarge, "The image " + file.string() + " has " + size + " of " +
                                              std::to_string(channels) + " channels; at most " +
                                              std::to_string(kMaximumSide) + " a side and 2^31 values are read."};
    // Beyond what any of the formats can compress, a header is wrong; believing it would cost memory for nothing.
    constexpr std::uint64_t kSmall = 64u << 20, kCompression = 4096;
    const std::uint64_t bytes = static_cast<std::uint64_t>(width * height * channels) * sizeof(float);
    if (bytes > kSmall && bytes / kCompression > fileBytes)
        return unreadable(
            file, "its header promises " + size + ", but the file has only " + std::to_string(fileBytes) + " bytes");
    return {};
}

}  // namespace emca::imageio
