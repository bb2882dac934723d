#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "emca/server/server.h"
#include "image_store.h"
#include "kept_surfaces.h"
#include "request.h"
#include "scheduler.h"

namespace emca {

struct ScanOptions;
struct ScanResult;
struct SurfaceCollection;

/// Answers requests with the renderer's help; knows nothing of sockets. run() is called by the scheduler's threads.
class Service final : private ToolHost {
  public:
    /// Errors: rendererFailed (its info() threw or makes no sense).
    static Result<std::unique_ptr<Service>> make(Renderer& renderer, const ServerOptions& options);

    /// Answers one request, whatever happens. Exceptions of renderer and tools become error replies.
    void run(const std::shared_ptr<Request>& request) noexcept;
    /// Answers a request that needs no renderer. \return false if this is none
    bool answerAtOnce(const std::shared_ptr<Request>& request) const;
    static Lane laneOf(const protocol::Body& request);

    Result<void> addTool(std::shared_ptr<ServerTool> tool);
    const RendererInfo& info() const { return info_; }

  private:
    Service(Renderer& renderer, const ServerOptions& options, RendererInfo info,
            std::vector<LayerDescription> layers);

    // One per kind of request: the last message, or nothing where a stream was begun.
    using Answer = Result<std::optional<protocol::Body>>;
    static Answer last(protocol::Body body) { return std::optional<protocol::Body>(std::move(body)); }
    Answer dispatch(const std::shared_ptr<Request>& request);
    Answer answer(const std::shared_ptr<Request>&, const protocol::InfoRequest&);
    Answer answer(const std::shared_ptr<Request>&, const protocol::CameraRequest&);
    Answer answer(const std::shared_ptr<Request>&, const protocol::SceneRequest&);
    Answer answer(const std::shared_ptr<Request>&, const protocol::RenderRequest&);
    Answer answer(const std::shared_ptr<Request>&, const protocol::TraceRequest&);
    Answer answer(const std::shared_ptr<Request>&, const protocol::ToolRequest&);
    Result<std::vector<std::byte>> ask(const std::string& tool, std::span<const std::byte> request, RequestMonitor& monitor) override;
    Result<ScanResult> replay(const std::shared_ptr<Request>&, const ScanOptions& options);
    Result<ScanResult> scan(const std::shared_ptr<Request>&, const std::string& query, const ScanOptions& options);

    std::optional<protocol::Body> immediately(const protocol::Body& request) const;
    /// Where the layers that a render is to collect go; null if it asks for none.
    Result<std::unique_ptr<SurfaceCollection>> collectionFor(const protocol::RenderRequest& asked);
    Result<std::shared_ptr<const std::vector<Mesh>>> surfaceMeshes();
    /// What was collected, after post-processing; still without render id and settings.
    Result<std::shared_ptr<KeptSurface>> finished(SurfaceCollection& collection) const;
    Result<ClientPort::Source> surfaceAnswer(const protocol::SurfaceRequest& asked) const;

    Result<std::shared_ptr<const std::vector<Mesh>>> meshes();
    protocol::Info infoReply() const;
    protocol::Settings sceneSettings() const;
    Result<void> checkSamples(std::uint32_t samplesPerPixel) const;
    Result<std::vector<Pixel>> pixelsOf(const protocol::TraceRequest& request) const;
    std::vector<std::shared_ptr<ServerTool>> tools() const;
    std::vector<std::shared_ptr<ServerTool>> observers() const;
    std::shared_ptr<ServerTool> findTool(const std::string& name) const;

    Renderer& renderer_;
    const ServerOptions options_;
    const RendererInfo info_;
    const std::vector<LayerDescription> layers_;
    ImageStore images_;
    KeptSurfaces surfaces_;
    std::mutex surfaceMeshesMutex_;
    std::shared_ptr<const std::vector<Mesh>> surfaceMeshes_;  // from the first render with layers on
    std::atomic<bool> sceneCounted_{false};     // the two below are set
    std::atomic<std::uint64_t> triangles_{0}, meshes_{0};
    mutable std::mutex toolsMutex_;
    std::vector<std::shared_ptr<ServerTool>> tools_, observers_;
};

RenderSettings toRenderer(const protocol::Settings& settings);

}  // namespace emca
