#include "jpeg.h"

#include <csetjmp>
#include <cstdio>
#include <fstream>
#include <memory>
#include <vector>

// Needs the declarations of <cstdio>.
#include <jpeglib.h>

#include "size_check.h"

namespace emca::imageio {

namespace {

/// The library reports errors by a function that must not return, and warnings by a count.
struct Errors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
};

void giveUp(j_common_ptr common) { std::longjmp(reinterpret_cast<Errors*>(common->err)->back, 1); }
void saySilently(j_common_ptr) {}

/// One file being read. No function below has anything to destroy when the library jumps out of it.
class Reader {
  public:
    Reader() {
        info_.err = jpeg_std_error(&errors_.manager);
        errors_.manager.error_exit = giveUp;
        errors_.manager.output_message = saySilently;
    }
    ~Reader() { jpeg_destroy_decompress(&info_); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    bool begin(std::FILE* file) {
        if (setjmp(errors_.back) != 0) return false;
        jpeg_create_decompress(&info_);
        jpeg_stdio_src(&info_, file);
        jpeg_read_header(&info_, TRUE);
        const bool grey = info_.jpeg_color_space == JCS_GRAYSCALE;
        const bool color = info_.jpeg_color_space == JCS_YCbCr || info_.jpeg_color_space == JCS_RGB;
        if (!grey && !color) return false;
        info_.out_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
        jpeg_calc_output_dimensions(&info_);
        return true;
    }
    std::uint32_t width() const { return info_.output_width; }
    std::uint32_t height() const { return info_.output_height; }
    std::uint32_t channels() const { return static_cast<std::uint32_t>(info_.output_components); }

    /// \param to  width * height * channels bytes
    bool read(std::uint8_t* to) {
        if (setjmp(errors_.back) != 0) return false;
        jpeg_start_decompress(&info_);
        const std::size_t stride = std::size_t(width()) * channels();
        while (info_.output_scanline < info_.output_height) {
            JSAMPROW row = to + stride * info_.output_scanline;
            if (jpeg_read_scanlines(&info_, &row, 1) != 1) return false;
        }
        jpeg_finish_decompress(&info_);
        return errors_.manager.num_warnings == 0;
    }

  private:
    jpeg_decompress_struct info_{};
    Errors errors_{};
};

}  // namespace

bool isJpeg(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    char begin[3] = {};
    in.read(begin, sizeof begin);
    return in && begin[0] == '\xff' && begin[1] == '\xd8' && begin[2] == '\xff';
}

std::optional<StoredImage> readJpeg(const std::filesystem::path& file, std::uintmax_t fileBytes, bool keepBytes) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(file.c_str(), "rb"), std::fclose);
    Reader reader;
    if (!opened || !reader.begin(opened.get())) return std::nullopt;
    if (!checkSize(file, reader.width(), reader.height(), reader.channels(), fileBytes)) return std::nullopt;
    StoredImage image;
    image.width = reader.width();
    image.height = reader.height();
    image.channels = reader.channels() == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
    image.wholeNumbers = true;
    image.frame = {0, 0, image.width, image.height};
    image.bytes.resize(std::size_t(image.width) * image.height * image.channels.size());
    if (!reader.read(image.bytes.data())) return std::nullopt;
    if (keepBytes) return image;
    image.floats.resize(image.bytes.size());
    for (std::size_t i = 0; i < image.bytes.size(); ++i) image.floats[i] = static_cast<float>(image.bytes[i]) * (1.f / 255.f);
    image.bytes = {};
    return image;
}

}  // namespace emca::imageio
