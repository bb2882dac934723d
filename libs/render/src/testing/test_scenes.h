#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "emca/render/image_renderer.h"
#include "emca/render/scene_loader.h"

/// Scenes of the transport tests, written as scene files, so that what is tested is what people use.
namespace emca::render::testing {

inline std::shared_ptr<const Scene> sceneFromText(const std::string& contents) {
    const auto document = readSceneText("<scene version=\"3.0.0\">" + contents + "</scene>", "test.xml");
    EXPECT_TRUE(document.ok()) << (document ? "" : document.error().message);
    if (!document) return nullptr;
    const auto scene = buildScene(*document, "test");
    EXPECT_TRUE(scene.ok()) << (scene ? "" : scene.error().message);
    return scene ? *scene : nullptr;
}

/// A camera of one pixel that looks at a point through a very small angle.
inline std::string spotCamera(const std::string& origin, const std::string& target, const std::string& up = "0,1,0") {
    return R"(<sensor type="perspective"><float name="fov" value="0.001"/><float name="near_clip" value="0.0001"/>
        <transform name="to_world"><lookat origin=")" + origin + R"(" target=")" + target + R"(" up=")" + up + R"("/></transform>
        <film type="hdrfilm"><integer name="width" value="1"/><integer name="height" value="1"/><rfilter type="box"/></film>
        <sampler type="independent"><integer name="sample_count" value="16"/></sampler></sensor>)";
}

inline std::string diffuse(const std::string& reflectance) {
    return R"(<bsdf type="diffuse"><rgb name="reflectance" value=")" + reflectance + R"("/></bsdf>)";
}

/// Mean of all samples of the only pixel, and the standard error of that mean.
struct Estimate {
    Color mean, error;
};
inline Estimate estimatePixel(const Scene& scene, const RenderOptions& options) {
    const ImageRenderer renderer(std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &scene), 1);
    const auto image = renderer.renderImage(options);
    EXPECT_TRUE(image.ok());
    const Color variance = image->variance.color({0, 0});
    const auto n = static_cast<float>(options.samplesPerPixel);
    return {image->color.color({0, 0}),
            {std::sqrt(variance.r / n), std::sqrt(variance.g / n), std::sqrt(variance.b / n)}};
}

inline RenderOptions optionsWith(const Scene& scene, std::uint32_t samples, SamplerKind sampler = SamplerKind::independent) {
    RenderOptions options = sceneOptions(scene);
    options.samplesPerPixel = samples;
    options.sampler = sampler;
    return options;
}

}  // namespace emca::render::testing
