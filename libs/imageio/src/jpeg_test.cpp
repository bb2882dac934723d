#include "jpeg.h"

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <random>

#include "emca/imageio/imageio.h"
#include "format_module.h"
#include "testing/image_files.h"

namespace emca::imageio {
namespace {

/// Writes smooth noise, as textures are, by OpenImageIO.
void writeNoise(const std::filesystem::path& file, int width, int height, int channels, const char* subsampling) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    if (*subsampling) spec.attribute("jpeg:subsampling", subsampling);
    spec.attribute("CompressionQuality", 83);
    std::mt19937 random(static_cast<unsigned>(width * channels));
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width * height * channels));
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>((i / 3 + random() % 64) & 0xff);
    const auto output = OIIO::ImageOutput::create("jpg");
    ASSERT_TRUE(output && output->open(file.string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, bytes.data()));
    output->close();
}

TEST_F(ImageFiles, JpegsAreWhatOpenImageIOReads) {
    int number = 0;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(17, 9), std::pair(64, 64), std::pair(131, 77)})
        for (const int channels : {1, 3})
            for (const char* subsampling : {"", "4:4:4", "4:2:2", "4:2:0"}) {
                const auto name = file(("a" + std::to_string(number++) + ".jpg").c_str());
                writeNoise(name, width, height, channels, subsampling);
                const auto bytes = std::filesystem::file_size(name);
                for (const bool keepBytes : {false, true}) {
                    const auto ours = readJpeg(name, bytes, keepBytes);
                    const auto theirs = (*formatModule())->read(name, bytes, keepBytes);
                    ASSERT_TRUE(ours && theirs) << name;
                    EXPECT_EQ(ours->width, theirs->width);
                    EXPECT_EQ(ours->height, theirs->height);
                    EXPECT_EQ(ours->channels, theirs->channels);
                    EXPECT_EQ(ours->alphaChannel, theirs->alphaChannel);
                    EXPECT_EQ(ours->wholeNumbers, theirs->wholeNumbers);
                    EXPECT_EQ(ours->bytes, theirs->bytes) << width << " x " << height << ", " << channels << " " << subsampling;
                    EXPECT_EQ(ours->floats, theirs->floats);
                }
                EXPECT_TRUE(read(name));
            }
}

TEST_F(ImageFiles, DamagedJpegsAreLeftToTheModuleAndNothingDies) {
    writeNoise(file("whole.jpg"), 40, 30, 3, "4:2:0");
    std::ifstream in(file("whole.jpg"), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        std::ofstream(file("cut.jpg"), std::ios::binary).write(whole.data(), static_cast<std::streamsize>(length));
        EXPECT_FALSE(readJpeg(file("cut.jpg"), length, true)) << length;
    }
    std::mt19937 random(3);
    for (int i = 0; i < 500; ++i) {
        std::string damaged = whole;
        damaged[random() % damaged.size()] = static_cast<char>(random());
        std::ofstream(file("odd.jpg"), std::ios::binary).write(damaged.data(), static_cast<std::streamsize>(damaged.size()));
        const auto image = readJpeg(file("odd.jpg"), damaged.size(), true);  // a value, or left to the module
        if (image) {
            EXPECT_EQ(image->bytes.size(), std::size_t(image->width) * image->height * image->channels.size());
        }
    }
    EXPECT_FALSE(isJpeg(file("absent.jpg")));
}

}  // namespace
}  // namespace emca::imageio
