#include "emca/imageio/imageio.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <cmath>

#include "testing/image_files.h"

namespace emca::imageio {
namespace {

namespace fs = std::filesystem;

TEST_F(ImageFiles, FloatsKeepEveryBitInExrAndPfm) {
    const Image image = randomBits(37, 23);
    for (const char* name : {"a.exr", "a.pfm", "A.EXR"}) {
        ASSERT_TRUE(write(file(name), image).ok()) << name;
        const Result<Image> back = read(file(name));
        ASSERT_TRUE(back.ok()) << back.error().message;
        EXPECT_TRUE(sameBits(*back, image)) << name;
    }
    EXPECT_EQ(fileCount(), 3u);  // nothing temporary stays
}

TEST_F(ImageFiles, OneChannelAndManyChannels) {
    const Image depth = randomBits(5, 4, {"Y"}), many = randomBits(6, 7, {"R", "G", "B", "A", "normal.X", "albedo.R"});
    ASSERT_TRUE(write(file("y.exr"), depth).ok());
    ASSERT_TRUE(write(file("y.pfm"), depth).ok());
    ASSERT_TRUE(write(file("many.exr"), many).ok());
    EXPECT_TRUE(sameBits(*read(file("y.exr")), depth));
    EXPECT_EQ(std::memcmp(read(file("y.pfm"))->data(), depth.data(), depth.size() * sizeof(float)), 0);
    const Result<Image> back = read(file("many.exr"));
    ASSERT_TRUE(back.ok());
    ASSERT_EQ(back->channelCount(), 6u);
    for (std::uint32_t c = 0; c < 6; ++c) {
        const int in = many.channelIndex(back->channels()[c]);
        ASSERT_GE(in, 0);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(back->at({3, 5})[c]), std::bit_cast<std::uint32_t>(many.at({3, 5})[in]));
    }
}

TEST_F(ImageFiles, ColorsComeFirstWhateverTheFileSays) {
    Image image(1, 1, {"albedo", "B", "G", "R", "A"});
    for (int i = 0; i < 5; ++i) image.data()[i] = static_cast<float>(i);
    ASSERT_TRUE(write(file("order.exr"), image).ok());
    const Result<Image> back = read(file("order.exr"));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->channels(), (std::vector<std::string>{"R", "G", "B", "A", "albedo"}));
    EXPECT_EQ(back->color({0, 0}), Color(3, 2, 1));
}

TEST_F(ImageFiles, RowsRunFromTheTop) {
    Image image(2, 3);
    image.setColor({1, 0}, {1, 2, 3});
    for (const char* name : {"top.exr", "top.pfm", "top.hdr", "top.png"}) {
        ASSERT_TRUE(write(file(name), image).ok());
        const Result<Image> back = read(file(name));
        ASSERT_TRUE(back.ok()) << name;
        EXPECT_GT(back->color({1, 0}).b, 0.9f) << name;
        EXPECT_EQ(back->color({1, 2}), Color(0, 0, 0)) << name;
    }
    // The format's own words: colours, width and height, little endian, rows from the bottom.
    const std::string pfm = bytesOf(file("top.pfm"));
    const std::string header = "PF\n2 3\n-1.0\n";
    ASSERT_EQ(pfm.substr(0, header.size()), header);
    float last[3];
    std::memcpy(last, pfm.data() + header.size() + (2 * 2 + 1) * 3 * sizeof(float), sizeof last);
    EXPECT_EQ(last[2], 3);
}

TEST_F(ImageFiles, BigEndianPfm) {
    std::string bytes = "Pf\n1 1\n1.0\n";
    const auto bits = std::bit_cast<std::uint32_t>(2.5f);
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(bits >> shift));
    writeBytes(file("big.pfm"), bytes);
    const Result<Image> back = read(file("big.pfm"));
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->data()[0], 2.5f);
}

TEST_F(ImageFiles, EightBitsAreSrgb) {
    Image image(256, 1);
    for (std::uint32_t x = 0; x < 256; ++x) {
        const double v = x / 255.0;
        image.setColor({x, 0},
                       Color(static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4))));
    }
    ASSERT_TRUE(write(file("ramp.png"), image).ok());
    const Result<Image> back = read(file("ramp.png"));
    ASSERT_TRUE(back.ok());
    for (std::uint32_t x = 0; x < 256; ++x) EXPECT_NEAR(back->color({x, 0}).g, image.color({x, 0}).g, 1e-6f);
    image.setColor({0, 0}, {std::nanf(""), -1, 7});
    ASSERT_TRUE(write(file("clamped.png"), image).ok());
    EXPECT_EQ(read(file("clamped.png"))->color({0, 0}), Color(0, 0, 1));
}

