#include "textures/texture_image.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>
#include <utility>

#include "emca/imageio/stored_image.h"

namespace emca::render {

namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Index of the channel, -1 if there is none of that name.
int findChannel(const std::vector<std::string>& channels, const std::string& name) {
    const std::string wanted = lowerCase(name);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        if (lowerCase(channels[i]) == wanted) return static_cast<int>(i);
    }
    // Grey images call their channel Y; scene files may still ask for red, and the other way round.
    if (channels.size() < 3 && (wanted == "y" || wanted == "r" || wanted == "x")) return 0;
    return -1;
}

std::string channelList(const std::vector<std::string>& channels) {
    std::string list;
    for (const std::string& channel : channels) list += (list.empty() ? "" : ", ") + channel;
    return list;
}

float decode(float encoded, std::optional<float> gamma) {
    if (!gamma) return linearFromSrgb(encoded);
    return *gamma == 1.f ? encoded : std::pow(std::max(encoded, 0.f), *gamma);
}

/// Keeps `count` channels of each pixel from the given first one.
template <typename T>
std::vector<T> pickChannels(std::vector<T> pixels, std::size_t stride, std::size_t first, std::size_t count) {
    if (stride == count) return pixels;
    std::vector<T> picked;
    picked.reserve(pixels.size() / stride * count);
    for (std::size_t i = first; i < pixels.size(); i += stride) {
        picked.insert(picked.end(), pixels.begin() + static_cast<std::ptrdiff_t>(i),
                      pixels.begin() + static_cast<std::ptrdiff_t>(i + count));
    }
    return picked;
}

using Read = Result<std::shared_ptr<const TextureImage>>;

Read fromStored(imageio::StoredImage image, const std::string& name, const TextureImage::Options& options) {
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    const std::size_t stride = image.channels.size();
    std::size_t first = 0, count = stride >= 3 ? 3 : 1;
    std::optional<float> gamma = options.gamma;
    if (!options.channel.empty()) {
        const int found = findChannel(image.channels, options.channel);
        if (found < 0) {
            return Error{ErrorCode::notSupported, "The texture " + name + " has no channel \"" + options.channel +
                                                      "\"; it has " + channelList(image.channels) + "."};
        }
        first = static_cast<std::size_t>(found);
        count = 1;
        if (found == image.alphaChannel) gamma = 1.f;  // opacity is never encoded
    }

    if (!image.bytes.empty()) {
        std::array<float, 256> toLinear;
        for (std::size_t i = 0; i < toLinear.size(); ++i) toLinear[i] = decode(static_cast<float>(i) / 255.f, gamma);
        return std::make_shared<const TextureImage>(width, height, static_cast<int>(count),
                                                    pickChannels(std::move(image.bytes), stride, first, count), toLinear);
    }
    if (!gamma && !image.wholeNumbers) gamma = 1.f;
    std::vector<float> floats = pickChannels(std::move(image.floats), stride, first, count);
    for (float& value : floats) {
        value = decode(value, gamma);
        if (!std::isfinite(value)) value = 0.f;  // one bad pixel would blacken every bilinear neighbour with NaN
    }
    return std::make_shared<const TextureImage>(width, height, static_cast<int>(count), std::move(floats));
}

}  // namespace

Read TextureImage::read(const std::filesystem::path& file, const Options& options) {
    Result<imageio::StoredImage> image = imageio::readStored(file);
    if (!image) return image.error();
    try {
        return fromStored(std::move(*image), file.string(), options);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "There is not enough memory for the texture " + file.string() + "."};
    }
}

TextureImage::TextureImage(int width, int height, int channels, std::vector<float> linear)
    : width_(width), height_(height), channels_(channels), floats_(std::move(linear)) {}

TextureImage::TextureImage(int width, int height, int channels, std::vector<std::uint8_t> bytes,
                           const std::array<float, 256>& toLinear)
    : width_(width), height_(height), channels_(channels), bytes_(std::move(bytes)), toLinear_(toLinear) {}

Color TextureImage::mean() const {
    std::call_once(meanComputed_, [this] { mean_ = computedMean(); });
    return mean_;
}

Color TextureImage::computedMean() const {
    double r = 0, g = 0, b = 0;
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const Color c = texel(x, y);
            r += static_cast<double>(c.r);
            g += static_cast<double>(c.g);
            b += static_cast<double>(c.b);
        }
    }
    const double n = static_cast<double>(width_) * height_;
    return {static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n)};
}

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace emca::render
