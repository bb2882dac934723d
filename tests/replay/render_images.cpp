// Writes the bits of small renders of every scene to a file. Built twice: with recording, and with EMCA_DISABLED.
#include <cstdio>
#include <fstream>

#include "emca/render/image_renderer.h"
#include "support/test_scenes.h"

int main(int argc, char** argv) {
    using namespace emca;
    if (argc != 2) return 2;
#ifdef EMCA_DISABLED
    static_assert(!std::is_same_v<PathRecorder, BasicPathRecorder<true>>);
#else
    static_assert(std::is_same_v<PathRecorder, BasicPathRecorder<true>>);
#endif
    std::ofstream out(argv[1], std::ios::binary);
    auto scenes = test::ownScenes();
    for (const test::TestScene& scene : test::publicScenes()) scenes.push_back(scene);
    for (const test::TestScene& scene : scenes) {
        auto loaded = render::loadScene(scene.file, {.defines = {}, .width = 48, .height = 36});
        if (!loaded) return std::fprintf(stderr, "%s\n", loaded.error().message.c_str()), 3;
        for (const auto sampler : {render::SamplerKind::independent, render::SamplerKind::sobol}) {
            render::RenderOptions options = render::sceneOptions(**loaded);
            options.samplesPerPixel = 8;
            options.sampler = sampler;
            const auto image = render::ImageRenderer(*loaded, 2).renderImage(options);
            if (!image) return 5;
            for (const Image* part : {&image->color, &image->variance})
                out.write(reinterpret_cast<const char*>(part->data()), std::streamsize(part->size() * sizeof(float)));
        }
    }
    return out ? 0 : 5;
}
