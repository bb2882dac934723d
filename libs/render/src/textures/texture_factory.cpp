#include <array>
#include <string_view>
#include <utility>

#include "emca/render/bsdf_factory.h"
#include "emca/render/property_reader.h"
#include "textures/bitmap_texture.h"
#include "textures/checkerboard_texture.h"
#include "textures/image_ahead.h"

namespace emca::render {

namespace {

BitmapTexture::Wrap readWrap(PropertyReader& read, std::string_view name, BitmapTexture::Wrap fallback) {
    using Wrap = BitmapTexture::Wrap;
    static constexpr std::array<std::pair<std::string_view, Wrap>, 6> kNames = {{
        {"repeat", Wrap::repeat},
        {"mirror", Wrap::mirror},
        {"clamp", Wrap::clamp},
        {"zero", Wrap::zero},
        {"black", Wrap::zero},
        {"one", Wrap::one},
    }};
    const auto written = read.text(name);
    if (!written) return fallback;
    for (const auto& [text, wrap] : kNames) {
        if (*written == text) return wrap;
    }
    read.reportProperty(
        name, "is \"" + *written + "\", but known are repeat, mirror, clamp, zero and one; repeat takes its place.");
    return fallback;
}

BitmapTexture::Filter readFilter(PropertyReader& read) {
    const std::string written = read.text("filter_type", "bilinear");
    if (written == "nearest") return BitmapTexture::Filter::nearest;
    // Scene files of 0.6 say "ewa" (the default there) and "trilinear", which differ only in how far images are
    // blurred.
    if (written != "bilinear" && written != "ewa" && written != "trilinear") {
        read.reportProperty("filter_type",
                            "is \"" + written + "\", but known are nearest and bilinear; bilinear takes its place.");
    }
    return BitmapTexture::Filter::bilinear;
}

/// The image that a bitmap names, being read or read already; null if it names none.
std::shared_ptr<ImageAhead> imageOf(PropertyReader& read, FactoryContext& context) {
    TextureImage::Options options;
    options.channel = read.text("channel", "");
    if (const auto gamma = read.number("gamma"); gamma && *gamma > 0.0) options.gamma = static_cast<float>(*gamma);
    if (read.flag("raw", false)) options.gamma = 1.f;

    const auto file = read.file("filename");
    if (!file) return nullptr;
    const std::string key = file->resolved.string() + '\n' + options.channel + '\n' +
                            (options.gamma ? std::to_string(*options.gamma) : "automatic");
    std::shared_ptr<ImageAhead>& image = context.images[key];
    if (!image) image = std::make_shared<ImageAhead>(file->resolved, options);
    return image;
}

std::shared_ptr<const TextureImage> readImage(PropertyReader& read, FactoryContext& context) {
    const auto ahead = imageOf(read, context);
    if (!ahead) {
        read.report(read.description() + " names no file; a grey of 0.5 takes its place.");
        return nullptr;
    }
    const ImageAhead::Image& image = ahead->wait();
    if (!image) {
        read.reportAt("filename", image.error().message + " A grey of 0.5 takes its place.");
        return nullptr;
    }
    return *image;
}

std::shared_ptr<const Texture> makeBitmap(PropertyReader& read, FactoryContext& context) {
    auto image = readImage(read, context);
    const UvMap map = readUvMap(read);
    const auto filter = readFilter(read);
    const auto wrap = readWrap(read, "wrap_mode", BitmapTexture::Wrap::repeat);
    const auto wrapU = readWrap(read, "wrap_mode_u", wrap);
    const auto wrapV = readWrap(read, "wrap_mode_v", wrap);
    // Hints for caches and filters that this renderer does not have; they change no picture on average.
    for (const char* name : {"cache", "max_anisotropy", "format"}) read.ignore(name);
    if (!image) return std::make_shared<ConstantTexture>(Color(0.5f));
    return std::make_shared<BitmapTexture>(std::move(image), map, filter, wrapU, wrapV);
}

std::shared_ptr<const Texture> makeCheckerboard(PropertyReader& read, FactoryContext& context) {
    const auto color = [&](std::string_view name, float fallback) {
        if (const auto nested = read.child(name)) {
            const auto texture = makeTexture(*nested, context);
            if (!texture->isConstant())
                read.reportAt(name, "A checkerboard's fields have one colour each; the texture's mean is used.");
            return texture->mean();
        }
        return read.color(name, Color(fallback));
    };
    const Color color0 = color("color0", 0.4f), color1 = color("color1", 0.2f);
    return std::make_shared<CheckerboardTexture>(color0, color1, readUvMap(read));
}

std::shared_ptr<const Texture> makeUnknown(PropertyReader& read, FactoryContext& context) {
    if (const auto nested = read.firstOfKind("texture")) {
        read.report(read.description() + " is not supported; the texture inside it is used without it.");
        return makeTexture(*nested, context);
    }
    read.report(read.description() + " is not supported; a grey of 0.5 takes its place.");
    return std::make_shared<ConstantTexture>(Color(0.5f));
}

}  // namespace

void readImageAhead(const SceneNode& texture, FactoryContext& context) {
    if (texture.type != "bitmap") return;
    std::vector<Diagnostic> later;  // makeTexture() says it
    PropertyReader read(texture, later, context.searchFolders);
    imageOf(read, context);
}

std::shared_ptr<const Texture> makeTexture(const SceneNode& node, FactoryContext& context) {
    if (const auto known = context.textures.find(&node); known != context.textures.end()) return known->second;
    PropertyReader read(node, context.diagnostics, context.searchFolders);
    std::shared_ptr<const Texture> result;
    if (node.type == "bitmap" || node.type == "checkerboard") {
        result = node.type == "bitmap" ? makeBitmap(read, context) : makeCheckerboard(read, context);
        read.reportUnused();
    } else {
        result = makeUnknown(read, context);
    }
    context.textures.emplace(&node, result);
    return result;
}

}  // namespace emca::render
