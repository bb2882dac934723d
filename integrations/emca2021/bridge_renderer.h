#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/server/renderer.h"
#include "image_file.h"
#include "published_server.h"

namespace emca::bridge {

/// Which edge of the image a published server's field of view spans. The wire does not say it. Published clients take it as
/// vertical; a published Mitsuba sends the scene file's `fov`, which is that of the image's width.
enum class FieldOfViewAxis { automatic, vertical, horizontal };

struct BridgeOptions {
    std::uint32_t width = 0, height = 0;  ///< of the image; 0: render it with one sample per pixel to see
    FieldOfViewAxis axis = FieldOfViewAxis::automatic;  ///< automatic: horizontal if the renderer's name has "Mitsuba" in it
    std::vector<FolderMapping> folders;
    std::function<void(const std::string&)> log;
};

/// A renderer that is a published server: what such a server says, in the terms of emca::Renderer. Values that have no
/// place there become user data of the same name.
class BridgeRenderer final : public Renderer {
  public:
    /// Asks for camera and scene (in that state of the server, before any render) and, if nobody says it, for the image's
    /// size. The server must outlive the renderer. Errors: those of PublishedServer, and of reading the image.
    static Result<std::unique_ptr<BridgeRenderer>> make(PublishedServer& server, BridgeOptions options);

    RendererInfo info() const override { return info_; }
    Camera camera() const override { return camera_; }
    std::vector<Mesh> meshes() const override { return meshes_; }
    std::vector<LayerDescription> surfaceLayers() const override;
    Result<RenderedImage> renderImage(const RenderSettings& settings, RequestMonitor& monitor) override;
    Result<RenderedImage> renderImageWithLayers(const RenderSettings& settings, SurfaceRecorder& surface, RequestMonitor& monitor) override;
    Result<Color> renderPixel(Pixel pixel, const RenderSettings& settings, Recording& recording, RequestMonitor& monitor) override;

  private:
    BridgeRenderer(PublishedServer& server, BridgeOptions options) : server_(server), options_(std::move(options)) {}
    Result<void> prepare();
    Result<void> findSize();
    Result<std::uint32_t> samples(const RenderSettings& settings) const;
    struct Rendered {
        RenderedImage image;
        std::optional<PublishedScene> heatMap;
    };
    Result<Rendered> render(const RenderSettings& settings, RequestMonitor& monitor);
    void log(const std::string& remark) const { if (options_.log) options_.log(remark); }

    PublishedServer& server_;
    BridgeOptions options_;
    RendererInfo info_;
    Camera camera_;
    std::vector<Mesh> meshes_;
    std::vector<PublishedShape> coloredShapes_;  ///< of the scene at the beginning, if it had face colours
    std::atomic<bool> halfImage_{false};         ///< images of this server are stored in 16 bits
};

/// Radians or degrees of the same view from edge to edge, vertically. \param aspect  width / height \param degrees  horizontally
float verticalFieldOfView(float degrees, double aspect);

/// The view of the published camera; `up` is made orthogonal, and all is made finite.
Camera toCamera(const PublishedCamera& camera, bool horizontal, double aspect);

/// A published shape as a mesh: spheres as triangles. Errors: rendererFailed (a triangle of a vertex that is not there).
Result<Mesh> toMesh(const PublishedShape& shape, std::size_t index);

/// Tells this thread's recorder what came.
void record(const PublishedPixel& pixel);

}  // namespace emca::bridge
