#include "textures/texture_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <new>
#include <system_error>

namespace emca::render {

namespace {

constexpr int kMaxSide = 65536;
constexpr std::size_t kMaxValues = std::size_t{1} << 31;

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Index of the channel, -1 if there is none of that name.
int findChannel(const OIIO::ImageSpec& spec, const std::string& name) {
    const std::string wanted = lowerCase(name);
    for (int i = 0; i < spec.nchannels; ++i) {
        if (lowerCase(std::string(spec.channel_name(i))) == wanted) return i;
    }
    // Grey images call their channel Y; scene files may still ask for red, and the other way round.
    if (spec.nchannels < 3 && (wanted == "y" || wanted == "r" || wanted == "x")) return 0;
    return -1;
}

std::string channelList(const OIIO::ImageSpec& spec) {
    std::string list;
    for (int i = 0; i < spec.nchannels; ++i) list += (i > 0 ? ", " : "") + std::string(spec.channel_name(i));
    return list;
}

float decode(float encoded, std::optional<float> gamma) {
    if (!gamma) return linearFromSrgb(encoded);
    return *gamma == 1.f ? encoded : std::pow(std::max(encoded, 0.f), *gamma);
}

/// Keeps `count` channels of each pixel from the given first one.
template <typename T>
std::vector<T> pickChannels(const std::vector<T>& pixels, std::size_t stride, std::size_t first, std::size_t count) {
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

Read readOpen(OIIO::ImageInput& input, const std::string& name, const TextureImage::Options& options) {
    const OIIO::ImageSpec spec = input.spec();
    const int width = spec.width, height = spec.height;
    if (width <= 0 || height <= 0 || spec.nchannels <= 0 || spec.depth > 1) {
        return Error{ErrorCode::fileUnreadable, "The texture " + name + " is no two-dimensional image."};
    }
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto stride = static_cast<std::size_t>(spec.nchannels);
    if (width > kMaxSide || height > kMaxSide || stride > kMaxValues / pixels) {
        return Error{ErrorCode::tooLarge, "The texture " + name + " has " + std::to_string(width) + " x " +
                                              std::to_string(height) + " pixels of " + std::to_string(stride) +
                                              " channels, which is more than a texture may have."};
    }
    std::size_t first = 0, count = stride >= 3 ? 3 : 1;
    std::optional<float> gamma = options.gamma;
    if (!options.channel.empty()) {
        const int found = findChannel(spec, options.channel);
        if (found < 0) {
            return Error{ErrorCode::notSupported, "The texture " + name + " has no channel \"" + options.channel +
                                                      "\"; it has " + channelList(spec) + "."};
        }
        first = static_cast<std::size_t>(found);
        count = 1;
        if (found == spec.alpha_channel) gamma = 1.f;  // opacity is never encoded
    }

    if (spec.format == OIIO::TypeDesc::UINT8) {
        std::vector<std::uint8_t> bytes(pixels * stride);
        if (!input.read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, bytes.data())) {
            return Error{ErrorCode::fileUnreadable,
                         "The texture " + name + " cannot be read: " + input.geterror() + "."};
        }
        std::array<float, 256> toLinear;
        for (std::size_t i = 0; i < toLinear.size(); ++i) toLinear[i] = decode(static_cast<float>(i) / 255.f, gamma);
        return std::make_shared<const TextureImage>(width, height, static_cast<int>(count),
                                                    pickChannels(bytes, stride, first, count), toLinear);
    }
    if (!gamma && spec.format.is_floating_point()) gamma = 1.f;
    std::vector<float> floats(pixels * stride);
    if (!input.read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, floats.data())) {
        return Error{ErrorCode::fileUnreadable, "The texture " + name + " cannot be read: " + input.geterror() + "."};
    }
    floats = pickChannels(floats, stride, first, count);
    for (float& value : floats) {
        value = decode(value, gamma);
        if (!std::isfinite(value)) value = 0.f;  // one bad pixel would blacken every bilinear neighbour with NaN
    }
    return std::make_shared<const TextureImage>(width, height, static_cast<int>(count), std::move(floats));
}

}  // namespace

Read TextureImage::read(const std::filesystem::path& file, const Options& options) {
    const std::string name = file.string();
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        return Error{ErrorCode::fileNotFound, "The texture " + name + " does not exist."};
    }
    try {
        OIIO::ImageSpec hints;
        hints.attribute("oiio:UnassociatedAlpha", 1);  // colours as they are in the file, not times alpha
        const auto input = OIIO::ImageInput::open(name, &hints);
        if (!input) {
            return Error{ErrorCode::fileUnreadable,
                         "The texture " + name + " cannot be opened as an image: " + OIIO::geterror() + "."};
        }
        return readOpen(*input, name, options);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "There is not enough memory for the texture " + name + "."};
    } catch (const std::exception& problem) {
        return Error{ErrorCode::fileUnreadable, "The texture " + name + " cannot be read: " + problem.what() + "."};
    }
}

TextureImage::TextureImage(int width, int height, int channels, std::vector<float> linear)
    : width_(width), height_(height), channels_(channels), floats_(std::move(linear)) {
    computeMean();
}

TextureImage::TextureImage(int width, int height, int channels, std::vector<std::uint8_t> bytes,
                           const std::array<float, 256>& toLinear)
    : width_(width), height_(height), channels_(channels), bytes_(std::move(bytes)), toLinear_(toLinear) {
    computeMean();
}

void TextureImage::computeMean() {
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
    mean_ = {static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n)};
}

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace emca::render
