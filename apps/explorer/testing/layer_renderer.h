#pragma once

#include "emca/recorder/surface_recorder.h"
#include "testing/fake_renderer.h"

namespace emca::explorer {

/// A FakeRenderer that collects layers on its wall while it renders: "hits" (density), "height" (mean of y) and "paint"
/// (colour: red left, green right). Four thousand places in a regular grid.
class LayerRenderer : public FakeRenderer {
  public:
    static constexpr int kSide = 64;
    std::atomic<int> collections{0};

    std::vector<LayerDescription> surfaceLayers() const override {
        return {{"hits", LayerKind::density, "1/unit²", "Places on the wall."},
                {"height", LayerKind::mean, "units", "How high they are."},
                {"paint", LayerKind::meanColor, "", "Red left, green right."}};
    }
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface, RequestMonitor& monitor) override {
        ++collections;
        const SurfaceLayer hits = surface.find("hits"), heights = surface.find("height"), paint = surface.find("paint");
        SurfaceCursor& cursor = surface.cursor();
        for (int i = 0; i < kSide; ++i)
            for (int j = 0; j < kSide; ++j) {
                const Vec3f p{-2 + 4 * (float(i) + 0.5f) / kSide, -2 + 4 * (float(j) + 0.25f) / kSide, 0};
                const SurfacePoint at = cursor.locate(0, p.y < p.x ? 0 : 1, p);
                hits.add(at);
                heights.add(at, p.y);
                paint.add(at, p.x < 0 ? Color(0.5f, 0, 0) : Color(0, 0.5f, 0));
            }
        return renderImage(settings, monitor);
    }
};

}  // namespace emca::explorer
