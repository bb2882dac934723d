#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <exception>
#include <fstream>
#include <random>
#include <set>

#include "emca/imageio/imageio.h"
#include "pfm.h"
#include "srgb.h"

namespace emca::imageio {
namespace {

namespace fs = std::filesystem;

Error unwritable(const fs::path& file, const std::string& why) {
    return {ErrorCode::fileUnwritable, "The image " + file.string() + " cannot be written: " + why + "."};
}

std::string clause(std::string message) {
    message = message.substr(0, message.find('\n'));
    while (!message.empty() && (message.back() == '.' || message.back() == ' ')) message.pop_back();
    return message.empty() ? "no reason was given" : message;
}

/// The image as three channels: colours as they are, one or two channels as grey.
Image toRgb(const Image& image) {
    Image rgb(image.width(), image.height());
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) rgb.setColor({x, y}, image.color({x, y}));
    return rgb;
}

OIIO::ImageSpec specOf(const Image& image, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(static_cast<int>(image.width()), static_cast<int>(image.height()),
                         static_cast<int>(image.channelCount()), type);
    spec.channelnames = image.channels();
    return spec;
}

Result<void> writeWithOiio(const fs::path& file, const std::string& format, const OIIO::ImageSpec& spec,
                           const void* pixels) {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    const std::string createError = OIIO::geterror();
    if (!output)
        return Error{ErrorCode::notSupported,
                     "This OpenImageIO was built without ." + format + ": " + clause(createError) + "."};
    if (!output->open(file.string(), spec)) return unwritable(file, clause(output->geterror()));
    const bool written = output->write_image(spec.format, pixels);
    const std::string writeError = output->geterror();
    const bool closed = output->close();
    if (!written || !closed) return unwritable(file, clause(written ? output->geterror() : writeError));
    return {};
}

Result<void> writeExr(const fs::path& file, const Image& image) {
    const std::set<std::string> names(image.channels().begin(), image.channels().end());
    if (names.size() != image.channelCount() || names.count("") > 0)
        return Error{ErrorCode::invalidArgument,
                     "The image for " + file.string() +
                         " has channels without name or with the same one; EXR needs a name for each."};
    OIIO::ImageSpec spec = specOf(image, OIIO::TypeDesc::FLOAT);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    return writeWithOiio(file, "openexr", spec, image.data());
}

Result<void> writeHdr(const fs::path& file, const Image& image) {
    Image rgb = toRgb(image);
    // A shared exponent knows neither sign nor words; its largest value is 255/256 * 2^127.
    std::for_each(rgb.data(), rgb.data() + rgb.size(), [](float& v) { v = v > 0 ? std::min(v, 1.6e38f) : 0.f; });
    return writeWithOiio(file, "hdr", specOf(rgb, OIIO::TypeDesc::FLOAT), rgb.data());
}

Result<void> writePng(const fs::path& file, const Image& image) {
    const Image rgb = toRgb(image);
    std::vector<std::uint8_t> bytes(rgb.size());
    std::transform(rgb.data(), rgb.data() + rgb.size(), bytes.begin(), [](float v) {
        const float clamped = v > 0 ? std::min(v, 1.f) : 0.f;  // NaN is 0
        return static_cast<std::uint8_t>(std::lround(encodeSrgb(clamped) * 255));
    });
    OIIO::ImageSpec spec = specOf(rgb, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return writeWithOiio(file, "png", spec, bytes.data());
}

using Writer = Result<void> (*)(const fs::path&, const Image&);

Writer writerFor(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") return writeExr;
    if (extension == ".pfm") return writePfm;
    if (extension == ".hdr") return writeHdr;
    if (extension == ".png") return writePng;
    return nullptr;
}

/// A name beside the file that no other thread or program uses at the same time.
fs::path temporaryBeside(const fs::path& file) {
    static const unsigned program = std::random_device()();
    static std::atomic<unsigned> counter{0};
    return file.parent_path() / ("." + file.stem().string() + "." + std::to_string(program) + "-" +
                                 std::to_string(counter++) + ".tmp" + file.extension().string());
}

Error unknownExtension(const fs::path& file) {
    return {ErrorCode::notSupported, "The image " + file.string() + " has the extension \"" +
                                         file.extension().string() + "\"; .exr, .pfm, .hdr and .png can be written."};
}

/// The file that is replaced: through a link to what it means; the link stays.
fs::path targetOf(const fs::path& asked) {
    std::error_code code;
    return fs::is_symlink(asked, code) ? fs::weakly_canonical(asked, code) : asked;
}

Result<void> checkPlace(const fs::path& asked, const fs::path& target) {
    std::error_code code;
    const fs::file_status old = fs::status(target, code);
    if (fs::exists(old) && !fs::is_regular_file(old))
        return unwritable(asked, "there is something of that name that is not a file");
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code)) return unwritable(asked, "there is no folder " + folder.string());
    // Trying is the only answer that counts permissions, read-only file systems and full disks alike.
    const fs::path probe = temporaryBeside(target);
    const bool created = std::ofstream(probe, std::ios::binary).put('\n').flush().good();
    fs::remove(probe, code);
    return created ? Result<void>() : unwritable(asked, "the folder " + folder.string() + " does not allow it");
}

Result<void> writeAtomically(const fs::path& asked, const Image& image, Writer writer) {
    const fs::path file = targetOf(asked);
    if (Result<void> place = checkPlace(asked, file); !place) return place;
    std::error_code code;
    const fs::file_status old = fs::status(file, code);
    const fs::path temporary = temporaryBeside(file);
    Result<void> result = writer(temporary, image);
    if (result) {
        if (fs::exists(old)) fs::permissions(temporary, old.permissions(), code);
        fs::rename(temporary, file, code);
        if (code) result = unwritable(asked, code.message());
    } else if (result.error().code == ErrorCode::fileUnwritable) {
        // The person knows the file by the name that they gave.
        std::string message = result.error().message;
        if (const auto at = message.find(temporary.string()); at != std::string::npos)
            message.replace(at, temporary.string().size(), asked.string());
        result = Error{ErrorCode::fileUnwritable, message};
    }
    if (!result) fs::remove(temporary, code);
    return result;
}

}  // namespace

Result<void> checkWritable(const fs::path& file) {
    if (!writerFor(file)) return unknownExtension(file);
    return checkPlace(file, targetOf(file));
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
