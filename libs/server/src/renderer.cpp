#include "emca/server/renderer.h"

#include "emca/recorder/recorder.h"

namespace emca {

namespace {

/// Shows the work on one of several pixels as a part of the whole.
class PartialMonitor final : public RequestMonitor {
  public:
    PartialMonitor(RequestMonitor& whole, double begin, double end) : whole_(whole), begin_(begin), end_(end) {}
    bool cancelled() const override { return whole_.cancelled(); }
    void progress(double fraction) override { whole_.progress(begin_ + (end_ - begin_) * fraction); }
    void preview(PixelRect rect, const std::vector<Color>& colors) override { whole_.preview(rect, colors); }
    void beginPixel(Pixel pixel) override { whole_.beginPixel(pixel); }
    void endPixel(Pixel pixel) override { whole_.endPixel(pixel); }

  private:
    RequestMonitor& whole_;
    double begin_, end_;
};

/// Tells the begin and end of a pixel, the end also where the renderer throws. The last path ends before its pixel.
struct PixelNotice {
    PixelNotice(RequestMonitor& m, Pixel p) : monitor(m), pixel(p) { monitor.beginPixel(pixel); }
    ~PixelNotice() {
        recorder().endPath();
        monitor.endPixel(pixel);
    }
    PixelNotice(const PixelNotice&) = delete;
    PixelNotice& operator=(const PixelNotice&) = delete;
    RequestMonitor& monitor;
    Pixel pixel;
};

}  // namespace

Result<RenderedImage> Renderer::renderImageWithLayers(const RenderSettings&, SurfaceRecorder&, RequestMonitor&) {
    return Error{ErrorCode::notSupported, "This renderer announces surface layers, but does not collect them: render without layers."};
}

Result<std::vector<Color>> Renderer::renderPixels(const std::vector<Pixel>& pixels, const RenderSettings& settings,
                                                  Recording& recording, RequestMonitor& monitor) {
    std::vector<Color> values;
    values.reserve(pixels.size());
    const auto count = static_cast<double>(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (monitor.cancelled()) return Error{ErrorCode::cancelled, "The trace was cancelled."};
        PartialMonitor part(monitor, static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
        const RecordScope scope(recording, pixels[i]);
        const PixelNotice notice(monitor, pixels[i]);
        const auto value = renderPixel(pixels[i], settings, recording, part);
        if (!value) return value.error();
        values.push_back(*value);
        part.progress(1);
    }
    return values;
}

}  // namespace emca
