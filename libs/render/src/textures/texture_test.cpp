#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "testing/bsdf_cases.h"
#include "textures/bitmap_texture.h"
#include "textures/texture_image.h"

namespace emca::render {
namespace {

using ::testing::HasSubstr;
using testing::node;

/// Files of this test, removed at the end.
class TextureTest : public ::testing::Test {
  protected:
    void SetUp() override {
        const char* name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("emca_texture_test_") + name);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    template <typename T>
    std::string write(const std::string& name, int width, int height, int channels, const std::vector<T>& pixels,
                      OIIO::TypeDesc type) {
        const std::string path = (folder_ / name).string();
        const auto out = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(width, height, channels, type);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        EXPECT_TRUE(out && out->open(path, spec) && out->write_image(type, pixels.data()) && out->close()) << path;
        return path;
    }
    std::string writeBytes(const std::string& name, int width, int height, int channels,
                           const std::vector<unsigned char>& pixels) {
        return write(name, width, height, channels, pixels, OIIO::TypeDesc::UINT8);
    }

    std::filesystem::path folder_;
};

std::shared_ptr<const Texture> madeTexture(const std::shared_ptr<SceneNode>& from) {
    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    auto result = makeTexture(*from, context);
    for (const Diagnostic& diagnostic : diagnostics) ADD_FAILURE() << diagnostic.message;
    return result;
}

std::shared_ptr<SceneNode> bitmap(const std::string& file,
                                  std::initializer_list<std::pair<std::string, Property>> more = {}) {
    auto result = node("texture", "bitmap", more);
    result->properties["filename"] = {file, result->where};
    return result;
}

void expectNear(Color found, Color expected, float tolerance = 1e-5f) {
    EXPECT_NEAR(found.r, expected.r, tolerance);
    EXPECT_NEAR(found.g, expected.g, tolerance);
    EXPECT_NEAR(found.b, expected.b, tolerance);
}

TEST_F(TextureTest, BytesAreSrgbUnlessToldOtherwise) {
    const std::string file = writeBytes("grey.png", 1, 1, 3, {188, 128, 255});
    expectNear(madeTexture(bitmap(file))->eval({0.5f, 0.5f}), {0.502886f, 0.215861f, 1.f});
    expectNear(madeTexture(bitmap(file, {{"raw", true}}))->eval({0.5f, 0.5f}), {188.f / 255.f, 128.f / 255.f, 1.f});
    expectNear(madeTexture(bitmap(file, {{"gamma", 1.0}}))->eval({0.5f, 0.5f}), {188.f / 255.f, 128.f / 255.f, 1.f});
    expectNear(madeTexture(bitmap(file, {{"gamma", -1.0}}))->eval({0.5f, 0.5f}), {0.502886f, 0.215861f, 1.f});
    expectNear(madeTexture(bitmap(file, {{"gamma", 2.0}}))->eval({0.5f, 0.5f}), {0.543545f, 0.251965f, 1.f});
}

TEST_F(TextureTest, SixteenBitsAndFloats) {
    const std::string deep = write<std::uint16_t>("deep.png", 1, 1, 1, {32768}, OIIO::TypeDesc::UINT16);
    expectNear(madeTexture(bitmap(deep))->eval({0.5f, 0.5f}), Color(0.214051f), 1e-4f);
    const std::string exr =
        write<float>("half.exr", 1, 1, 3, {0.5f, 7.f, std::numeric_limits<float>::quiet_NaN()}, OIIO::TypeDesc::FLOAT);
    expectNear(madeTexture(bitmap(exr))->eval({0.5f, 0.5f}), {0.5f, 7.f, 0.f});
}

/// u to the right, v downwards from the first row, as in Mitsuba.
TEST_F(TextureTest, Orientation) {
    const std::string file = writeBytes("quad.png", 2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
    const auto texture = madeTexture(bitmap(file, {{"filter_type", std::string("nearest")}}));
    expectNear(texture->eval({0.25f, 0.25f}), {1, 0, 0});
    expectNear(texture->eval({0.75f, 0.25f}), {0, 1, 0});
    expectNear(texture->eval({0.25f, 0.75f}), {0, 0, 1});
    expectNear(texture->eval({0.75f, 0.75f}), {1, 1, 1});
    expectNear(texture->mean(), Color(0.5f));
    EXPECT_FALSE(texture->isConstant());
}

TEST_F(TextureTest, BilinearBetweenPixelCentres) {
    const std::string file = writeBytes("ramp.png", 2, 1, 1, {0, 255});
    const auto texture = madeTexture(bitmap(file, {{"wrap_mode", std::string("clamp")}}));
    EXPECT_NEAR(texture->evalScalar({0.25f, 0.5f}), 0.f, 1e-6f);
    EXPECT_NEAR(texture->evalScalar({0.5f, 0.1f}), 0.5f, 1e-6f);
    EXPECT_NEAR(texture->evalScalar({0.75f, 0.9f}), 1.f, 1e-6f);
    EXPECT_NEAR(texture->evalScalar({0.625f, 0.5f}), 0.75f, 1e-6f);
}

TEST_F(TextureTest, Wrapping) {
    const std::string file = writeBytes("pair.png", 2, 1, 1, {0, 255});
    const auto at = [&](const char* mode, float u) {
        return madeTexture(bitmap(file, {{"wrap_mode", std::string(mode)}, {"filter_type", std::string("nearest")}}))
            ->evalScalar({u, 0.5f});
    };
    // Fields of width 1/2: repeat 01|01, mirror 01|10.
    EXPECT_NEAR(at("repeat", 1.25f), 0.f, 1e-6f);
    EXPECT_NEAR(at("repeat", -0.25f), 1.f, 1e-6f);
    EXPECT_NEAR(at("repeat", 1000.75f), 1.f, 1e-6f);
    EXPECT_NEAR(at("mirror", 1.25f), 1.f, 1e-6f);
    EXPECT_NEAR(at("mirror", -0.25f), 0.f, 1e-6f);
    EXPECT_NEAR(at("mirror", 2.75f), 1.f, 1e-6f);
    EXPECT_NEAR(at("clamp", 5.f), 1.f, 1e-6f);
    EXPECT_NEAR(at("clamp", -5.f), 0.f, 1e-6f);
    EXPECT_NEAR(at("zero", 1.75f), 0.f, 1e-6f);
    EXPECT_NEAR(at("one", -1e6f), 1.f, 1e-6f);
    const auto bilinear = madeTexture(bitmap(file));
    EXPECT_NEAR(bilinear->evalScalar({0.f, 0.f}), 0.5f, 1e-6f) << "across the seam";
    for (const float odd : {1e30f, -1e30f, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN(), -1e-30f, 1.f}) {
        EXPECT_TRUE(isFinite(bilinear->eval({odd, odd}))) << odd;
        EXPECT_TRUE(std::isfinite(at("mirror", odd)) && std::isfinite(at("zero", odd))) << odd;
    }
}

TEST_F(TextureTest, OneChannel) {
    const std::string file = writeBytes("alpha.png", 1, 1, 4, {255, 128, 0, 64});
    expectNear(madeTexture(bitmap(file, {{"channel", std::string("a")}}))->eval({}), Color(64.f / 255.f));
    expectNear(madeTexture(bitmap(file, {{"channel", std::string("g")}}))->eval({}), Color(0.215861f));
    expectNear(madeTexture(bitmap(file))->eval({}), {1.f, 0.215861f, 0.f});

    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    expectNear(makeTexture(*bitmap(file, {{"channel", std::string("depth")}}), context)->eval({}), Color(0.5f));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_THAT(diagnostics[0].message, HasSubstr("\"depth\""));
}

TEST_F(TextureTest, CoordinatesAreMapped) {
    const std::string file = writeBytes("eight.png", 8, 1, 1, {0, 36, 73, 109, 146, 182, 219, 255});
    const std::initializer_list<std::pair<std::string, Property>> map = {
        {"uscale", 0.5}, {"uoffset", 0.25}, {"filter_type", std::string("nearest")}, {"raw", true}};
    EXPECT_NEAR(madeTexture(bitmap(file, map))->evalScalar({0.3f, 0.f}), 109.f / 255.f, 1e-6f)
        << "0.3 * 0.5 + 0.25 = 0.4: pixel 3";
    const auto turned = madeTexture(bitmap(
        file, {{"to_uv", Transform::rotate({0, 0, 1}, 90)}, {"filter_type", std::string("nearest")}, {"raw", true}}));
    EXPECT_NEAR(turned->evalScalar({0.9f, -0.7f}), 182.f / 255.f, 1e-6f) << "u' = -v = 0.7: pixel 5";
}

TEST_F(TextureTest, BadFilesAreNamedAndGrey) {
    const std::string garbage = (folder_ / "garbage.png").string();
    std::ofstream(garbage) << "this is no picture";
    const std::string cut =
        write<float>("whole.exr", 64, 64, 3, std::vector<float>(64 * 64 * 3, 0.3f), OIIO::TypeDesc::FLOAT);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
    for (const std::string& file : {std::string("absent.png"), garbage, cut, folder_.string()}) {
        std::vector<Diagnostic> diagnostics;
        FactoryContext context{diagnostics, {}};
        const auto texture = makeTexture(*bitmap(file), context);
        expectNear(texture->eval({0.3f, 0.3f}), Color(0.5f));
        ASSERT_EQ(diagnostics.size(), 1u) << file;
        EXPECT_EQ(diagnostics[0].where.text(), "scene.xml:7");
        EXPECT_THAT(diagnostics[0].message, HasSubstr(std::filesystem::path(file).filename().string()));
    }
}

TEST_F(TextureTest, FilesAreLoadedOnce) {
    const std::string file = writeBytes("one.png", 1, 1, 3, {9, 9, 9});
    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    const auto a = bitmap(file), b = bitmap(file, {{"uscale", 2.0}}), raw = bitmap(file, {{"raw", true}});
    EXPECT_EQ(makeTexture(*a, context), makeTexture(*a, context));
    makeTexture(*b, context);
    EXPECT_EQ(context.images.size(), 1u);
    makeTexture(*raw, context);
    EXPECT_EQ(context.images.size(), 2u);
}

TEST_F(TextureTest, Checkerboard) {
    const auto board = madeTexture(node("texture", "checkerboard", {{"color0", Color(1.f)}, {"color1", Color(0.f)}}));
    EXPECT_EQ(board->evalScalar({0.25f, 0.25f}), 1.f);
    EXPECT_EQ(board->evalScalar({0.75f, 0.25f}), 0.f);
    EXPECT_EQ(board->evalScalar({0.25f, 0.75f}), 0.f);
    EXPECT_EQ(board->evalScalar({0.75f, 0.75f}), 1.f);
    EXPECT_EQ(board->evalScalar({-0.25f, 0.25f}), 0.f) << "no seam at 0";
    EXPECT_EQ(board->mean(), Color(0.5f));
    const auto fine = madeTexture(node("texture", "checkerboard", {{"uscale", 2.0}, {"vscale", 4.0}}));
    expectNear(fine->eval({0.1f, 0.1f}), Color(0.4f));
    expectNear(fine->eval({0.3f, 0.1f}), Color(0.2f));
    expectNear(fine->eval({0.1f, 0.2f}), Color(0.2f));
    const auto mapped = madeTexture(node("texture", "checkerboard", {{"to_uv", Transform::scale({2, 4, 1})}}));
    expectNear(mapped->eval({0.3f, 0.1f}), Color(0.2f));
}

/// Mitsuba 0.6 does not know to_uv, though scene files for it carry it.
TEST_F(TextureTest, EarlySceneFilesHaveNoUvTransform) {
    const auto early = node("texture", "checkerboard", {{"to_uv", Transform::scale({2, 4, 1})}});
    early->early = true;
    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    expectNear(makeTexture(*early, context)->eval({0.3f, 0.1f}), Color(0.4f));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_THAT(diagnostics[0].message, HasSubstr("to_uv"));
}

TEST_F(TextureTest, UnknownTypesAreGreyAndNamed) {
    std::vector<Diagnostic> diagnostics;
    FactoryContext context{diagnostics, {}};
    expectNear(makeTexture(*node("texture", "wood"), context)->eval({}), Color(0.5f));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_THAT(diagnostics[0].message, HasSubstr("wood"));
}

/// A textured material looks its colour up where the point is.
TEST_F(TextureTest, MaterialsReadTextures) {
    const auto board = node("texture", "checkerboard", {{"color0", Color(1.f)}, {"color1", Color(0.f)}});
    const auto bsdf = testing::made(testing::bsdfNode("diffuse", {}, {{"reflectance", board}}));
    SurfaceInteraction at;
    at.barycentrics = {0.25f, 0.25f};
    const Vec3f up{0, 0, 1};
    EXPECT_GT(bsdf->eval(at, up, up).g, 0.3f);
    EXPECT_TRUE(bsdf->sample(at, up, 0.f, {0.4f, 0.4f}));
    at.barycentrics = {0.75f, 0.25f};
    EXPECT_TRUE(isBlack(bsdf->eval(at, up, up)));
    EXPECT_FALSE(bsdf->sample(at, up, 0.f, {0.4f, 0.4f})) << "a black surface ends the path";
}

}  // namespace
}  // namespace emca::render
