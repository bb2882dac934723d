#include <algorithm>
#include <cmath>
#include <exception>

#include "emca/core/replaced_file.h"
#include "emca/imageio/imageio.h"
#include "emca/imageio/stored_image.h"
#include "exr.h"
#include "format_module.h"
#include "lower_case.h"
#include "pfm.h"
#include "sentences.h"
#include "srgb.h"

namespace emca::imageio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoun = "image";  // in sentences

/// The image as three channels: colours as they are, one or two channels as grey.
Image toRgb(const Image& image) {
    Image rgb(image.width(), image.height());
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) rgb.setColor({x, y}, image.color({x, y}));
    return rgb;
}

StoredImage withoutPixels(const Image& image) {
    StoredImage stored;
    stored.width = image.width();
    stored.height = image.height();
    stored.channels = image.channels();
    return stored;
}

Result<void> writeWithModule(const fs::path& file, const char* format, const StoredImage& image) {
    const auto& module = formatModule();
    if (!module) return withoutModule(file, "written", module.error());
    return (*module)->write(file, format, image);
}

Result<void> writeHdr(const fs::path& file, const Image& image) {
    const Image rgb = toRgb(image);
    StoredImage stored = withoutPixels(rgb);
    stored.floats.assign(rgb.data(), rgb.data() + rgb.size());
    // A shared exponent knows neither sign nor words; its largest value is 255/256 * 2^127.
    for (float& v : stored.floats) v = v > 0 ? std::min(v, 1.6e38f) : 0.f;
    return writeWithModule(file, "hdr", stored);
}

Result<void> writePng(const fs::path& file, const Image& image) {
    const Image rgb = toRgb(image);
    StoredImage stored = withoutPixels(rgb);
    stored.bytes.resize(rgb.size());
    std::transform(rgb.data(), rgb.data() + rgb.size(), stored.bytes.begin(), [](float v) {
        const float clamped = v > 0 ? std::min(v, 1.f) : 0.f;  // NaN is 0
        return static_cast<std::uint8_t>(std::lround(encodeSrgb(clamped) * 255));
    });
    return writeWithModule(file, "png", stored);
}

using Writer = Result<void> (*)(const fs::path&, const Image&);

Writer writerFor(const fs::path& file) {
    const std::string extension = lowerCase(file.extension().string());
    if (extension == ".exr") return writeExr;
    if (extension == ".pfm") return writePfm;
    if (extension == ".hdr") return writeHdr;
    if (extension == ".png") return writePng;
    return nullptr;
}

Error unknownExtension(const fs::path& file) {
    return {ErrorCode::notSupported, "The image " + file.string() + " has the extension \"" +
                                         file.extension().string() + "\"; .exr, .pfm, .hdr and .png can be written."};
}

Result<void> writeAtomically(const fs::path& asked, const Image& image, Writer writer) {
    if (Result<void> place = ReplacedFile::check(asked, kNoun); !place) return place;
    Result<ReplacedFile> file = ReplacedFile::create(asked, kNoun);
    if (!file) return file.error();
    if (const Result<void> result = writer(file->temporary(), image); !result) {
        // The person knows the file by the name that they gave.
        const std::string temporary = file->temporary().string();
        std::string message = result.error().message;
        if (const auto at = message.find(temporary); at != std::string::npos) message.replace(at, temporary.size(), asked.string());
        return Error{result.error().code, message};
    }
    return file->commit();
}

}  // namespace

Result<void> checkWritable(const fs::path& file) {
    const Writer writer = writerFor(file);
    if (!writer) return unknownExtension(file);
    if (writer == writeHdr || writer == writePng) {
        if (const auto& module = formatModule(); !module) return withoutModule(file, "written", module.error());
    }
    return ReplacedFile::check(file, kNoun);
}

Result<void> write(const fs::path& file, const Image& image) {
    const Writer writer = writerFor(file);
    if (!writer) return unknownExtension(file);
    if (image.empty()) return Error{ErrorCode::invalidArgument, "The image for " + file.string() + " has no pixels."};
    try {
        return writeAtomically(file, image, writer);
    } catch (const std::exception& e) {
        return unwritable(file, clause(e.what()));
    }
}

Result<void> write(const fs::path& file, const RenderedImage& render) {
    if (writerFor(file) != writeExr) return write(file, render.color);
    const Image* const parts[] = {&render.color, &render.samples, &render.variance};
    std::vector<std::string> names;
    for (const Image* part : parts)
        for (const std::string& channel : part->channels())
            if (!part->empty()) names.push_back(part == &render.variance ? "variance." + channel : channel);
    Image all(render.color.width(), render.color.height(), names);
    std::size_t offset = 0;
    for (const Image* part : parts) {
        if (part->empty()) continue;
        if (part->width() != all.width() || part->height() != all.height())
            return Error{ErrorCode::invalidArgument,
                         "The render for " + file.string() + " has colours, samples and variance of different sizes."};
        const std::size_t channels = part->channelCount(), stride = names.size();
        const std::size_t pixels = std::size_t(all.width()) * all.height();
        for (std::size_t i = 0; i < pixels; ++i)
            std::copy_n(part->data() + i * channels, channels, all.data() + i * stride + offset);
        offset += channels;
    }
    return write(file, all);
}

}  // namespace emca::imageio
