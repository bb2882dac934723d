#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "emca/server/renderer.h"
#include "guard.h"

namespace emca::c {

/// A renderer that consists of functions.
class FunctionRenderer final : public Renderer {
  public:
    /// \param functions  complete: checkedRenderer()
    /// \param log        for what a person should hear; may be empty
    FunctionRenderer(const emca_renderer& functions, std::function<void(const std::string&)> log)
        : c_(functions), log_(std::move(log)) {}

    RendererInfo info() const override;
    Camera camera() const override;
    std::vector<Mesh> meshes() const override;
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    std::vector<LayerDescription> surfaceLayers() const override;
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                              RequestMonitor& monitor) override;
    Result<std::vector<Color>> renderPixels(const std::vector<Pixel>& pixels, const RenderSettings& settings,
                                            Recording& recording, RequestMonitor& monitor) override;

  private:
    template <typename Call>
    Result<RenderedImage> image(const char* function, const RenderSettings& settings, const Call& call);
    void reportMisuse();

    const emca_renderer c_;
    const std::function<void(const std::string&)> log_;
    std::atomic<bool> misuseReported_ = false;
    mutable std::atomic<std::uint32_t> width_ = 0, height_ = 0;  ///< what info() said
};

/// Copies the struct. Errors: invalidArgument (a function that is needed is missing), versionMismatch.
Result<emca_renderer> checkedRenderer(const emca_renderer* given);

inline emca_monitor* handle(RequestMonitor& monitor) { return reinterpret_cast<emca_monitor*>(&monitor); }
inline RequestMonitor& of(emca_monitor* monitor) { return *reinterpret_cast<RequestMonitor*>(monitor); }

}  // namespace emca::c