TEST_F(ImageFiles, RadianceFilesKeepTheirPrecision) {
    Image image(40, 2);
    for (std::uint32_t x = 0; x < 40; ++x) image.setColor({x, 1}, Color(std::exp2(static_cast<float>(x) - 20)));
    image.setColor({0, 0}, {std::nanf(""), -3, std::numeric_limits<float>::infinity()});
    ASSERT_TRUE(write(file("a.hdr"), image).ok());
    const Result<Image> back = read(file("a.hdr"));
    ASSERT_TRUE(back.ok());
    for (std::uint32_t x = 0; x < 40; ++x) {
        const float expected = image.color({x, 1}).r;
        EXPECT_NEAR(back->color({x, 1}).r, expected, expected / 100);
    }
    EXPECT_EQ(back->color({0, 0}).r, 0);
    EXPECT_EQ(back->color({0, 0}).g, 0);
    EXPECT_GT(back->color({0, 0}).b, 1e38f);
}

TEST_F(ImageFiles, RenderWithSamplesAndVariance) {
    RenderedImage render{Image(3, 2), Image(3, 2, {"samples"}), Image(3, 2)};
    render.color.setColor({2, 1}, {1, 2, 3});
    *render.samples.at({2, 1}) = 64;
    render.variance.setColor({2, 1}, {4, 5, 6});
    ASSERT_TRUE(write(file("render.exr"), render).ok());
    const Result<Image> back = read(file("render.exr"));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->channelCount(), 7u);
    EXPECT_EQ(back->color({2, 1}), Color(1, 2, 3));
    const auto value = [&](const char* channel) { return back->at({2, 1})[back->channelIndex(channel)]; };
    EXPECT_EQ(value("samples"), 64);
    EXPECT_EQ(value("variance.R"), 4);
    EXPECT_EQ(value("variance.B"), 6);
    ASSERT_TRUE(write(file("render.png"), render).ok());
    render.variance = Image(2, 2);
    EXPECT_EQ(write(file("render.exr"), render).error().code, ErrorCode::invalidArgument);
}

/// Writes a file as other programs do.
void writeForeign(const fs::path& path, OIIO::ImageSpec spec, const std::vector<float>& values) {
    const auto out = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(out && out->open(path.string(), spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
                out->close());
}

TEST_F(ImageFiles, HalfFloatsAreLinearAndExact) {
    OIIO::ImageSpec spec(3, 1, 3, OIIO::TypeDesc::HALF);
    const float inf = std::numeric_limits<float>::infinity();
    const std::vector<float> values{0.5f, 65504.f, -0.25f, inf, -inf, 5.9604645e-8f, std::nanf(""), 1, 0};
    writeForeign(file("half.exr"), spec, values);
    const Result<Image> back = read(file("half.exr"));
    ASSERT_TRUE(back.ok()) << back.error().message;
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_TRUE(back->data()[i] == values[i] || (std::isnan(back->data()[i]) && std::isnan(values[i]))) << i;
}

TEST_F(ImageFiles, CropsAreShownInTheirFrame) {
    OIIO::ImageSpec spec(2, 1, 1, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"Y"};
    spec.x = 3;
    spec.y = 1;
    spec.full_width = 6;
    spec.full_height = 4;
    writeForeign(file("crop.exr"), spec, {7, 8});
    const Result<Image> back = read(file("crop.exr"));
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->width(), 6u);
    EXPECT_EQ(back->height(), 4u);
    EXPECT_EQ(*back->at({3, 1}), 7);
    EXPECT_EQ(*back->at({4, 1}), 8);
    EXPECT_EQ(*back->at({5, 1}), 0);
    EXPECT_EQ(*back->at({3, 0}), 0);
}

TEST_F(ImageFiles, AlphaOfEightBitsIsNotDecoded) {
    writeForeign(file("alpha.png"),
                 [] {
                     OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeDesc::UINT8);
                     spec.attribute("oiio:UnassociatedAlpha", 1);
                     return spec;
                 }(),
                 {1, 0, 0, 51 / 255.f});
    const Result<Image> back = read(file("alpha.png"));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->color({0, 0}), Color(1, 0, 0));  // not multiplied with alpha
    EXPECT_NEAR(back->data()[3], 0.2f, 1e-6f);
}

TEST_F(ImageFiles, EveryTruncationIsRefusedOrWhole) {
    const Image image = [] {
        std::mt19937 random(2);
        Image noise(20, 20);
        for (std::size_t i = 0; i < noise.size(); ++i) noise.data()[i] = static_cast<float>(random() % 256) / 255.f;
        return noise;
    }();
    for (const char* name : {"a.exr", "a.pfm", "a.hdr", "a.png"}) {
        ASSERT_TRUE(write(file(name), image).ok());
        const Result<Image> whole = read(file(name));
        ASSERT_TRUE(whole.ok());
        const std::string bytes = bytesOf(file(name));
        const fs::path cut = file(std::string("cut") + fs::path(name).extension().string());
        for (std::size_t length = 0; length < bytes.size();
             length += length < 32 || length + 32 > bytes.size() ? 1 : 41) {
            writeBytes(cut, bytes.substr(0, length));
            const Result<Image> part = read(cut);
            if (part.ok()) {
                EXPECT_TRUE(sameBits(*part, *whole)) << name << " cut at " << length << " of " << bytes.size();
            } else {
                EXPECT_EQ(part.error().code, ErrorCode::fileUnreadable) << part.error().message;
            }
        }
    }
}

