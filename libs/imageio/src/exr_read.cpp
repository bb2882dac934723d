#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>

#include <array>
#include <exception>
#include <fstream>
#include <new>

#include "exr.h"
#include "exr_threads.h"
#include "sentences.h"
#include "size_check.h"

namespace emca::imageio {
namespace {

/// Whether every value of every pixel is there, as a half or a float.
bool isPlain(const Imf::Header& header) {
    if (header.hasType() && Imf::isDeepData(header.type())) return false;
    const Imf::ChannelList& channels = header.channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const Imf::Channel& kind = channel.channel();
        const std::string name = channel.name();
        if (kind.type == Imf::UINT || kind.xSampling != 1 || kind.ySampling != 1) return false;
        if (name == "RY" || name == "BY") return false;  // chroma
    }
    return true;
}

std::vector<std::string> channelsOf(const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        names.emplace_back(channel.name());
    return inLayerOrder(std::move(names));
}

/// OpenEXR's windows include their last pixel.
std::int64_t extent(int first, int last) { return std::int64_t(last) - first + 1; }

StoredImage::Frame frameOf(const Imath::Box2i& data, const Imath::Box2i& display) {
    const std::int64_t width = extent(display.min.x, display.max.x), height = extent(display.min.y, display.max.y);
    if (width <= 0 || height <= 0)  // nonsense: only the data is there to be seen
        return {0, 0, extent(data.min.x, data.max.x), extent(data.min.y, data.max.y)};
    return {std::int64_t(display.min.x) - data.min.x, std::int64_t(display.min.y) - data.min.y, width, height};
}

Result<std::optional<StoredImage>> readUnguarded(const std::filesystem::path& file, std::uintmax_t fileBytes) {
    Imf::MultiPartInputFile input(file.c_str(), exrThreads(fileBytes));
    if (input.parts() != 1) return std::optional<StoredImage>();
    const Imf::Header& header = input.header(0);
    if (!isPlain(header)) return std::optional<StoredImage>();

    const Imath::Box2i data = header.dataWindow();
    StoredImage image;
    image.channels = channelsOf(header);
    const std::int64_t width = extent(data.min.x, data.max.x), height = extent(data.min.y, data.max.y);
    const auto channels = image.channels.size();
    if (Result<void> checked = checkSize(file, width, height, static_cast<std::int64_t>(channels), fileBytes); !checked)
        return checked.error();
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.alphaChannel = alphaOf(image.channels);
    image.frame = frameOf(data, header.displayWindow());
    image.floats.resize(std::size_t(image.width) * image.height * channels);

    Imf::FrameBuffer buffer;
    const std::size_t pixel = channels * sizeof(float);
    for (std::size_t c = 0; c < channels; ++c)
        buffer.insert(image.channels[c],
                      Imf::Slice::Make(Imf::FLOAT, image.floats.data() + c, data, pixel, pixel * image.width));
    Imf::InputPart part(input, 0);
    part.setFrameBuffer(buffer);
    part.readPixels(data.min.y, data.max.y);
    return std::optional<StoredImage>(std::move(image));
}

}  // namespace

bool isExr(const std::filesystem::path& file) {
    constexpr std::array<char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
    std::array<char, 4> first{};
    return std::ifstream(file, std::ios::binary).read(first.data(), first.size()) && first == kMagic;
}

std::string exrReason(const std::filesystem::path& file, const std::string& message) {
    const std::string name = "\"" + file.string() + "\". ";
    const std::size_t at = message.find(name);
    return clause(at == std::string::npos ? message : message.substr(at + name.size()));
}

Result<std::optional<StoredImage>> readExr(const std::filesystem::path& file, std::uintmax_t fileBytes) {
    try {
        return readUnguarded(file, fileBytes);
    } catch (const std::bad_alloc&) {
        return noMemoryFor(file);
    } catch (const std::exception& e) {
        return unreadable(file, exrReason(file, e.what()));
    }
}

}  // namespace emca::imageio
