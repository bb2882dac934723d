#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <new>
#include <set>
#include <stdexcept>
#include <system_error>

#include "exr.h"
#include "exr_threads.h"
#include "sentences.h"

namespace emca::imageio {
namespace {

/// A file that remembers whether all was written. OpenEXR's own does not tell when the last bytes fail, which it writes
/// in a destructor.
class CheckedFile : public Imf::OStream {
  public:
    explicit CheckedFile(const std::filesystem::path& file)
        : OStream(file.c_str()), file_(file, std::ios::binary | std::ios::trunc) {}

    void write(const char bytes[], int count) override {
        errno = 0;
        if (!file_.write(bytes, count)) throw std::runtime_error(reason());
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(std::streamoff(file_.tellp())); }
    void seekp(std::uint64_t position) override { file_.seekp(static_cast<std::streamoff>(position)); }

    /// Errors: fileUnwritable.
    Result<void> close(const std::filesystem::path& file) {
        errno = 0;
        file_.close();
        return file_.good() ? Result<void>() : unwritable(file, reason());
    }

  private:
    static std::string reason() {
        return errno != 0 ? std::generic_category().message(errno) : "not all bytes could be written";
    }

    std::ofstream file_;
};

/// The format tells channels apart by at most 255 characters, and ends a name at its first 0.
bool areNamed(const std::vector<std::string>& channels) {
    const auto isName = [](const std::string& channel) {
        return !channel.empty() && channel.size() <= 255 && channel.find('\0') == std::string::npos;
    };
    return std::all_of(channels.begin(), channels.end(), isName) &&
           std::set<std::string>(channels.begin(), channels.end()).size() == channels.size();
}

Imf::Header headerOf(const Image& image) {
    Imf::Header header(static_cast<int>(image.width()), static_cast<int>(image.height()));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& channel : image.channels()) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    return header;
}

}  // namespace

Result<void> writeExr(const std::filesystem::path& file, const Image& image) {
    if (!areNamed(image.channels()))
        return Error{ErrorCode::invalidArgument,
                     "The image for " + file.string() +
                         " has channels without name or with the same one; EXR needs a name for each, of at most 255 "
                         "characters."};
    const Imf::Header header = headerOf(image);
    Imf::FrameBuffer buffer;
    const std::size_t pixel = image.channelCount() * sizeof(float);
    for (std::size_t c = 0; c < image.channelCount(); ++c) {
        // The library takes the address without const, but only reads from it.
        auto* const first = const_cast<float*>(image.data() + c);
        buffer.insert(image.channels()[c],
                      Imf::Slice::Make(Imf::FLOAT, first, header.dataWindow(), pixel, pixel * image.width()));
    }
    CheckedFile stream(file);
    try {
        Imf::OutputFile output(stream, header, exrThreads(image.size() * sizeof(float)));
        output.setFrameBuffer(buffer);
        output.writePixels(static_cast<int>(image.height()));
    } catch (const std::bad_alloc&) {
        return noMemoryFor(file);
    } catch (const std::exception& e) {
        return unwritable(file, exrReason(file, e.what()));
    }
    return stream.close(file);
}

}  // namespace emca::imageio
