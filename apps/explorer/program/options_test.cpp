#include "program/options.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

namespace emca::explorer {
namespace {

TEST(Options, AddressPixelAndPicture) {
    const auto options = parseOptions({"127.0.0.1:50013", "--pixel", "12,34", "--screenshot", "out.png", "--size=1280x720", "--theme", "light", "--spp", "16"});
    ASSERT_TRUE(options);
    EXPECT_EQ(options->address, (client::Address{"127.0.0.1", 50013}));
    EXPECT_EQ(options->pixel, (Pixel{12, 34}));
    EXPECT_EQ(options->screenshot, "out.png");
    EXPECT_EQ(options->size, QSize(1280, 720));
    EXPECT_EQ(options->theme, ThemeKind::light);
    EXPECT_EQ(options->samplesPerPixel, 16u);
    EXPECT_TRUE(options->unattended());
}

TEST(Options, AFileThatIsThereIsAnImage) {
    QTemporaryDir folder;
    const QString file = folder.filePath("a picture.exr");
    QFile(file).open(QIODevice::WriteOnly);
    const auto options = parseOptions({file, "localhost:5000"});
    ASSERT_TRUE(options);
    EXPECT_EQ(options->image, file);
    EXPECT_EQ(options->address->host, "localhost");
}

TEST(Options, MistakesNameWhatIsWrong) {
    for (const QStringList& wrong : {QStringList{"--pixel", "12"}, {"--pixel", "-1,2"}, {"--size", "10x10"}, {"--theme", "blue"},
                                     {"--spp", "0"}, {"--spp", "1e3"}, {"--frobnicate", "1"}, {"--pixel"}, {"--tour", "x"}}) {
        const auto options = parseOptions(wrong);
        ASSERT_FALSE(options) << wrong.join(' ').toStdString();
        EXPECT_EQ(exitCode(options.error()), 2);
        EXPECT_FALSE(options.error().message.empty());
    }
    const auto missing = parseOptions({"missing.exr"});
    ASSERT_FALSE(missing);
    EXPECT_EQ(exitCode(missing.error()), 3);
}

}  // namespace
}  // namespace emca::explorer
