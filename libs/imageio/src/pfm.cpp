#include "pfm.h"

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "sentences.h"
#include "size_check.h"

namespace emca::imageio {
namespace {

struct Header {
    std::int64_t width = 0, height = 0, channels = 0;
    float scale = 0;  ///< negative: little endian
};

/// Three lines of text; exactly one white space before the numbers begin.
bool parse(std::istream& in, Header& header) {
    std::string magic;
    if (!(in >> magic >> header.width >> header.height >> header.scale)) return false;
    header.channels = magic == "PF" ? 3 : magic == "Pf" ? 1 : 0;
    const int blank = in.get();
    return header.channels > 0 && std::isfinite(header.scale) && header.scale != 0 &&
           (blank == '\n' || blank == ' ' || blank == '\r');
}

void swapBytes(float& value) {
    const auto v = std::bit_cast<std::uint32_t>(value);
    value = std::bit_cast<float>((v >> 24) | ((v >> 8) & 0xff00u) | ((v << 8) & 0xff0000u) | (v << 24));
}

}  // namespace

bool isPfm(const std::filesystem::path& file) {
    char magic[3] = {};
    std::ifstream in(file, std::ios::binary);
    in.read(magic, sizeof magic);
    return in && magic[0] == 'P' && (magic[1] == 'F' || magic[1] == 'f') &&
           (magic[2] == '\n' || magic[2] == ' ' || magic[2] == '\r');
}

Result<Image> readPfm(const std::filesystem::path& file, std::uintmax_t fileBytes) {
    std::ifstream in(file, std::ios::binary);
    Header header;
    if (!parse(in, header)) return unreadable(file, "its PFM header is not three lines of type, size and scale");
    if (Result<void> checked = checkSize(file, header.width, header.height, header.channels, fileBytes); !checked)
        return checked.error();
    Image image(static_cast<std::uint32_t>(header.width), static_cast<std::uint32_t>(header.height),
                header.channels == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"});
    const std::size_t rowValues = std::size_t(image.width()) * image.channelCount();
    for (std::uint32_t y = image.height(); y-- > 0;)
        in.read(reinterpret_cast<char*>(image.at({0, y})), static_cast<std::streamsize>(rowValues * sizeof(float)));
    if (!in) return unreadable(file, "it ends before the last of its " + std::to_string(header.height) + " rows");
    const bool swapped = (header.scale < 0) != (std::endian::native == std::endian::little);
    const float scale = std::abs(header.scale);
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (swapped) swapBytes(image.data()[i]);
        if (scale != 1) image.data()[i] *= scale;
    }
    return image;
}

Result<void> writePfm(const std::filesystem::path& file, const Image& image) {
    const bool colored = image.channelCount() >= 3;
    std::ofstream out(file, std::ios::binary);
    out << (colored ? "PF\n" : "Pf\n") << image.width() << ' ' << image.height() << '\n'
        << (std::endian::native == std::endian::little ? "-1.0\n" : "1.0\n");
    const std::size_t kept = colored ? 3 : 1;
    std::vector<float> row(kept * image.width());
    for (std::uint32_t y = image.height(); y-- > 0;) {
        for (std::uint32_t x = 0; x < image.width(); ++x)
            std::memcpy(&row[kept * x], image.at({x, y}), kept * sizeof(float));
        out.write(reinterpret_cast<const char*>(row.data()), static_cast<std::streamsize>(row.size() * sizeof(float)));
    }
    out.close();
    if (!out)
        return Error{ErrorCode::fileUnwritable,
                     "The image " + file.string() + " cannot be written: " + std::strerror(errno) + "."};
    return {};
}

}  // namespace emca::imageio
