// The module behind format_module.h: every format that OpenImageIO knows. The only file that knows OpenImageIO.
#include <OpenImageIO/imageio.h>

#include <exception>
#include <memory>
#include <new>

#include "format_module.h"
#include "sentences.h"
#include "size_check.h"

namespace emca::imageio {
namespace {

namespace fs = std::filesystem;

/// The window that people see. Files whose display window is nonsense have only their data.
StoredImage::Frame frameOf(const OIIO::ImageSpec& spec) {
    if (spec.full_width > 0 && spec.full_height > 0)
        return {std::int64_t(spec.full_x) - spec.x, std::int64_t(spec.full_y) - spec.y, spec.full_width,
                spec.full_height};
    return {0, 0, spec.width, spec.height};
}

Result<void> checkKind(const fs::path& file, const OIIO::ImageSpec& spec, std::uintmax_t fileBytes) {
    if (spec.deep) return unreadable(file, "it holds deep pixels");
    if (spec.depth > 1) return unreadable(file, "it is a volume, not an image");
    return checkSize(file, spec.width, spec.height, spec.nchannels, fileBytes);
}

StoredImage describe(const OIIO::ImageSpec& spec) {
    StoredImage image;
    image.width = static_cast<std::uint32_t>(spec.width);
    image.height = static_cast<std::uint32_t>(spec.height);
    for (int c = 0; c < spec.nchannels; ++c) image.channels.push_back(spec.channel_name(c));
    image.alphaChannel = spec.alpha_channel;
    image.wholeNumbers = !spec.format.is_floating_point();
    image.frame = frameOf(spec);
    return image;
}

Result<StoredImage> readUnguarded(const fs::path& file, std::uintmax_t fileBytes, bool keepBytes) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // colours as they are in the file, not times alpha
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string(), &hints);
    // Asked for in any case: messages that nobody asked for are printed when the program ends.
    const std::string openError = OIIO::geterror();
    if (!input) return unreadable(file, clause(openError));
    const OIIO::ImageSpec spec = input->spec();
    if (Result<void> checked = checkKind(file, spec, fileBytes); !checked) return checked.error();

    StoredImage image = describe(spec);
    const std::size_t values = std::size_t(image.width) * image.height * image.channels.size();
    const bool bytes = keepBytes && spec.format == OIIO::TypeDesc::UINT8;
    void* target = nullptr;
    if (bytes) {
        image.bytes.resize(values);
        target = image.bytes.data();
    } else {
        image.floats.resize(values);
        target = image.floats.data();
    }
    const bool complete =
        input->read_image(0, 0, 0, spec.nchannels, bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT, target);
    const std::string readError = input->geterror();
    input->close();
    if (!complete || !readError.empty()) return unreadable(file, clause(readError));
    return image;
}

Result<StoredImage> read(const fs::path& file, std::uintmax_t fileBytes, bool keepBytes) noexcept {
    try {
        return readUnguarded(file, fileBytes, keepBytes);
    } catch (const std::bad_alloc&) {
        return noMemoryFor(file);
    } catch (const std::exception& e) {
        return unreadable(file, clause(e.what()));
    } catch (...) {
        return unreadable(file, clause(""));
    }
}

Result<void> writeUnguarded(const fs::path& file, const char* format, const StoredImage& image) {
    const bool bytes = !image.bytes.empty();
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                         static_cast<int>(image.channels.size()),
                         bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    if (bytes) spec.attribute("oiio:ColorSpace", "sRGB");
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    const std::string createError = OIIO::geterror();
    if (!output)
        return Error{ErrorCode::notSupported,
                     std::string("This OpenImageIO was built without .") + format + ": " + clause(createError) + "."};
    if (!output->open(file.string(), spec)) return unwritable(file, clause(output->geterror()));
    const void* const pixels = bytes ? static_cast<const void*>(image.bytes.data()) : image.floats.data();
    const bool written = output->write_image(spec.format, pixels);
    const std::string writeError = output->geterror();
    const bool closed = output->close();
    if (!written || !closed) return unwritable(file, clause(written ? output->geterror() : writeError));
    return {};
}

Result<void> write(const fs::path& file, const char* format, const StoredImage& image) noexcept {
    try {
        return writeUnguarded(file, format, image);
    } catch (const std::bad_alloc&) {
        return noMemoryFor(file);
    } catch (const std::exception& e) {
        return unwritable(file, clause(e.what()));
    } catch (...) {
        return unwritable(file, clause(""));
    }
}

constexpr FormatModule kModule{kFormatModuleVersion.data(), read, write};

}  // namespace
}  // namespace emca::imageio

extern "C" __attribute__((visibility("default"))) const emca::imageio::FormatModule* emcaImageFormatModule() noexcept {
    return &emca::imageio::kModule;
}
