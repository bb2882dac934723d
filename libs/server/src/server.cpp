#include "emca/server/server.h"

#include <asio.hpp>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "scheduler.h"
#include "service.h"
#include "session.h"

namespace emca {

namespace {

using Tcp = asio::ip::tcp;

/// Strangers that have not greeted yet, and those that are being sent away.
constexpr std::size_t kMaximumStrangers = 64;

std::string text(const Tcp::endpoint& endpoint) {
    const std::string host = endpoint.address().to_string();
    return (endpoint.address().is_v6() ? "[" + host + "]" : host) + ":" + std::to_string(endpoint.port());
}

Result<Tcp::endpoint> resolve(asio::io_context& context, const std::string& host, std::uint16_t port) {
    std::error_code error;
    const auto address = asio::ip::make_address(host, error);
    if (!error) return Tcp::endpoint(address, port);
    Tcp::resolver resolver(context);
    const auto found = resolver.resolve(host, std::to_string(port), Tcp::resolver::passive, error);
    if (error || found.empty()) {
        return Error{ErrorCode::invalidArgument, "The server was to listen on \"" + host + "\", but this machine has no such address."};
    }
    return found.begin()->endpoint();
}

Error cannotListen(const Tcp::endpoint& endpoint, const std::error_code& error) {
    if (error == asio::error::address_in_use) {
        return {ErrorCode::addressInUse, "The server was to listen on " + text(endpoint) +
                                             ", but another program does: choose another port, or 0 for any."};
    }
    return {ErrorCode::invalidArgument, "The server cannot listen on " + text(endpoint) + ": " + error.message() + "."};
}

}  // namespace

class Server::Impl final : public SessionHost {
  public:
    Impl(ServerOptions options, std::unique_ptr<Service> service)
        : options_(std::move(options)), service_(std::move(service)), acceptor_(context_), retry_(context_) {}
    ~Impl() override { stop(); }

    Result<void> listen();
    void stop();
    void wait();
    std::uint16_t port() const { return endpoint_.port(); }
    std::string address() const { return text(endpoint_); }
    Service& service() { return *service_; }

    const ServerOptions& options() const override { return options_; }
    bool admit(Session&) override;
    void submit(std::shared_ptr<Request> request) override;
    bool withdraw(const std::shared_ptr<Request>& request) override { return scheduler_->withdraw(request); }
    void readsAgain() override { scheduler_->wake(); }
    void closed(Session& session) override;
    void quitRequested() override;
    void log(const std::string& text) override;

  private:
    void accept();
    void runNetwork();

    const ServerOptions options_;
    std::unique_ptr<Service> service_;
    asio::io_context context_{1};
    Tcp::acceptor acceptor_;
    asio::steady_timer retry_;
    Tcp::endpoint endpoint_;
    std::map<std::uint64_t, std::shared_ptr<Session>> sessions_;  // network thread
    std::uint64_t nextSession_ = 1;
    std::unique_ptr<Scheduler> scheduler_;
    std::thread network_;

    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false, stopping_ = false, stopped_ = false;
};

Result<void> Server::Impl::listen() {
    auto endpoint = resolve(context_, options_.host, options_.port);
    if (!endpoint) return endpoint.error();
    std::error_code error;
    acceptor_.open(endpoint->protocol(), error);
    if (!error) acceptor_.set_option(Tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(*endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (!error) endpoint_ = acceptor_.local_endpoint(error);
    if (error) return cannotListen(*endpoint, error);
    if (!endpoint_.address().is_loopback()) {
        log("Listening on " + text(endpoint_) + ": every machine that reaches this address can connect" +
            (options_.token.empty() ? ", without a token." : " if it has the token."));
    }
    scheduler_ = std::make_unique<Scheduler>(service_->info().concurrent,
                                             [this](const std::shared_ptr<Request>& request) { service_->run(request); });
    accept();
    network_ = std::thread([this] { runNetwork(); });
    return {};
}

void Server::Impl::runNetwork() {
    for (;;) {
        try {
            context_.run();
            return;
        } catch (const std::exception& exception) {  // no memory for one client must not end the others
            log(std::string("A fault in the network thread was survived: ") + exception.what());
        }
    }
}

void Server::Impl::accept() {
    acceptor_.async_accept([this](std::error_code error, Tcp::socket socket) {
        if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
        if (error) {  // too many open files, for instance: try again when some may be closed
            retry_.expires_after(std::chrono::milliseconds(100));
            retry_.async_wait([this](std::error_code cancelled) { if (!cancelled) accept(); });
            return;
        }
        if (sessions_.size() < options_.maximumClients + kMaximumStrangers) {
            const std::uint64_t id = nextSession_++;
            auto session = std::make_shared<Session>(std::move(socket), *this, id);
            sessions_.emplace(id, session);
            session->start();
        }
        accept();
    });
}

bool Server::Impl::admit(Session&) {
    std::size_t clients = 0;
    for (const auto& [id, session] : sessions_) clients += session->admitted() ? 1 : 0;
    return clients < options_.maximumClients;
}

void Server::Impl::submit(std::shared_ptr<Request> request) {
    if (service_->answerAtOnce(request)) return;
    const Lane lane = Service::laneOf(request->body);
    scheduler_->add(lane, std::move(request));
}

void Server::Impl::closed(Session& session) {
    scheduler_->removeClient(session.id());
    sessions_.erase(session.id());
}

void Server::Impl::quitRequested() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
}

void Server::Impl::log(const std::string& text) {
    if (!options_.log) return;
    try {
        options_.log(text);
    } catch (...) {  // a remark that nobody can write down is no reason to end
    }
}

void Server::Impl::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_; });
}

void Server::Impl::stop() {
    {
        std::unique_lock lock(mutex_);
        ended_ = true;
        changed_.notify_all();
        if (stopping_) {
            changed_.wait(lock, [this] { return stopped_; });
            return;
        }
        stopping_ = true;
    }
    if (scheduler_) scheduler_->stop();  // before the sessions end: workers answer to them
    if (network_.joinable()) {
        asio::post(context_, [this] {
            std::error_code ignored;
            acceptor_.close(ignored);
            retry_.cancel();
            const auto sessions = sessions_;  // closing takes them off the list
            for (const auto& [id, session] : sessions) session->close();
            context_.stop();
        });
        network_.join();
    }
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() = default;

Result<std::unique_ptr<Server>> Server::start(Renderer& renderer, ServerOptions options) {
    auto service = Service::make(renderer, options);
    if (!service) return service.error();
    auto impl = std::make_unique<Impl>(std::move(options), std::move(service).value());
    if (auto listening = impl->listen(); !listening) return listening.error();
    return std::unique_ptr<Server>(new Server(std::move(impl)));
}

std::uint16_t Server::port() const { return impl_->port(); }
std::string Server::address() const { return impl_->address(); }
Result<void> Server::addTool(std::shared_ptr<ServerTool> tool) { return impl_->service().addTool(std::move(tool)); }
void Server::wait() { impl_->wait(); }
void Server::stop() { impl_->stop(); }

}  // namespace emca
