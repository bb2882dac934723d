// What surface layers cost a render: the same image without layers, with one, with all, in turn.
//
//     layers_bench SCENE.xml [samples per pixel] [rounds] [width height]

#include <algorithm>
#include <chrono>
#include <ctime>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "emca/recorder/path_layers.h"
#include "emca/render/image_renderer.h"
#include "emca/render/scene_loader.h"

namespace emca {
namespace {

struct Run {
    double seconds = 0, finishSeconds = 0;
    double processorSeconds = 0;  ///< of all threads: less disturbed by what else runs
    std::uint64_t points = 0, faces = 0, bytes = 0;
    Image color;
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

Run render(const render::ImageRenderer& renderer, const render::RenderOptions& options, const std::vector<Mesh>& meshes,
           const std::vector<LayerDescription>& layers) {
    Run run;
    const double begin = now();
    const std::clock_t clock = std::clock();
    SurfaceRecorder recorder(meshes);
    for (const LayerDescription& layer : layers) recorder.addLayer(layer).value();
    auto image = renderer.renderImage(options, {}, layers.empty() ? nullptr : &recorder);
    run.seconds = now() - begin;
    run.processorSeconds = double(std::clock() - clock) / CLOCKS_PER_SEC;
    run.color = std::move(image->color);
    if (layers.empty()) return run;
    const double end = now();
    const SurfaceField field = recorder.finish();
    run.finishSeconds = now() - end;
    run.points = field.counts.points;
    run.faces = field.faceCount();
    run.bytes = field.counts.bytesUsed;
    return run;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

int run(int argc, char** argv) {
    const auto number = [&](int i, int otherwise) { return argc > i ? std::atoi(argv[i]) : otherwise; };
    if (argc < 2) return std::fputs("usage: layers_bench SCENE.xml [spp] [rounds] [width height]\n", stderr), 2;
    render::SceneOptions sceneOptions;
    sceneOptions.width = static_cast<std::uint32_t>(number(4, 0));
    sceneOptions.height = static_cast<std::uint32_t>(number(5, 0));
    const auto scene = render::loadScene(argv[1], sceneOptions);
    if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 3;
    render::RenderOptions options = render::sceneOptions(**scene);
    options.samplesPerPixel = static_cast<std::uint32_t>(number(2, 64));
    const render::ImageRenderer renderer(*scene);
    const std::vector<Mesh> meshes = (*scene)->meshes();
    const std::vector<LayerDescription>& all = pathLayers();
    const std::vector<std::vector<LayerDescription>> sets{{}, {all.front()}, all};

    std::vector<std::vector<double>> seconds(sets.size()), processor(sets.size()), ratios(sets.size());
    std::vector<Run> last(sets.size());
    render(renderer, options, meshes, {});
    for (int round = 0; round < number(3, 7); ++round) {
        for (std::size_t i = 0; i < sets.size(); ++i) {
            last[i] = render(renderer, options, meshes, sets[i]);
            seconds[i].push_back(last[i].seconds);
            processor[i].push_back(last[i].processorSeconds);
            ratios[i].push_back(last[i].processorSeconds / processor[0].back());
        }
    }
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const Image &a = last[0].color, &b = last[i].color;
        std::printf("%zu layers: %.3f s, of processors %.3f s, ratio %.3f; %.1f M points, %.2f M faces, %.0f MiB, finish %.0f ms, image %s\n",
                    sets[i].size(), median(seconds[i]), median(processor[i]), median(ratios[i]), double(last[i].points) * 1e-6,
                    double(last[i].faces) * 1e-6, double(last[i].bytes) / (1 << 20), last[i].finishSeconds * 1e3,
                    std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0 ? "equal" : "DIFFERENT");
    }
    return 0;
}

}  // namespace
}  // namespace emca

int main(int argc, char** argv) { return emca::run(argc, argv); }
