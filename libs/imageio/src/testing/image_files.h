#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "emca/core/image.h"

namespace emca::imageio {

/// An empty folder that goes away with the test.
class ImageFiles : public testing::Test {
  protected:
    ImageFiles() {
        std::string pattern = (std::filesystem::temp_directory_path() / "emca-imageio-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    ~ImageFiles() override {
        std::error_code ignored;
        std::filesystem::permissions(folder_, std::filesystem::perms::owner_all, ignored);
        std::filesystem::remove_all(folder_, ignored);
    }
    std::filesystem::path file(const std::string& name) const { return folder_ / name; }
    std::size_t fileCount() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
    }
    static std::string bytesOf(const std::filesystem::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
        std::filesystem::remove(path);  // overwriting waits for the disk
        std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }
    std::filesystem::path folder_;
};

inline Image randomBits(std::uint32_t width, std::uint32_t height, std::vector<std::string> channels = {"R", "G", "B"}) {
    std::mt19937 random(1);
    Image image(width, height, std::move(channels));
    for (std::size_t i = 0; i < image.size(); ++i)
        image.data()[i] = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    const float special[] = {std::numeric_limits<float>::quiet_NaN(),  std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(),  -0.f,
                             std::numeric_limits<float>::denorm_min(), std::bit_cast<float>(0x7fc12345u)};
    std::copy(std::begin(special), std::end(special), image.data());
    return image;
}

inline bool sameBits(const Image& a, const Image& b) {
    return a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

}  // namespace emca::imageio
