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

TEST(Options, ASessionIsKnownByItsName) {
    QTemporaryDir folder;
    const QString file = folder.filePath("a b.emca");
    QFile(file).open(QIODevice::WriteOnly);
    const auto options = parseOptions({file, "--tour", "x"});
    ASSERT_TRUE(options);
    EXPECT_EQ(options->session, file);
    EXPECT_TRUE(options->image.isEmpty());
    const auto missing = parseOptions({"missing.emca"});
    ASSERT_FALSE(missing);
    EXPECT_EQ(exitCode(missing.error()), 3);
}

TEST(Options, MistakesNameWhatIsWrong) {
    for (const QStringList& wrong : {QStringList{"--pixel", "12"}, {"--region", "1,2,3"}, {"--region", "4,0,4,9"}, {"--region", "0,0,1.5,2"}, {"--pixel", "-1,2"}, {"--size", "10x10"}, {"--theme", "blue"},
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

TEST(Options, LayersAndTheSceneAlone) {
    const auto options = parseOptions({"50013", "--layers", "hits, path depth", "--show-layer", "path depth", "--layer-range=-1,2.5", "--layer-log",
                                       "--layer-map", "inferno", "--opacity", "0.5", "--paths", "0", "--eye", "1,2,-3.5", "--target", "0,0,0", "--fov", "35",
                                       "--layer-exposure", "-2", "--layer-percentiles", "0,99.5", "--only", "scene", "--screenshot", "a.png"});
    ASSERT_TRUE(options) << options.error().message;
    const SceneWishes& scene = options->scene;
    EXPECT_EQ(scene.layers, (std::vector<std::string>{"hits", "path depth"}));
    EXPECT_EQ(scene.showLayer, "path depth");
    EXPECT_EQ(scene.range, (SurfaceLimits{-1, 2.5}));
    EXPECT_EQ(scene.percentiles, (SurfaceLimits{0, 99.5}));
    EXPECT_TRUE(scene.log);
    EXPECT_EQ(scene.map, analysis::ColorMapId::inferno);
    EXPECT_EQ(scene.opacity, 0.5f);
    EXPECT_EQ(scene.exposure, -2.f);
    EXPECT_EQ(scene.paths, false);
    EXPECT_EQ(scene.eye, (Vec3d{1, 2, -3.5}));
    EXPECT_EQ(scene.target, (Vec3d{0, 0, 0}));
    EXPECT_EQ(scene.fieldOfView, 35.0);
    EXPECT_TRUE(options->onlyScene);
    EXPECT_EQ(parseOptions({"50013", "--show-layer", "hits"})->scene.layers, std::vector<std::string>{"hits"}) << "shown is collected";
    EXPECT_TRUE(parseOptions({"50013", "--show-layer", "none"})->scene.layers.empty());
}

TEST(Options, AReferenceAndHowItIsCompared) {
    QTemporaryDir folder;
    QFile file(folder.filePath("reference.exr"));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    const auto options = parseOptions({"50013", "--reference", file.fileName(), "--compare", "absolute error"});
    ASSERT_TRUE(options) << options.error().message;
    EXPECT_EQ(options->reference, file.fileName());
    EXPECT_EQ(options->compare, "absolute error");
    EXPECT_EQ(exitCode(parseOptions({"50013", "--reference", "/nowhere/a.exr"}).error()), 3);
    EXPECT_EQ(exitCode(parseOptions({"50013", "--reference", file.fileName(), "--compare", "beauty"}).error()), 2);
    EXPECT_EQ(exitCode(parseOptions({"50013", "--compare", "split"}).error()), 2);
}

TEST(Options, FaultyWishesAreUsageErrors) {
    for (const QStringList& faulty : std::vector<QStringList>{{"--layers", ","}, {"--layer-range", "3"}, {"--layer-range", "3,1"}, {"--layer-range", "a,b"},
                                                              {"--layer-percentiles", "-1,50"}, {"--layer-map", "rainbow"}, {"--opacity", "1.5"},
                                                              {"--opacity", "nan"}, {"--paths", "yes"}, {"--eye", "1,2"}, {"--target", "1,2,inf"},
                                                              {"--fov", "0"}, {"--only", "image"}, {"--only", "scene"}}) {
        const auto options = parseOptions(QStringList{"50013"} + faulty);
        ASSERT_FALSE(options) << faulty.join(' ').toStdString();
        EXPECT_EQ(exitCode(options.error()), 2);
    }
}

}  // namespace
}  // namespace emca::explorer
