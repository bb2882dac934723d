#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "emca/server/server.h"
#include "image_store.h"
#include "request.h"
#include "scheduler.h"

namespace emca {

/// Answers requests with the renderer's help; knows nothing of sockets. run() is called by the scheduler's threads.
class Service {
  public:
    /// Errors: rendererFailed (its info() threw or makes no sense).
    static Result<std::unique_ptr<Service>> make(Renderer& renderer, const ServerOptions& options);

    /// Answers one request, whatever happens. Exceptions of renderer and tools become error replies.
    void run(const std::shared_ptr<Request>& request) noexcept;
    /// The answer to a request that needs no renderer, if this is one.
    std::optional<protocol::Body> immediately(const protocol::Body& request) const;
    static Lane laneOf(const protocol::Body& request);

    Result<void> addTool(std::shared_ptr<ServerTool> tool);
    const RendererInfo& info() const { return info_; }

  private:
    Service(Renderer& renderer, const ServerOptions& options, RendererInfo info);

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

    Result<std::shared_ptr<const std::vector<Mesh>>> meshes();
    protocol::Info infoReply() const;
    protocol::Settings sceneSettings() const;
    Result<void> checkSamples(std::uint32_t samplesPerPixel) const;
    Result<std::vector<Pixel>> pixelsOf(const protocol::TraceRequest& request) const;
    std::vector<std::shared_ptr<ServerTool>> tools() const;

    Renderer& renderer_;
    const ServerOptions options_;
    const RendererInfo info_;
    ImageStore images_;
    std::atomic<bool> sceneCounted_{false};     // the two below are set
    std::atomic<std::uint64_t> triangles_{0}, meshes_{0};
    mutable std::mutex toolsMutex_;
    std::vector<std::shared_ptr<ServerTool>> tools_;
};

RenderSettings toRenderer(const protocol::Settings& settings);

}  // namespace emca
