// Any bytes as a reply of a published EMCA server: refused, or the same bytes when written again; and what was accepted can
// be drawn, recorded and put on the scene. The first byte says which reply, the second how the bytes come.
#include <cstdlib>
#include <cstring>

#include "bridge_renderer.h"
#include "emca/recorder/recording.h"
#include "heat_map.h"
#include "published_for_tests.h"

namespace emca::bridge {
namespace {

void sameAgain(const test::Writer& out, std::span<const std::byte> bytes) {
    if (out.bytes().size() > bytes.size() || std::memcmp(out.bytes().data(), bytes.data(), out.bytes().size()) != 0) std::abort();
}

void useScene(const PublishedScene& scene) {
    std::vector<Mesh> meshes;
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
        auto mesh = toMesh(scene.shapes[i], i);
        if (!mesh) return;
        meshes.push_back(std::move(mesh).value());
    }
    const std::vector<LayerDescription> layers{heatMapColors(), heatMapNumbers()};
    if (!validate(heatMapOn(meshes, scene.shapes, layers).field, meshes)) std::abort();
    // And on another scene than its own.
    if (!meshes.empty() && meshes[0].triangles.size() > 1) meshes[0].triangles.pop_back();
    if (!validate(heatMapOn(meshes, scene.shapes, layers).field, meshes)) std::abort();
}

void usePixel(const PublishedPixel& pixel) {
    Recording recording;
    {
        const RecordScope scope(recording, Pixel{0, 0});
        record(pixel);
    }
    const auto paths = recording.finish();
    if (!paths || paths->pathCount() != pixel.paths.size()) std::abort();
}

void look(std::uint8_t kind, std::uint8_t how, std::span<const std::byte> bytes) {
    test::Bytes source(bytes, how & 64 ? ErrorCode::timedOut : ErrorCode::connectionLost, how % 16 + 1u);
    WireReader in(source, {.paths = 1u << 16, .replyBytes = 1u << 24});
    const bool swapped = (how & 128) != 0;
    in.setSwapped(swapped);
    test::Writer again(swapped);
    switch (kind % 4) {
    case 0:
        if (const auto info = readInfo(in); in.ok()) test::write(again, info);
        break;
    case 1:
        if (const auto camera = readCamera(in); in.ok()) {
            test::write(again, camera);
            const Camera ours = toCamera(camera, (how & 32) != 0, 1.5);
            if (!isFinite(ours.position) || !isFinite(ours.direction) || !isFinite(ours.up) || !(ours.verticalFieldOfView >= 0)) std::abort();
        }
        break;
    case 2:
        if (const auto scene = readScene(in); in.ok()) {
            test::write(again, scene);
            useScene(scene);
        }
        break;
    default:
        if (const auto pixel = readPixel(in, {}); in.ok()) {
            if (pixel.endedBySilence != (pixel.paths.size() < pixel.announced)) std::abort();
            test::write(again, pixel.announced, pixel.paths);
            usePixel(pixel);
        }
    }
    if (in.ok()) sameAgain(again, bytes);
}

}  // namespace
}  // namespace emca::bridge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size >= 2) emca::bridge::look(data[0], data[1], std::as_bytes(std::span(data + 2, size - 2)));
    return 0;
}
