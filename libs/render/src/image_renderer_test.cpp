#include "emca/render/image_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <mutex>
#include <set>
#include <string>

#include "emca/recorder/recording.h"
#include "testing/test_scenes.h"

namespace emca::render {
namespace {

bool sameBits(const Image& a, const Image& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}
bool sameBits(Color a, Color b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Glass and gloss in a lit room, through a thin lens and a gaussian filter: everything that draws random numbers.
std::shared_ptr<const Scene> busyScene() {
    return testing::sceneFromText(
        R"(<integrator type="path"/><sensor type="thinlens"><float name="fov" value="60"/>
        <float name="aperture_radius" value="0.05"/><float name="focus_distance" value="3"/>
        <transform name="to_world"><lookat origin="0,-3,0.5" target="0,0,0" up="0,0,1"/></transform>
        <film type="hdrfilm"><integer name="width" value="37"/><integer name="height" value="21"/><rfilter type="gaussian"/></film>
        <sampler type="independent"><integer name="sample_count" value="8"/></sampler></sensor>
        <shape type="cube"><transform name="to_world"><scale value="4"/></transform><boolean name="flip_normals" value="true"/>)" +
        testing::diffuse("0.7,0.5,0.3") + R"(</shape>
        <shape type="sphere"><point name="center" x="-0.8" y="0" z="0"/><float name="radius" value="0.7"/><bsdf type="dielectric"/></shape>
        <shape type="disk"><transform name="to_world"><translate z="-1"/></transform><bsdf type="roughconductor"/></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><translate x="1"/></transform>
        <bsdf type="mask"><float name="opacity" value="0.4"/>)" + testing::diffuse("0.2,0.6,0.2") + R"(</bsdf></shape>
        <shape type="sphere"><point name="center" x="1" y="-1" z="2"/><float name="radius" value="0.3"/>
        <emitter type="area"><rgb name="radiance" value="9,8,7"/></emitter></shape>
        <emitter type="point"><point name="position" x="0" y="-2" z="3"/><rgb name="intensity" value="2"/></emitter>)");
}

class ImageRendererTest : public ::testing::TestWithParam<SamplerKind> {
  protected:
    std::shared_ptr<const Scene> scene = busyScene();
    RenderOptions options = testing::optionsWith(*scene, 8, GetParam());
};

TEST_P(ImageRendererTest, ThreadsChangeNoBit) {
    const auto one = ImageRenderer(scene, 1).renderImage(options);
    const auto two = ImageRenderer(scene, 2).renderImage(options);
    ASSERT_TRUE(one.ok() && two.ok());
    EXPECT_TRUE(sameBits(one->color, two->color));
    EXPECT_TRUE(sameBits(one->variance, two->variance));
    EXPECT_TRUE(sameBits(one->samples, two->samples));
    double sum = 0;
    for (std::size_t i = 0; i < one->color.size(); ++i) {
        EXPECT_TRUE(std::isfinite(one->color.data()[i]));
        sum += double(one->color.data()[i]);
    }
    EXPECT_GT(sum, 100);
}

TEST_P(ImageRendererTest, ReplayedPixelsAreBitEqualRecordedOrNot) {
    const ImageRenderer renderer(scene, 2);
    const auto image = renderer.renderImage(options);
    ASSERT_TRUE(image.ok());
    for (std::uint32_t y = 0; y < 21; ++y) {
        for (std::uint32_t x = 0; x < 37; ++x) {
            const Pixel pixel{x, y};
            ASSERT_TRUE(sameBits(*renderer.renderPixel(pixel, options), image->color.color(pixel))) << x << ", " << y;
            Recording recording;
            {
                const RecordScope scope(recording, pixel);
                ASSERT_TRUE(sameBits(*renderer.renderPixel(pixel, options), image->color.color(pixel))) << x << ", " << y;
            }
            ASSERT_TRUE(recording.finish().ok());
        }
    }
}

TEST_P(ImageRendererTest, MoreSamplesExtendThePaths) {
    const ImageRenderer renderer(scene, 1);
    const auto record = [&](std::uint32_t samples) {
        RenderOptions more = options;
        more.samplesPerPixel = samples;
        Recording recording;
        {
            const RecordScope scope(recording, {20, 10});
            EXPECT_TRUE(renderer.renderPixel({20, 10}, more).ok());
        }
        return *recording.finish();
    };
    const PathSet few = record(8), many = record(20);
    ASSERT_EQ(few.pathCount(), 8u);
    ASSERT_EQ(many.pathCount(), 20u);
    for (Index path = 0; path < 8; ++path) {
        EXPECT_EQ(few.columns().estimates[path], many.columns().estimates[path]);
        EXPECT_EQ(few.columns().firstVertex[path + 1], many.columns().firstVertex[path + 1]);
    }
}

TEST_P(ImageRendererTest, RecordedValuesAddUp) {
    const ImageRenderer renderer(scene, 1);
    RenderOptions more = options;
    more.samplesPerPixel = 64;
    Recording recording;
    Color pixel;
    {
        const RecordScope scope(recording, {18, 12});
        pixel = *renderer.renderPixel({18, 12}, more);
    }
    const PathSet paths = *recording.finish();
    ASSERT_EQ(paths.pathCount(), 64u);
    Color sum(0.f);
    std::set<std::string> techniques;
    for (Index path = 0; path < paths.pathCount(); ++path) {
        const Color estimate = paths.columns().estimates[path];
        sum += estimate;
        Color contributions(0.f);
        const Index first = paths.columns().firstVertex[path], last = paths.columns().firstVertex[path + 1];
        ASSERT_LT(first, last);
        for (Index vertex = first; vertex < last; ++vertex) {
            const IndexRange range = paths.contributions(vertex);
            for (Index i = range.first; i < range.last; ++i) {
                const Contribution& contribution = paths.contribution(i);
                contributions += contribution.value;
                techniques.emplace(paths.text(contribution.technique));
                EXPECT_GE(contribution.misWeight, 0.f);
                EXPECT_LE(contribution.misWeight, 1.f);
            }
        }
        EXPECT_NEAR(contributions.g, estimate.g, 1e-5f * (1 + estimate.g)) << "path " << path;
        EXPECT_EQ(paths.columns().vertexEstimates[last - 1], estimate) << "the running sum ends with the estimate";
    }
    EXPECT_NEAR(sum.g / 64, pixel.g, 1e-5f * (1 + pixel.g));
    EXPECT_TRUE(techniques.contains("light sampling"));
    for (const char* key : {"throughput", "BSDF pdf", "BSDF weight", "light pdf", "MIS weight (light)", "material", "shape",
                            "light", "random numbers (direction)", "random numbers (light)"}) {
        EXPECT_FALSE(paths.find(Scope::vertex, key).empty()) << key;
    }
    EXPECT_FALSE(paths.find(Scope::path, "end").empty());
}

INSTANTIATE_TEST_SUITE_P(Samplers, ImageRendererTest, ::testing::Values(SamplerKind::independent, SamplerKind::sobol),
                         [](const auto& kind) { return name(kind.param); });

TEST(ImageRenderer, SeedsDifferAndAgree) {
    const auto scene = busyScene();
    RenderOptions a = testing::optionsWith(*scene, 2), b = a;
    b.seed = 1;
    const ImageRenderer renderer(scene, 2);
    EXPECT_TRUE(sameBits(renderer.renderImage(a)->color, renderer.renderImage(a)->color));
    EXPECT_FALSE(sameBits(renderer.renderImage(a)->color, renderer.renderImage(b)->color));
}

TEST(ImageRenderer, VarianceIsThatOfTheSamples) {
    const auto scene = busyScene();
    const RenderOptions options = testing::optionsWith(*scene, 50);
    const ImageRenderer renderer(scene, 1);
    Recording recording;
    {
        const RecordScope scope(recording, {9, 9});
        ASSERT_TRUE(renderer.renderPixel({9, 9}, options).ok());
    }
    const PathSet paths = *recording.finish();
    double mean = 0, squares = 0;
    for (const Color& c : paths.columns().estimates) mean += double(c.g) / 50;
    for (const Color& c : paths.columns().estimates) squares += (double(c.g) - mean) * (double(c.g) - mean);
    const auto image = renderer.renderImage(options);
    EXPECT_NEAR(image->variance.color({9, 9}).g, squares / 49, 1e-5 * squares);
    EXPECT_EQ(*image->samples.at({9, 9}), 50.f);
}

TEST(ImageRenderer, TilesCoverTheImageOnceAndProgressEndsAtOne) {
    const auto scene = busyScene();
    Image covered(scene->width(), scene->height(), {"count"});
    std::mutex mutex;
    double last = 0;
    RenderCallbacks callbacks;
    callbacks.progress = [&](double fraction) {
        const std::lock_guard lock(mutex);
        last = std::max(last, fraction);
    };
    callbacks.tileDone = [&](PixelRect tile, const std::vector<Color>& colors) {
        const std::lock_guard lock(mutex);
        ASSERT_EQ(colors.size(), tile.count());
        for (std::uint32_t y = tile.y0; y < tile.y1; ++y)
            for (std::uint32_t x = tile.x0; x < tile.x1; ++x) *covered.at({x, y}) += 1;
    };
    ASSERT_TRUE(ImageRenderer(scene, 2).renderImage(testing::optionsWith(*scene, 1), callbacks).ok());
    EXPECT_EQ(last, 1.0);
    for (std::size_t i = 0; i < covered.size(); ++i) EXPECT_EQ(covered.data()[i], 1.f);
}

TEST(ImageRenderer, RefusesWhatItCannotDo) {
    const auto scene = busyScene();
    const ImageRenderer renderer(scene, 1);
    const auto code = [](const auto& result) { return result.ok() ? ErrorCode{} : result.error().code; };
    EXPECT_EQ(code(renderer.renderImage(testing::optionsWith(*scene, 0))), ErrorCode::invalidArgument);
    EXPECT_EQ(code(renderer.renderImage(testing::optionsWith(*scene, 1000000000))), ErrorCode::tooLarge);
    EXPECT_EQ(code(renderer.renderPixel({37, 0}, testing::optionsWith(*scene, 1))), ErrorCode::pixelOutOfRange);
    EXPECT_EQ(code(renderer.renderPixel({0, 21}, testing::optionsWith(*scene, 1))), ErrorCode::pixelOutOfRange);
    RenderCallbacks cancel;
    cancel.cancelled = [] { return true; };
    EXPECT_EQ(code(renderer.renderImage(testing::optionsWith(*scene, 1), cancel)), ErrorCode::cancelled);
    EXPECT_EQ(code(renderer.renderPixel({0, 0}, testing::optionsWith(*scene, 100000), cancel)), ErrorCode::cancelled);
    EXPECT_TRUE(renderer.renderPixel({36, 20}, testing::optionsWith(*scene, 1)).ok());
}

}  // namespace
}  // namespace emca::render
