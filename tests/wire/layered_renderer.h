#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "emca/recorder/surface_recorder.h"
#include "fake_renderer.h"

namespace emca::test {

/// Each pixel adds to two triangles of a square, from two threads; all sums are known.
class LayeredRenderer : public FakeRenderer {
  public:
    std::vector<LayerDescription> offered{{"hits", LayerKind::density, "1/m^2", "Adds 1 for each pixel."},
                                          {"colors", LayerKind::meanColor, "W/(sr m^2)", "Adds the pixel's colour."},
                                          {"column", LayerKind::mean, "", "Adds the pixel's column."},
                                          {"row sum", LayerKind::sum, "", "Adds the pixel's row."}};
    bool addsItsOwn = false;
    int pointsPerPixel = 20;
    mutable std::atomic<int> meshCalls{0};
    std::atomic<int> layeredRenders{0}, plainRenders{0};

    LayeredRenderer() {
        Mesh square;
        square.name = "square";
        square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
        square.triangles = {{0, 1, 2}, {0, 2, 3}};
        scene.push_back(square);
    }

    std::vector<Mesh> meshes() const override {
        ++meshCalls;
        return scene;
    }
    std::vector<LayerDescription> surfaceLayers() const override { return offered; }
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override {
        ++plainRenders;
        return FakeRenderer::renderImage(settings, monitor);
    }
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                RequestMonitor& monitor) override {
        ++layeredRenders;
        if (addsItsOwn) {
            const auto own = surface.addLayer({"own", LayerKind::sum, "", "Adds 2 for each pixel."});
            if (!own) return own.error();
        }
        std::thread other([&] { collect(surface, 0, 6); });
        collect(surface, 6, 12);
        other.join();
        return FakeRenderer::renderImage(settings, monitor);
    }

  private:
    void collect(SurfaceRecorder& surface, std::uint32_t firstRow, std::uint32_t lastRow) const {
        const SurfaceLayer hits = surface.find("hits"), colors = surface.find("colors"), column = surface.find("column"),
                           rows = surface.find("row sum"), own = surface.find("own");
        SurfaceCursor& cursor = surface.cursor();
        for (std::uint32_t y = firstRow; y < lastRow; ++y) {
            for (std::uint32_t x = 0; x < 16; ++x) {
                for (int i = 0; i < pointsPerPixel; ++i) {
                    const float px = (static_cast<float>(x) + 0.25f) / 16, py = (static_cast<float>(y) + 0.5f) / 12;
                    const SurfacePoint at = cursor.locate(1, px > py ? 0 : 1, Vec3f{px, py, 0});
                    hits.add(at);
                    colors.add(at, Color(0.25f, 0.5f, 1));
                    column.add(at, 2.f);
                    rows.add(at, static_cast<float>(y));
                    own.add(at, 2.f);
                }
            }
        }
    }
};

}  // namespace emca::test
