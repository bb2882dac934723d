#include "testing/fake_renderer.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "emca/recorder/recorder.h"

namespace emca::explorer {
namespace {

std::uint32_t samplesOf(const RenderSettings& settings, std::uint32_t standard) {
    return settings.samplesPerPixel ? settings.samplesPerPixel : standard;
}

/// Waits in small steps; true if the client gave up meanwhile.
bool wait(int milliseconds, const RequestMonitor& monitor) {
    for (int i = 0; i < milliseconds && !monitor.cancelled(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return monitor.cancelled();
}

}  // namespace

RendererInfo FakeRenderer::info() const {
    RendererInfo info;
    info.renderer = "fake renderer";
    info.scene = scene;
    info.width = width;
    info.height = height;
    info.samplesPerPixel = samplesPerPixel;
    info.integrator = "fake";
    info.sampler = "none";
    info.concurrent = true;
    return info;
}

Camera FakeRenderer::camera() const {
    Camera camera;
    camera.position = {0, 0, 5};
    return camera;
}

std::vector<Mesh> FakeRenderer::meshes() const {
    if (sceneRequests_++ > 0 && sceneFails) throw std::runtime_error("no memory for the scene");
    Mesh mesh;
    mesh.name = "wall";
    mesh.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return {mesh};
}

Color FakeRenderer::sampleValue(Pixel pixel, std::uint32_t sample) {
    return {0.05f * float(pixel.x) + 0.01f * float(sample), 0.05f * float(pixel.y), sample == 2 ? 4.f : 0.25f};
}

Color FakeRenderer::pixelValue(Pixel pixel, std::uint32_t samples) {
    Color sum;
    for (std::uint32_t s = 0; s < samples; ++s) sum += sampleValue(pixel, s);
    return sum / float(samples);
}

Result<RenderedImage> FakeRenderer::renderImage(const RenderSettings& settings, RequestMonitor& monitor) {
    const std::uint32_t samples = samplesOf(settings, samplesPerPixel);
    RenderedImage image{Image(width, height), Image(width, height, {"samples"}), Image(width, height)};
    for (std::uint32_t y = 0; y < height; ++y) {
        if (wait(rowMilliseconds, monitor)) return Error{ErrorCode::cancelled, "The render was cancelled."};
        std::vector<Color> row;
        for (std::uint32_t x = 0; x < width; ++x) {
            row.push_back(pixelValue({x, y}, samples));
            image.color.setColor({x, y}, row.back());
            *image.samples.at({x, y}) = float(samples);
        }
        monitor.preview({0, y, width, y + 1}, row);
        monitor.progress(double(y + 1) / height);
    }
    return image;
}

Result<Color> FakeRenderer::renderPixel(Pixel pixel, const RenderSettings& settings, Recording&, RequestMonitor& monitor) {
    ++replays;
    if (wait(pixelMilliseconds, monitor)) return Error{ErrorCode::cancelled, "The replay was cancelled."};
    const std::uint32_t samples = samplesOf(settings, samplesPerPixel);
    PathRecorder& emca = recorder();
    for (std::uint32_t s = 0; s < samples; ++s) {
        emca.setPathIndex(s);
        emca.setPathOrigin(Vec3f{0, 0, 5});
        emca.setDepthIndex(1);
        emca.setIntersectionPos(Vec3f{float(pixel.x) * 0.1f - 1, 1 - float(pixel.y) * 0.1f, 0});
        emca.setIntersectionSurface(0, s % 2);
        emca.addIntersectionData("throughput", Color(1.f));
        for (std::uint32_t d = 2; d <= depth; ++d) {
            emca.setDepthIndex(static_cast<std::int32_t>(d));
            emca.setIntersectionPos(Vec3f{0.2f * float(d % 3) - 0.2f, 2.f - 0.1f * float(d), 1 + 0.1f * float(s % 32)});
            emca.addIntersectionData("throughput", s == 2 ? Color(16.f) : Color(1.f));
        }
        emca.setIntersectionEmission(sampleValue(pixel, s));
        emca.setFinalEstimate(sampleValue(pixel, s));
        emca.endPath();
    }
    return pixelValue(pixel, samples);
}

}  // namespace emca::explorer
