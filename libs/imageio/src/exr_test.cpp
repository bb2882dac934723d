// EXR by OpenEXR's own library says the same as OpenImageIO, which reads and writes the files here for comparison.
#include "exr.h"

#include <OpenEXR/ImfRgbaFile.h>
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "emca/imageio/imageio.h"
#include "testing/image_files.h"

namespace emca::imageio {
namespace {

namespace fs = std::filesystem;

/// All values of a file's data window as OpenImageIO reads them; its channel names and windows in `spec`.
std::vector<float> foreignRead(const fs::path& path, OIIO::ImageSpec& spec) {
    const auto in = OIIO::ImageInput::open(path.string());
    if (!in) return {};
    spec = in->spec();
    std::vector<float> values(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) return {};
    return values;
}

bool foreignWrite(const fs::path& path, const OIIO::ImageSpec& spec, const std::vector<float>& values) {
    const auto out = OIIO::ImageOutput::create(path.string());
    return out && out->open(path.string(), spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
           out->close();
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Finite values of every size that halves have, some of them repeated so that there is something to compress.
std::vector<float> smoothNoise(std::size_t count) {
    std::mt19937 random(7);
    std::vector<float> values(count);
    for (float& value : values)
        value = std::ldexp(static_cast<float>(random() % 2048) - 1024.f, static_cast<int>(random() % 4) - 9);
    return values;
}

TEST_F(ImageFiles, OpenImageIoReadsOursToTheSameBits) {
    const Image image = randomBits(67, 41, {"R", "G", "B", "variance.R", "variance.G", "samples", "a long name of 1"});
    ASSERT_TRUE(write(file("ours.exr"), image).ok());
    OIIO::ImageSpec spec;
    const std::vector<float> values = foreignRead(file("ours.exr"), spec);
    ASSERT_EQ(values.size(), image.size());
    EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
    EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
    EXPECT_EQ(spec.width, 67);
    EXPECT_EQ(spec.full_height, 41);
    const std::size_t channels = image.channelCount();
    for (std::size_t c = 0; c < channels; ++c) {
        const int ours = image.channelIndex(spec.channelnames[c]);
        ASSERT_GE(ours, 0) << spec.channelnames[c];
        for (std::size_t i = 0; i < values.size() / channels; ++i)
            ASSERT_EQ(bits(values[i * channels + c]), bits(image.data()[i * channels + std::size_t(ours)])) << i;
    }
}

/// A data window and a display window: x, y, width, height.
struct Windows {
    int x, y, width, height, fullX, fullY, fullWidth, fullHeight;
};

/// What the header of imageio.h promises of a file, from OpenImageIO's reading of it.
void expectSameAsForeign(const fs::path& path) {
    SCOPED_TRACE(path.filename());
    OIIO::ImageSpec spec;
    const std::vector<float> values = foreignRead(path, spec);
    ASSERT_FALSE(values.empty()) << OIIO::geterror();
    const auto native = readExr(path, fs::file_size(path));
    ASSERT_TRUE(native.ok() && native->has_value()) << "was left to the module";
    EXPECT_EQ((*native)->channels, spec.channelnames);
    EXPECT_EQ((*native)->alphaChannel, spec.alpha_channel);
    ASSERT_EQ((*native)->floats.size(), values.size());
    EXPECT_EQ(std::memcmp((*native)->floats.data(), values.data(), values.size() * sizeof(float)), 0);

    const Result<Image> image = read(path);
    ASSERT_TRUE(image.ok()) << image.error().message;
    ASSERT_EQ(image->width(), static_cast<std::uint32_t>(spec.full_width));
    ASSERT_EQ(image->height(), static_cast<std::uint32_t>(spec.full_height));
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    for (std::uint32_t row = 0; row < image->height(); ++row)
        for (std::uint32_t column = 0; column < image->width(); ++column)
            for (std::size_t c = 0; c < channels; ++c) {
                const int x = int(column) + spec.full_x - spec.x, y = int(row) + spec.full_y - spec.y;
                const bool stored = x >= 0 && y >= 0 && x < spec.width && y < spec.height;
                const float expected =
                    stored ? values[(std::size_t(y) * std::size_t(spec.width) + std::size_t(x)) * channels + c] : 0.f;
                const float found = image->at({column, row})[image->channelIndex(spec.channelnames[c])];
                ASSERT_EQ(bits(found), bits(expected)) << column << ", " << row << " " << spec.channelnames[c];
            }
}

TEST_F(ImageFiles, ForeignFilesAreReadToTheSameBits) {
    const Windows same{0, 0, 70, 45, 0, 0, 70, 45}, crop{20, 10, 70, 45, 0, 0, 100, 80},
        overscan{-5, -7, 70, 45, 0, 0, 60, 30}, shifted{40, -20, 70, 45, 10, -30, 60, 30},
        apart{200, 100, 70, 45, 0, 0, 40, 20};
    int number = 0;
    for (const char* compression :
         {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"})
        for (const OIIO::TypeDesc type : {OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT})
            for (const bool tiled : {false, true})
                for (const Windows& w : {same, crop, overscan, shifted, apart}) {
                    if (w.x == apart.x && compression != std::string("zip")) continue;
                    OIIO::ImageSpec spec(w.width, w.height, 4, type);
                    spec.x = w.x, spec.y = w.y;
                    spec.full_x = w.fullX, spec.full_y = w.fullY;
                    spec.full_width = w.fullWidth, spec.full_height = w.fullHeight;
                    if (tiled) spec.tile_width = 32, spec.tile_height = 16;
                    spec.attribute("compression", compression);
                    const fs::path path = file(std::to_string(number++) + "-" + compression +
                                               (tiled ? "-tiled-" : "-lines-") + type.c_str() + ".exr");
                    ASSERT_TRUE(foreignWrite(path, spec, smoothNoise(std::size_t(w.width * w.height * 4))));
                    expectSameAsForeign(path);
                }
}

TEST_F(ImageFiles, EveryHalfBecomesTheSameFloat) {
    OIIO::ImageSpec spec(256, 256, 1, OIIO::TypeDesc::HALF);
    std::vector<std::uint16_t> halves(65536);
    for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = static_cast<std::uint16_t>(i);
    const std::string path = file("halves.exr").string();
    const auto out = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(out->open(path, spec) && out->write_image(OIIO::TypeDesc::HALF, halves.data()) && out->close());
    expectSameAsForeign(path);
}

TEST_F(ImageFiles, MixedKindsOfChannels) {
    OIIO::ImageSpec spec(9, 8, 4, OIIO::TypeDesc::FLOAT);
    spec.channelformats = {OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF, OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT};
    spec.channelnames = {"R", "G", "B", "Z"};
    ASSERT_TRUE(foreignWrite(file("mixed.exr"), spec, smoothNoise(9 * 8 * 4)));
    expectSameAsForeign(file("mixed.exr"));
}

TEST_F(ImageFiles, ChannelsAreInTheOrderOfOpenImageIo) {
    const std::vector<std::string> pool{"R", "G", "B", "A", "Y", "Z", "X", "red", "Green", "blue", "alpha", "depth",
                                        "ZBack", "AR", "real", "imag", "samples", "u", "v", "N.x", "N.y", "N.z", "P.X",
                                        "P.Z", "diffuse.R", "diffuse.G", "diffuse.B", "diffuse.A", "a.b.R", "a.b.B",
                                        "variance.B", "variance.R", "variance.G", "N.A", "P.real", "GA", "BA", "x"};
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        std::vector<std::string> names = pool;
        std::shuffle(names.begin(), names.end(), random);
        names.resize(1 + random() % 12);
        ASSERT_TRUE(write(file("order.exr"), Image(1, 1, names)).ok());
        OIIO::ImageSpec spec;
        foreignRead(file("order.exr"), spec);
        EXPECT_EQ(inLayerOrder(names), spec.channelnames);
        EXPECT_EQ(alphaOf(inLayerOrder(names)), spec.alpha_channel);
    }
}

TEST_F(ImageFiles, OddKindsAreLeftToTheModule) {
    const auto leftAlone = [&](const char* name) {
        const auto native = readExr(file(name), fs::file_size(file(name)));
        return native.ok() && !native->has_value();
    };
    ASSERT_TRUE(foreignWrite(file("whole.exr"), OIIO::ImageSpec(4, 3, 1, OIIO::TypeDesc::UINT32),
                             std::vector<float>(12, 1.f)));
    EXPECT_TRUE(leftAlone("whole.exr"));
    EXPECT_EQ(read(file("whole.exr"))->data()[0], 1.f);

    const std::string parts = file("parts.exr").string();
    const auto out = OIIO::ImageOutput::create(parts);
    OIIO::ImageSpec specs[2] = {OIIO::ImageSpec(4, 3, 1, OIIO::TypeDesc::FLOAT),
                                OIIO::ImageSpec(4, 3, 3, OIIO::TypeDesc::HALF)};
    specs[0].attribute("oiio:subimagename", "first");
    specs[1].attribute("oiio:subimagename", "second");
    const std::vector<float> values = smoothNoise(36);
    ASSERT_TRUE(out->open(parts, 2, specs) && out->write_image(OIIO::TypeDesc::FLOAT, values.data()) &&
                out->open(parts, specs[1], OIIO::ImageOutput::AppendSubimage) &&
                out->write_image(OIIO::TypeDesc::FLOAT, values.data()) && out->close())
        << out->geterror();
    EXPECT_TRUE(leftAlone("parts.exr"));
    const Result<Image> first = read(parts);
    ASSERT_TRUE(first.ok()) << first.error().message;
    EXPECT_EQ(first->width(), 4u);
    EXPECT_EQ(first->data()[7], values[7]);

    {
        std::vector<Imf::Rgba> pixels(16 * 16, Imf::Rgba(0.5f, 0.25f, 0.125f, 1.f));
        Imf::RgbaOutputFile chroma(file("chroma.exr").c_str(), 16, 16, Imf::WRITE_YC);
        chroma.setFrameBuffer(pixels.data(), 1, 16);
        chroma.writePixels(16);
    }
    EXPECT_TRUE(leftAlone("chroma.exr"));
    OIIO::ImageSpec spec;
    EXPECT_EQ(read(file("chroma.exr")).ok(), !foreignRead(file("chroma.exr"), spec).empty());

    OIIO::ImageSpec deep(2, 2, 1, OIIO::TypeDesc::FLOAT);
    deep.deep = true;
    deep.channelnames = {"Z"};
    OIIO::DeepData samples;
    samples.init(4, 1, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT), deep.channelnames);
    for (int pixel = 0; pixel < 4; ++pixel) samples.set_samples(pixel, 1);
    const auto deepOut = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(deepOut->open(file("deep.exr").string(), deep) && deepOut->write_deep_image(samples) &&
                deepOut->close());
    EXPECT_TRUE(leftAlone("deep.exr"));
    EXPECT_NE(read(file("deep.exr")).error().message.find("deep"), std::string::npos);
}

/// A name is a name: what is inside counts.
TEST_F(ImageFiles, ContentsDecideTheFormat) {
    ASSERT_TRUE(write(file("a.exr"), randomBits(4, 4)).ok());
    ASSERT_TRUE(write(file("b.png"), Image(5, 5)).ok());
    fs::rename(file("a.exr"), file("a.png"));
    fs::rename(file("b.png"), file("b.exr"));
    EXPECT_TRUE(sameBits(*read(file("a.png")), randomBits(4, 4)));
    EXPECT_EQ(read(file("b.exr"))->width(), 5u);
}

class DamagedExr : public ImageFiles {
  protected:
    /// Files of different kinds with the same noise.
    std::vector<fs::path> files() {
        std::vector<fs::path> made;
        for (const char* compression : {"zip", "none", "piz", "b44", "dwaa", "rle", "pxr24"})
            for (const bool tiled : {false, true}) {
                OIIO::ImageSpec spec(50, 40, 3, tiled ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
                if (tiled) spec.tile_width = 16, spec.tile_height = 16;
                spec.attribute("compression", compression);
                made.push_back(file(std::string(compression) + (tiled ? "-tiled.exr" : ".exr")));
                EXPECT_TRUE(foreignWrite(made.back(), spec, smoothNoise(50 * 40 * 3)));
            }
        return made;
    }
};

TEST_F(DamagedExr, EveryFiftiethIsRefused) {
    for (const fs::path& whole : files()) {
        const std::string bytes = bytesOf(whole);
        for (std::size_t part = 0; part < 50; ++part) {
            writeBytes(file("cut.exr"), bytes.substr(0, bytes.size() * part / 50));
            const Result<Image> image = read(file("cut.exr"));
            ASSERT_FALSE(image.ok()) << whole << " " << part;
            EXPECT_EQ(image.error().code, ErrorCode::fileUnreadable);
            EXPECT_NE(image.error().message.find("cut.exr"), std::string::npos);
            EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
        }
    }
}

TEST_F(DamagedExr, WrongBytesDoNoHarm) {
    std::mt19937 random(11);
    int refused = 0, accepted = 0;
    for (const fs::path& whole : files()) {
        const std::string bytes = bytesOf(whole);
        for (int round = 0; round < 40; ++round) {
            std::string damaged = bytes;
            const std::size_t range = round % 2 == 0 ? std::min<std::size_t>(bytes.size(), 400) : bytes.size();
            for (int change = 0; change < 3; ++change) damaged[random() % range] = static_cast<char>(random());
            writeBytes(file("damaged.exr"), damaged);
            const Result<Image> image = read(file("damaged.exr"));
            ++(image.ok() ? accepted : refused);
        }
    }
    EXPECT_GT(refused, 50);  // the damage is real
    EXPECT_GT(accepted, 50);     // and not only in the first byte
}

TEST_F(ImageFiles, WindowsThatPromiseTooMuch) {
    ASSERT_TRUE(write(file("a.exr"), Image(4, 4)).ok());
    const std::string bytes = bytesOf(file("a.exr"));
    const auto withWindow = [&](const std::string& name, std::array<std::int32_t, 4> window) {
        std::string changed = bytes;
        const std::string before = name + '\0' + std::string("box2i") + '\0';
        const std::size_t at = changed.find(before);
        EXPECT_NE(at, std::string::npos);
        std::memcpy(&changed[at + before.size() + 4], window.data(), sizeof window);
        writeBytes(file("changed.exr"), changed);
        return read(file("changed.exr"));
    };
    constexpr int kHuge = 1 << 29;
    EXPECT_EQ(withWindow("displayWindow", {0, 0, kHuge, 3}).error().code, ErrorCode::tooLarge);
    EXPECT_EQ(withWindow("displayWindow", {0, 0, 59999, 19999}).error().code, ErrorCode::tooLarge);
    EXPECT_EQ(withWindow("displayWindow", {0, 0, 19999, 19999}).error().code, ErrorCode::fileUnreadable);
    EXPECT_EQ(withWindow("displayWindow", {0, 0, 3, 3}).ok(), true);
    EXPECT_EQ(withWindow("displayWindow", {-kHuge, -kHuge, 3 - kHuge, 3 - kHuge})->color({0, 0}), Color(0.f));
    EXPECT_EQ(withWindow("dataWindow", {0, 0, 69999, 3}).error().code, ErrorCode::tooLarge);
    EXPECT_EQ(withWindow("dataWindow", {0, 0, kHuge, 3}).error().code, ErrorCode::tooLarge);
    for (const auto& window : {std::array{0, 0, 3, kHuge}, {5, 5, 0, 0}, {-kHuge, -kHuge, kHuge, kHuge}, {0, 0, 3, 59999}})
        EXPECT_FALSE(withWindow("dataWindow", window).ok());
}

/// A disk that is full at any byte: the old file stays, and it is said.
TEST_F(ImageFiles, AFullDiskIsNoticed) {
    const Image image = randomBits(64, 64);
    ASSERT_TRUE(write(file("a.exr"), Image(1, 1)).ok());
    const std::string old = bytesOf(file("a.exr"));
    ASSERT_TRUE(write(file("size.exr"), image).ok());
    const std::uintmax_t size = fs::file_size(file("size.exr"));
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{}, unlimited{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &unlimited), 0);
    for (const std::uintmax_t bytes : {std::uintmax_t(10), size / 2, size - 1}) {
        limit = unlimited;
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_FSIZE, &limit);
        const Result<void> written = write(file("a.exr"), image);
        setrlimit(RLIMIT_FSIZE, &unlimited);
        ASSERT_FALSE(written.ok()) << bytes;
        EXPECT_EQ(written.error().code, ErrorCode::fileUnwritable);
        EXPECT_EQ(bytesOf(file("a.exr")), old);
    }
    std::signal(SIGXFSZ, previous);
    EXPECT_EQ(fileCount(), 2u);
}

TEST_F(ImageFiles, NamesThatExrCannotKeep) {
    const std::string longName(256, 'x');
    for (const std::vector<std::string>& names :
         {std::vector<std::string>{"a", "a"}, {""}, {longName}, {std::string("a\0b", 3)}})
        EXPECT_EQ(write(file("names.exr"), Image(1, 1, names)).error().code, ErrorCode::invalidArgument);
    const Image longest(1, 1, {std::string(255, 'x'), std::string(254, 'x')});
    ASSERT_TRUE(write(file("names.exr"), longest).ok());
    EXPECT_EQ(read(file("names.exr"))->channelCount(), 2u);
}

/// Large enough for OpenEXR's own threads.
TEST_F(ImageFiles, ManyThreadsAtOnce) {
    const Image image = randomBits(700, 500);
    std::vector<std::thread> threads;
    std::array<bool, 4> same{};
    for (std::size_t i = 0; i < same.size(); ++i)
        threads.emplace_back([&, i] {
            const fs::path mine = file(std::to_string(i) + ".exr"), png = file(std::to_string(i) + ".png");
            same[i] = write(mine, image).ok() && sameBits(*read(mine), image) && write(png, Image(3, 3)).ok() &&
                      read(png).ok();
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(same, (std::array{true, true, true, true}));
}

}  // namespace
}  // namespace emca::imageio
