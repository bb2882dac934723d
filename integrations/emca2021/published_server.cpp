#include "published_server.h"

#include <optional>
#include <utility>

#include "session.h"

namespace emca::bridge {

namespace {

constexpr std::chrono::milliseconds kCancelPoll{20};
const Error kEnding{ErrorCode::cancelled, "The bridge is ending."};

}  // namespace

PublishedServer::PublishedServer(PublishedServerOptions options) : options_(std::move(options)), session_(std::make_unique<Session>(options_)) {}

Result<std::unique_ptr<PublishedServer>> PublishedServer::open(PublishedServerOptions options) {
    std::unique_ptr<PublishedServer> server(new PublishedServer(std::move(options)));
    if (auto started = server->start(); !started) return started.error();
    return server;
}

Result<void> PublishedServer::start() {
    if (auto connected = session_->connect(); !connected) return connected;
    info_ = session_->info();
    plugins_ = session_->plugins();
    thread_ = std::thread([this] { work(); });
    return {};
}

PublishedServer::~PublishedServer() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_all();
    session_->interrupt();
    thread_.join();
}

void PublishedServer::work() {
    for (;;) {
        std::function<void(Session&)> job;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return ending_ || !jobs_.empty(); });
            if (ending_) break;
            job = std::move(jobs_.front());
            jobs_.pop_front();
        }
        job(*session_);
    }
    session_->leave(options_.quitAtEnd);
}

template <typename T>
Result<T> PublishedServer::call(std::function<Result<T>(Session&)> ask, const Cancelled& cancelled) {
    // Shared: who waits may give up before the answer is there.
    const auto answer = std::make_shared<std::optional<Result<T>>>();
    std::unique_lock lock(mutex_);
    jobs_.push_back([this, answer, ask = std::move(ask)](Session& session) {
        Result<T> came = ask(session);
        const std::lock_guard held(mutex_);
        answer->emplace(std::move(came));
        changed_.notify_all();
    });
    changed_.notify_all();
    while (!answer->has_value()) {
        if (ending_) return kEnding;
        if (cancelled && cancelled()) {
            return Error{ErrorCode::cancelled, "The request was cancelled; a published server cannot be stopped and finishes it first."};
        }
        changed_.wait_for(lock, kCancelPoll);
    }
    return std::move(**answer);
}

Result<PublishedCamera> PublishedServer::camera(const Cancelled& cancelled) {
    return call<PublishedCamera>([](Session& session) { return session.camera(); }, cancelled);
}

Result<PublishedScene> PublishedServer::scene(const Cancelled& cancelled) {
    return call<PublishedScene>([](Session& session) { return session.scene(); }, cancelled);
}

Result<PublishedImage> PublishedServer::image(std::uint32_t samplesPerPixel, const Cancelled& cancelled) {
    return call<PublishedImage>([samplesPerPixel](Session& session) { return session.image(samplesPerPixel); }, cancelled);
}

Result<PublishedPixel> PublishedServer::pixel(Pixel pixel, std::uint32_t samplesPerPixel, const Cancelled& cancelled) {
    return call<PublishedPixel>([pixel, samplesPerPixel](Session& session) { return session.pixel(pixel, samplesPerPixel); }, cancelled);
}

}  // namespace emca::bridge
