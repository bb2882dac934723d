#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emca/core/camera.h"
#include "emca/core/image.h"
#include "emca/core/mesh.h"
#include "emca/core/pixel.h"
#include "emca/core/result.h"
#include "emca/core/surface_field.h"

namespace emca {

class Recording;
class SurfaceRecorder;

/// What a renderer says about itself.
struct RendererInfo {
    std::string renderer;                 ///< program and version, e.g. "emca-render 0.1"
    std::string scene;                    ///< name of the scene, for people
    std::uint32_t width = 0, height = 0;  ///< of the image, in pixels
    std::uint32_t samplesPerPixel = 1;    ///< the scene's own choice
    std::string integrator, sampler;      ///< names; may be empty
    std::uint64_t seed = 0;               ///< of the scene; requests that name none are given this one, with hasSeed
    /// renderPixel may run while renderImage does, and several renderPixel at once. If false the server runs one after
    /// the other.
    bool concurrent = false;
    /// The same settings give the same bits, so that a replay can be exact.
    bool deterministic = true;
    /// Threads that renderPixels may be called from at once for one trace of several pixels; 0: as many as the machine has.
    /// Only if `concurrent`.
    unsigned threads = 0;
    /// Paths may add to any pixel (light tracing, Metropolis): renderPixels does its work once for all pixels.
    bool pathsReachAnyPixel = false;
    std::vector<std::string> capabilities;  ///< further words, e.g. "denoiser"; the server adds its own
};

/// What to render with. Zero or empty: as the scene says.
struct RenderSettings {
    std::uint32_t samplesPerPixel = 0;
    std::string integrator, sampler;
    std::uint64_t seed = 0;
    bool hasSeed = false;
    friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

/// How a running request talks to its client. All functions may be called from any thread.
class RequestMonitor {
  public:
    virtual ~RequestMonitor() = default;
    /// True as soon as the client cancelled or is gone: return early with ErrorCode::cancelled.
    virtual bool cancelled() const = 0;
    /// \param fraction  done, in [0, 1]; may be called as often as one likes, few are sent.
    virtual void progress(double fraction) = 0;
    /// Pixels that are finished, for the preview: `colors` row by row. Optional.
    virtual void preview(PixelRect rect, const std::vector<Color>& colors) = 0;
    /// Around the replay of each pixel, in the thread that replays, inside its RecordScope: server tools are told. The
    /// default renderPixels calls them; a renderer with a renderPixels of its own may.
    virtual void beginPixel(Pixel) {}
    virtual void endPixel(Pixel) {}
};

/// The one class that an adapter implements (paper, section 4). The server calls it from threads of its own, only
/// one call at a time unless info().concurrent. An exception that escapes is caught and becomes an error reply.
class Renderer {
  public:
    virtual ~Renderer() = default;

    /// Called once, when the server starts: what it says must stay true.
    virtual RendererInfo info() const = 0;
    virtual Camera camera() const = 0;
    /// World space. Its order gives the mesh indices of setIntersectionSurface. Called once per client that asks, and once
    /// for surface layers.
    virtual std::vector<Mesh> meshes() const = 0;

    /// Renders the whole image. Nothing is recorded meanwhile.
    /// Errors: invalidArgument (settings it cannot do), cancelled, rendererFailed.
    virtual Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) = 0;

    /// The 3D data that it can collect on surfaces while it renders an image, if asked for. Called once, when the server
    /// starts: names and kinds must stay true.
    virtual std::vector<LayerDescription> surfaceLayers() const { return {}; }

    /// renderImage while layers are collected: the same bits. Called instead of it if a client asks for at least one layer
    /// of surfaceLayers(); those that it asks for are in `surface`, where surface.find(name) gives the handle, an inert
    /// one for the others. The renderer may add layers of its own before its threads call surface.cursor(). Mesh indices
    /// are those of meshes(). All threads that add must be done when it returns. Errors besides: notSupported (the
    /// default).
    virtual Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface,
                                                        RequestMonitor& monitor);

    /// Renders one pixel again with the same settings, bit by bit as renderImage does, and returns the pixel as its
    /// film code computes it. The calling thread is already inside a RecordScope of `recording`; threads that the
    /// renderer uses besides open their own RecordScope. `pixel` is inside the image.
    virtual Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording,
                                      RequestMonitor& monitor) = 0;

    /// Renders the requested pixels, each of them once in the list, for methods whose paths may hit any pixel (light
    /// tracing, Metropolis): one pass that records splats. Every trace comes in here. The calling thread is inside a
    /// RecordScope without a pixel. The default calls renderPixel for each pixel inside a RecordScope of that pixel.
    /// \return one value per pixel, in order.
    virtual Result<std::vector<Color>> renderPixels(const std::vector<Pixel>& pixels, const RenderSettings& settings,
                                                    Recording& recording, RequestMonitor& monitor);
};

}  // namespace emca
