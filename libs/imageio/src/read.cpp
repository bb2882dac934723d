#include <algorithm>
#include <exception>
#include <new>
#include <numeric>
#include <optional>

#include "emca/imageio/imageio.h"
#include "emca/imageio/stored_image.h"
#include "exr.h"
#include "format_module.h"
#include "jpeg.h"
#include "pfm.h"
#include "sentences.h"
#include "size_check.h"
#include "srgb.h"

namespace emca::imageio {
namespace {

/// Size of a file that is there and can be read as one.
Result<std::uintmax_t> sizeOf(const std::filesystem::path& file) {
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status))
        return Error{ErrorCode::fileNotFound, "There is no image " + file.string() + "; check the name."};
    if (!std::filesystem::is_regular_file(status)) return unreadable(file, "it is not a file");
    const std::uintmax_t bytes = std::filesystem::file_size(file, code);
    if (code) return unreadable(file, code.message());
    return bytes;
}

/// Whatever is not PFM.
Result<StoredImage> readAny(const std::filesystem::path& file, std::uintmax_t fileBytes, bool keepBytes) {
    if (isExr(file)) {
        Result<std::optional<StoredImage>> image = readExr(file, fileBytes);
        if (!image) return image.error();
        if (*image) return std::move(**image);
    }
    if (isJpeg(file)) {
        if (auto image = readJpeg(file, fileBytes, keepBytes)) return std::move(*image);
    }
    const auto& module = formatModule();
    if (!module) return withoutModule(file, "read", module.error());
    return (*module)->read(file, fileBytes, keepBytes);
}

/// Positions of the file's channels in the order in which they are returned.
std::vector<std::size_t> channelOrder(const std::vector<std::string>& channels) {
    std::vector<std::size_t> order(channels.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto rank = [&](std::size_t c) {
        const std::string& name = channels[c];
        return name == "R" ? 0 : name == "G" ? 1 : name == "B" ? 2 : name == "A" ? 3 : 4;
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
    return order;
}

Result<Image> assemble(const std::filesystem::path& file, const StoredImage& stored, std::uintmax_t fileBytes) {
    const StoredImage::Frame frame = stored.frame;
    const std::size_t channels = stored.channels.size();
    if (Result<void> checked =
            checkSize(file, frame.width, frame.height, static_cast<std::int64_t>(channels), fileBytes);
        !checked)
        return checked.error();
    const std::vector<std::size_t> order = channelOrder(stored.channels);
    std::vector<std::string> names;
    for (const std::size_t c : order) names.push_back(stored.channels[c]);
    Image image(static_cast<std::uint32_t>(frame.width), static_cast<std::uint32_t>(frame.height), names);
    const std::int64_t left = std::max<std::int64_t>(frame.x, 0), top = std::max<std::int64_t>(frame.y, 0);
    const std::int64_t right = std::min<std::int64_t>(frame.x + frame.width, stored.width);
    const std::int64_t bottom = std::min<std::int64_t>(frame.y + frame.height, stored.height);
    const bool asStored = !stored.wholeNumbers && std::is_sorted(order.begin(), order.end());
    for (std::int64_t y = top; y < bottom && left < right; ++y) {
        const auto first = static_cast<std::size_t>(y) * stored.width + static_cast<std::size_t>(left);
        const float* in = &stored.floats[first * channels];
        float* out = image.at({static_cast<std::uint32_t>(left - frame.x), static_cast<std::uint32_t>(y - frame.y)});
        const auto pixels = static_cast<std::size_t>(right - left);
        if (asStored) {
            std::copy_n(in, pixels * channels, out);
            continue;
        }
        for (std::size_t x = 0; x < pixels; ++x, in += channels)
            for (const std::size_t c : order) {
                const bool encoded = stored.wholeNumbers && static_cast<int>(c) != stored.alphaChannel;
                *out++ = encoded ? decodeSrgb(in[c]) : in[c];
            }
    }
    return image;
}

StoredImage storedFrom(const Image& image) {
    StoredImage stored;
    stored.width = image.width();
    stored.height = image.height();
    stored.channels = image.channels();
    stored.floats.assign(image.data(), image.data() + image.size());
    stored.frame = {0, 0, image.width(), image.height()};
    return stored;
}

template <typename Reading>
auto guarded(const std::filesystem::path& file, const Reading& reading) -> decltype(reading()) {
    try {
        return reading();
    } catch (const std::bad_alloc&) {
        return noMemoryFor(file);
    } catch (const std::exception& e) {
        return unreadable(file, clause(e.what()));
    }
}

}  // namespace

Result<Image> read(const std::filesystem::path& file) {
    return guarded(file, [&]() -> Result<Image> {
        const Result<std::uintmax_t> bytes = sizeOf(file);
        if (!bytes) return bytes.error();
        if (isPfm(file)) return readPfm(file, *bytes);
        const Result<StoredImage> stored = readAny(file, *bytes, false);
        if (!stored) return stored.error();
        return assemble(file, *stored, *bytes);
    });
}

Result<StoredImage> readStored(const std::filesystem::path& file) {
    return guarded(file, [&]() -> Result<StoredImage> {
        const Result<std::uintmax_t> bytes = sizeOf(file);
        if (!bytes) return bytes.error();
        if (!isPfm(file)) return readAny(file, *bytes, true);
        const Result<Image> image = readPfm(file, *bytes);
        if (!image) return image.error();
        return storedFrom(*image);
    });
}

}  // namespace emca::imageio
