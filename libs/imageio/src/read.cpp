#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>

#include "emca/imageio/imageio.h"
#include "pfm.h"
#include "size_check.h"
#include "srgb.h"

namespace emca::imageio {
namespace {

/// A library's message as part of a sentence: first line, no full stop.
std::string clause(std::string message) {
    message = message.substr(0, message.find('\n'));
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    return message.empty() ? "no reason was given" : message;
}

/// The window that people see. Files whose display window is nonsense have only their data.
struct Window {
    int x = 0, y = 0;  ///< of the display window
    std::int64_t width = 0, height = 0;
};
Window displayWindow(const OIIO::ImageSpec& spec) {
    if (spec.full_width > 0 && spec.full_height > 0)
        return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
    return {spec.x, spec.y, spec.width, spec.height};
}

Result<void> checkKind(const std::filesystem::path& file, const OIIO::ImageSpec& spec, std::uintmax_t fileBytes) {
    if (spec.deep) return unreadable(file, "it holds deep pixels");
    if (spec.depth > 1) return unreadable(file, "it is a volume, not an image");
    if (Result<void> data = checkSize(file, spec.width, spec.height, spec.nchannels, fileBytes); !data) return data;
    const Window window = displayWindow(spec);
    return checkSize(file, window.width, window.height, spec.nchannels, fileBytes);
}

/// Positions of the file's channels in the order in which they are returned.
std::vector<int> channelOrder(const OIIO::ImageSpec& spec) {
    std::vector<int> order(static_cast<std::size_t>(spec.nchannels));
    std::iota(order.begin(), order.end(), 0);
    const auto rank = [&](int c) {
        const std::string name = spec.channel_name(c);
        return name == "R" ? 0 : name == "G" ? 1 : name == "B" ? 2 : name == "A" ? 3 : 4;
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank(a) < rank(b); });
    return order;
}

Image assemble(const OIIO::ImageSpec& spec, const std::vector<float>& values) {
    const std::vector<int> order = channelOrder(spec);
    std::vector<std::string> names;
    for (const int c : order) names.push_back(spec.channel_name(c));
    const Window window = displayWindow(spec);
    Image image(static_cast<std::uint32_t>(window.width), static_cast<std::uint32_t>(window.height), names);
    const bool encoded = !spec.format.is_floating_point();
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    for (int y = 0; y < spec.height; ++y)
        for (int x = 0; x < spec.width; ++x) {
            const std::int64_t column = std::int64_t(x) + spec.x - window.x, row = std::int64_t(y) + spec.y - window.y;
            if (column < 0 || row < 0 || column >= window.width || row >= window.height) continue;
            const float* in = &values[(static_cast<std::size_t>(y) * static_cast<std::size_t>(spec.width) +
                                       static_cast<std::size_t>(x)) *
                                      channels];
            float* out = image.at({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)});
            for (std::size_t c = 0; c < channels; ++c) {
                const float v = in[order[c]];
                out[c] = encoded && order[c] != spec.alpha_channel ? decodeSrgb(v) : v;
            }
        }
    return image;
}

Result<Image> readUnguarded(const std::filesystem::path& file) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status))
        return Error{ErrorCode::fileNotFound, "There is no image " + file.string() + "; check the name."};
    if (!std::filesystem::is_regular_file(status)) return unreadable(file, "it is not a file");
    const std::uintmax_t fileBytes = std::filesystem::file_size(file, code);
    if (code) return unreadable(file, code.message());

    if (isPfm(file)) return readPfm(file, fileBytes);
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string(), &hints);
    // Asked for in any case: messages that nobody asked for are printed when the program ends.
    const std::string openError = OIIO::geterror();
    if (!input) return unreadable(file, clause(openError));
    const OIIO::ImageSpec spec = input->spec();
    if (Result<void> checked = checkKind(file, spec, fileBytes); !checked) return checked.error();

    std::vector<float> values(static_cast<std::size_t>(spec.nchannels) * static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height));
    const bool complete = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
    const std::string readError = input->geterror();
    input->close();
    if (!complete || !readError.empty()) return unreadable(file, clause(readError));
    return assemble(spec, values);
}

}  // namespace

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

Result<Image> read(const std::filesystem::path& file) {
    try {
        return readUnguarded(file);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "The image " + file.string() + " needs more memory than there is."};
    } catch (const std::exception& e) {
        return unreadable(file, clause(e.what()));
    }
}

}  // namespace emca::imageio