TEST_F(ImageFiles, HeadersThatPromiseTooMuch) {
    writeBytes(file("wide.pfm"), "PF\n70000 1\n-1.0\n");
    EXPECT_EQ(read(file("wide.pfm")).error().code, ErrorCode::tooLarge);
    writeBytes(file("many.pfm"), "PF\n60000 60000\n-1.0\n");
    EXPECT_EQ(read(file("many.pfm")).error().code, ErrorCode::tooLarge);
    writeBytes(file("thin.pfm"), "PF\n20000 20000\n-1.0\n1234");
    const Result<Image> thin = read(file("thin.pfm"));
    ASSERT_FALSE(thin.ok());
    EXPECT_EQ(thin.error().code, ErrorCode::fileUnreadable);
    EXPECT_NE(thin.error().message.find("20000"), std::string::npos) << thin.error().message;
    for (const char* size : {"0 0", "-1 5", "99999999999 2", "2 x"}) {
        writeBytes(file("odd.pfm"), std::string("PF\n") + size + "\n-1.0\n");
        EXPECT_FALSE(read(file("odd.pfm")).ok()) << size;
    }
}

TEST_F(ImageFiles, WhatIsNoImageIsRefusedWithASentence) {
    EXPECT_EQ(read(file("absent.exr")).error().code, ErrorCode::fileNotFound);
    EXPECT_EQ(read(folder_).error().code, ErrorCode::fileUnreadable);
    for (const char* name : {"text.exr", "text.png", "text.hdr", "text.pfm", "text.xyz", "text"}) {
        writeBytes(file(name), "this is no image");
        const Result<Image> result = read(file(name));
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::fileUnreadable);
        EXPECT_NE(result.error().message.find(name), std::string::npos);
        EXPECT_EQ(result.error().message.back(), '.');
        EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
    }
}

TEST_F(ImageFiles, AFailedWriteLeavesTheOldFile) {
    const Image image = randomBits(8, 8);
    ASSERT_TRUE(write(file("kept.exr"), image).ok());
    EXPECT_EQ(write(file("kept.exr"), Image()).error().code, ErrorCode::invalidArgument);
    EXPECT_EQ(write(file("kept.exr"), Image(2, 2, {"R", "R"})).error().code, ErrorCode::invalidArgument);
    EXPECT_TRUE(sameBits(*read(file("kept.exr")), image));
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(ImageFiles, UnwritablePlaces) {
    const Image image(2, 2);
    EXPECT_EQ(write(file("none/a.exr"), image).error().code, ErrorCode::fileUnwritable);
    EXPECT_EQ(checkWritable(file("none/a.exr")).error().code, ErrorCode::fileUnwritable);
    EXPECT_EQ(checkWritable(file("a.jpg")).error().code, ErrorCode::notSupported);
    EXPECT_TRUE(checkWritable(file("a.exr")).ok());
    EXPECT_EQ(fileCount(), 0u);
    fs::create_directory(file("folder.exr"));
    EXPECT_EQ(write(file("folder.exr"), image).error().code, ErrorCode::fileUnwritable);
    fs::permissions(folder_,
                    fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
    // The superuser may write everywhere: be nobody meanwhile.
    const uid_t user = ::geteuid();
    constexpr uid_t kNobody = 65534;
    if (user == 0) {
        ASSERT_EQ(::seteuid(kNobody), 0);
    }
    const Result<void> result = write(file("a.exr"), image);
    if (user == 0) {
        ASSERT_EQ(::seteuid(user), 0);
    }
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::fileUnwritable);
}

TEST_F(ImageFiles, UnknownExtensionsAreNamed) {
    for (const char* name : {"a.xyz", "a", "a.jpeg"}) {
        const Result<void> result = write(file(name), Image(2, 2));
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::notSupported);
        EXPECT_NE(result.error().message.find(".exr"), std::string::npos);
    }
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(ImageFiles, WritingThroughALinkKeepsItAndPermissionsStay) {
    ASSERT_TRUE(write(file("real.exr"), Image(2, 2)).ok());
    fs::permissions(file("real.exr"), fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink(file("real.exr"), file("link.exr"));
    ASSERT_TRUE(write(file("link.exr"), Image(3, 3)).ok());
    EXPECT_TRUE(fs::is_symlink(file("link.exr")));
    EXPECT_EQ(read(file("real.exr"))->width(), 3u);
    EXPECT_EQ(fs::status(file("real.exr")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace
}  // namespace emca::imageio
