#include "emca/client/connection.h"

#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "assemble.h"
#include "assemble_surface.h"
#include "convert.h"
#include "link.h"

namespace emca::client {

class Connection::Impl {
  public:
    explicit Impl(std::shared_ptr<Link> l) : link(std::move(l)) {}
    const std::shared_ptr<Link> link;
    /// Of the meshes as they came last: what surface layers must fit.
    std::optional<std::vector<std::uint32_t>> triangleCounts() {
        const std::lock_guard lock(mutex);
        return counts;
    }
    void remember(const std::vector<Mesh>& meshes) {
        const std::lock_guard lock(mutex);
        counts.emplace();
        for (const Mesh& mesh : meshes) counts->push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
    }

  private:
    std::mutex mutex;
    std::optional<std::vector<std::uint32_t>> counts;
};

namespace {

using Outcome = std::optional<Result<void>>;

Outcome unexpected() {
    return Result<void>(Error{ErrorCode::protocolViolation, "The renderer answered a request with a message of another kind."});
}

void tellProgress(const RequestObserver& observer, const protocol::Body& body) {
    const auto* progress = std::get_if<protocol::Progress>(&body);
    if (progress && observer.progress && progress->fraction >= 0 && progress->fraction <= 1) {
        observer.progress(static_cast<double>(progress->fraction));
    }
}

/// Sends a request that one message of type `Reply` answers.
template <typename Reply>
Result<Reply> ask(Link& link, protocol::Body body, const RequestObserver& observer = {}) {
    Reply reply;
    const auto done = link.request(
        std::move(body),
        [&](protocol::Body& message) -> Outcome {
            if (auto* found = std::get_if<Reply>(&message)) {
                reply = std::move(*found);
                return Result<void>();
            }
            if (!std::holds_alternative<protocol::Progress>(message)) return unexpected();
            tellProgress(observer, message);
            return std::nullopt;
        },
        observer.cancel.get());
    if (!done) return done.error();
    return reply;
}

template <typename Options>
protocol::Settings settingsOf(const Options& options) {
    return {options.samplesPerPixel, options.integrator, options.sampler, options.seed, options.hasSeed};
}

Result<Trace> trace(Link& link, protocol::TraceRequest request, const TraceOptions& options, const RequestObserver& observer) {
    request.settings = settingsOf(options);
    request.against = static_cast<protocol::Against>(options.against);
    request.renderId = options.renderId;
    request.colors = SharedArray<Color>(options.colors);
    request.columns = options.columns;
    request.query = options.query;
    request.budget = options.budget;
    request.locations = options.locations;
    request.keep = options.keep;
    request.keepCount = options.keepCount;
    const std::vector<Pixel> asked = request.pixels;
    const std::uint64_t count = asked.empty() ? request.rect.count() : asked.size();
    const auto begin = std::chrono::steady_clock::now();
    auto result = ask<protocol::TraceResult>(link, std::move(request), observer);
    if (!result) return result.error();
    if (result->pixels.size() != count || (!asked.empty() && result->pixels != asked)) {
        return Error{ErrorCode::protocolViolation, "The renderer answered with other pixels than those that were asked for."};
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    Trace trace = traceOf(std::move(result).value());
    trace.totalSeconds = seconds.count();
    return trace;
}

}  // namespace

Connection::Connection(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Connection::~Connection() { close(); }

Result<std::unique_ptr<Connection>> Connection::open(const Address& address, Options options) {
    auto link = std::make_shared<Link>(address, std::move(options));
    if (auto opened = link->open(); !opened) return opened.error();
    return std::unique_ptr<Connection>(new Connection(std::make_unique<Impl>(std::move(link))));
}

const Address& Connection::address() const { return impl_->link->address(); }
const Greeting& Connection::greeting() const { return impl_->link->greeting(); }
bool Connection::isOpen() const { return impl_->link->isOpen(); }
void Connection::close() { impl_->link->close(); }

// Each call holds what it needs, so that the connection may be destroyed while it waits.

Result<ServerInfo> Connection::info() {
    const auto link = impl_->link;
    auto reply = ask<protocol::Info>(*link, protocol::InfoRequest{});
    if (!reply) return reply.error();
    return infoOf(std::move(reply).value());
}

Result<Camera> Connection::camera() {
    const auto link = impl_->link;
    return ask<Camera>(*link, protocol::CameraRequest{});
}

Result<std::vector<Mesh>> Connection::meshes(const RequestObserver& observer) {
    const auto impl = impl_;
    SceneAssembler scene;
    const auto done = impl->link->request(
        protocol::SceneRequest{},
        [&](protocol::Body& message) -> Outcome {
            if (std::holds_alternative<protocol::Progress>(message)) return std::nullopt;
            const auto* chunk = std::get_if<protocol::SceneChunk>(&message);
            if (!chunk) return unexpected();
            if (auto added = scene.add(*chunk); !added) return added;
            if (observer.progress) observer.progress(scene.fraction());
            if (scene.complete()) return Result<void>();
            return std::nullopt;
        },
        observer.cancel.get());
    if (!done) return done.error();
    auto meshes = scene.take();
    impl->remember(meshes);
    return meshes;
}

Result<Render> Connection::render(const RenderOptions& options, const RequestObserver& observer) {
    const auto link = impl_->link;
    ImageAssembler image;
    const auto done = link->request(
        protocol::RenderRequest{settingsOf(options), options.preview && observer.preview, 0, options.layers, options.surfaceBudget},
        [&](protocol::Body& message) -> Outcome {
            if (const auto* tile = std::get_if<protocol::PreviewTile>(&message)) {
                if (observer.preview) observer.preview(tile->rect, tile->colors.span());
                return std::nullopt;
            }
            Result<void> added;
            if (const auto* begin = std::get_if<protocol::RenderResult>(&message)) {
                added = image.begin(*begin);
            } else if (const auto* rows = std::get_if<protocol::ImageRows>(&message)) {
                added = image.add(*rows);
            } else if (std::holds_alternative<protocol::Progress>(message)) {
                tellProgress(observer, message);
            } else {
                return unexpected();
            }
            if (!added) return added;
            if (image.complete()) return Result<void>();
            return std::nullopt;
        },
        observer.cancel.get());
    if (!done) return done.error();
    return image.take();
}

Result<SurfaceField> Connection::surface(std::uint64_t renderId, std::vector<std::string> layers, const RequestObserver& observer) {
    const auto impl = impl_;
    SurfaceAssembler surface;
    protocol::SurfaceRequest request;
    request.layers = std::move(layers);
    request.renderId = renderId;
    const auto done = impl->link->request(
        std::move(request),
        [&](protocol::Body& message) -> Outcome {
            if (std::holds_alternative<protocol::Progress>(message)) return std::nullopt;
            Result<void> added;
            if (const auto* begin = std::get_if<protocol::SurfaceResult>(&message)) {
                added = surface.begin(*begin);
            } else if (const auto* chunk = std::get_if<protocol::SurfaceChunk>(&message)) {
                added = surface.add(*chunk);
            } else {
                return unexpected();
            }
            if (!added) return added;
            if (observer.progress) observer.progress(surface.fraction());
            if (surface.complete()) return Result<void>();
            return std::nullopt;
        },
        observer.cancel.get());
    if (!done) return done.error();
    return surface.take(impl->triangleCounts());
}

Result<Trace> Connection::tracePixel(Pixel pixel, const TraceOptions& options, const RequestObserver& observer) {
    return tracePixels({pixel}, options, observer);
}

Result<Trace> Connection::tracePixels(std::vector<Pixel> pixels, const TraceOptions& options, const RequestObserver& observer) {
    const auto link = impl_->link;
    protocol::TraceRequest request;
    request.pixels = std::move(pixels);
    return trace(*link, std::move(request), options, observer);
}

Result<Trace> Connection::traceRect(PixelRect rect, const TraceOptions& options, const RequestObserver& observer) {
    const auto link = impl_->link;
    protocol::TraceRequest request;
    request.rect = rect;
    return trace(*link, std::move(request), options, observer);
}

Result<std::vector<std::byte>> Connection::askTool(const std::string& tool, std::span<const std::byte> request,
                                                   const RequestObserver& observer) {
    const auto link = impl_->link;
    auto reply = ask<protocol::ToolResult>(
        *link, protocol::ToolRequest{tool, SharedArray<std::byte>(std::vector<std::byte>(request.begin(), request.end()))}, observer);
    if (!reply) return reply.error();
    return std::vector<std::byte>(reply->data.begin(), reply->data.end());
}

Result<void> Connection::quitServer() {
    const auto link = impl_->link;
    const auto reply = ask<protocol::Done>(*link, protocol::QuitRequest{});
    if (!reply) return reply.error();
    return {};
}

}  // namespace emca::client
