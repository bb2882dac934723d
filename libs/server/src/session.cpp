#include "session.h"

#include <algorithm>
#include <new>
#include <utility>

#include "emca/protocol/codec.h"

namespace emca {

namespace {

constexpr std::chrono::seconds kKeepAlive{2};
constexpr std::chrono::seconds kGoodbye{2};   // for reading the sentence that says why

/// Takes as long for a wrong token as for a right one.
bool sameText(const std::string& a, const std::string& b) {
    unsigned different = a.size() != b.size();
    for (std::size_t i = 0; i < a.size(); ++i) {
        different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(i < b.size() ? b[i] : 0);
    }
    return different == 0;
}

std::string versions(unsigned minimum, unsigned maximum) {
    return minimum == maximum ? "version " + std::to_string(minimum)
                              : "versions " + std::to_string(minimum) + " to " + std::to_string(maximum);
}

Error noMemory() {
    return {ErrorCode::outOfMemory, "There was not enough memory for this request: ask for less at once."};
}

/// Encodes, or says in the same place why that was not possible.
protocol::Frame encoded(std::uint64_t request, protocol::Body body) {
    auto frame = protocol::encode({request, std::move(body)});
    if (!frame) frame = protocol::encode({request, protocol::Failure{frame.error()}});
    return frame ? std::move(frame).value() : protocol::Frame();
}

}  // namespace

Session::Session(asio::ip::tcp::socket socket, SessionHost& host, std::uint64_t id)
    : socket_(std::move(socket)), timer_(socket_.get_executor()), host_(host), id_(id) {
    std::error_code error;
    const auto endpoint = socket_.remote_endpoint(error);
    peer_ = error ? "a client" : endpoint.address().to_string() + ":" + std::to_string(endpoint.port());
    socket_.set_option(asio::ip::tcp::no_delay(true), error);
    socket_.set_option(asio::socket_base::keep_alive(true), error);
}

void Session::start() {
    timer_.expires_after(host_.options().handshakeTimeout);
    timer_.async_wait([weak = weak_from_this()](std::error_code error) {
        const auto self = weak.lock();
        if (error || !self || self->state_ != State::handshake) return;
        self->refuse({ErrorCode::timedOut, "No greeting arrived in time: is this an EMCA client?"});
    });
    readHeader();
}

void Session::refuse(Error error) {
    host_.log(peer_ + " was sent away: " + error.message);
    const bool greeted = state_ == State::open;
    state_ = State::leaving;
    if (greeted) {
        reply(0, protocol::Failure{std::move(error)});
    } else {
        reply(0, protocol::Refusal{std::move(error), protocol::kMinimumVersion, protocol::kMaximumVersion});
    }
    timer_.expires_after(kGoodbye);
    timer_.async_wait([weak = weak_from_this()](std::error_code failed) {
        const auto self = weak.lock();
        if (!failed && self) self->close();
    });
}

void Session::close() {
    if (state_ == State::closed) return;
    state_ = State::closed;
    for (auto& [number, request] : pending_) {
        request->cancelled = true;
        host_.withdraw(request);
    }
    const auto self = shared_from_this();
    pending_.clear();
    streams_.clear();
    timer_.cancel();
    std::error_code ignored;
    socket_.close(ignored);
    host_.closed(*this);
}

void Session::readHeader() {
    asio::async_read(socket_, asio::buffer(header_), [self = shared_from_this()](std::error_code error, std::size_t) {
        if (self->state_ == State::closed) return;
        if (error) return self->lost(error);
        const bool greeting = self->state_ == State::handshake;
        auto bytes = protocol::payloadBytes(self->header_, greeting ? protocol::kMaximumHandshakeBytes : protocol::kMaximumRequestBytes);
        if (self->state_ == State::leaving) return self->drain();
        if (!bytes) {
            self->refuse(bytes.error());
            return self->drain();
        }
        self->readPayload(*bytes);
    });
}

void Session::readPayload(std::size_t bytes) {
    auto memory = protocol::allocatePayload(bytes);
    if (!memory) {
        refuse(memory.error());
        return drain();
    }
    const std::shared_ptr<std::byte[]> payload = std::move(memory).value();
    asio::async_read(socket_, asio::buffer(payload.get(), bytes),
                     [self = shared_from_this(), payload, bytes](std::error_code error, std::size_t) {
                         if (self->state_ == State::closed) return;
                         if (error) return self->lost(error);
                         if (self->state_ == State::leaving) return self->drain();
                         self->received(protocol::Frame(payload, payload.get(), bytes));
                         if (self->state_ == State::leaving) return self->drain();
                         if (self->state_ != State::closed) self->readHeader();
                     });
}

void Session::lost(const std::error_code&) {
    if (state_ == State::open) host_.log(peer_ + " is gone.");
    close();
}

/// Closing with unread bytes would reset the connection, and the other side might never read why.
void Session::drain() {
    socket_.async_read_some(asio::buffer(discarded_), [self = shared_from_this()](std::error_code error, std::size_t) {
        if (self->state_ == State::closed) return;
        if (error) return self->close();
        self->drain();
    });
}

void Session::received(const protocol::Frame& frame) {
    try {
        auto message = protocol::decode(frame);
        if (!message) return refuse(message.error());
        if (state_ == State::handshake) return receivedHello(*message);
        receivedRequest(std::move(message).value(), frame.size());
    } catch (const std::bad_alloc&) {
        refuse(noMemory());
    }
}

void Session::receivedHello(const protocol::Message& message) {
    const auto* hello = std::get_if<protocol::Hello>(&message.body);
    if (!hello) return refuse({ErrorCode::protocolViolation, "The first message must be a greeting (Hello), but another one came."});
    const unsigned version = std::min<unsigned>(hello->maximumVersion, protocol::kMaximumVersion);
    if (version < std::max<unsigned>(hello->minimumVersion, protocol::kMinimumVersion)) {
        return refuse({ErrorCode::versionMismatch,
                       "The client speaks " + versions(hello->minimumVersion, hello->maximumVersion) + " of the protocol, this server " +
                           versions(protocol::kMinimumVersion, protocol::kMaximumVersion) + ": use programs of the same release."});
    }
    const std::string& token = host_.options().token;
    if (!token.empty() && !sameText(hello->token, token)) {
        return refuse({ErrorCode::refused, hello->token.empty() ? "This server wants a token, but none was given."
                                                                : "The token is not the one that this server wants."});
    }
    if (!host_.admit(*this)) {
        return refuse({ErrorCode::refused, "This server has " + std::to_string(host_.options().maximumClients) +
                                               " clients already and takes no more."});
    }
    state_ = State::open;
    host_.log(peer_ + " connected: " + hello->software.substr(0, 100));
    reply(0, protocol::Welcome{"EMCA server", static_cast<std::uint16_t>(version), {}, protocol::kMaximumRequestBytes});
    keepAlive();
}

void Session::receivedRequest(protocol::Message message, std::size_t bytes) {
    const std::uint64_t number = message.request;
    if (std::holds_alternative<protocol::Cancel>(message.body)) return cancel(number);
    if (number == 0 || pending_.contains(number)) {
        return refuse({ErrorCode::protocolViolation, "Request number " + std::to_string(number) + " is " + (number == 0 ? "not allowed." : "in use.")});
    }
    if (outgoing_.size() > kMaximumOutgoing) {
        return refuse({ErrorCode::tooLarge, "The client asks for more and more while it does not read the answers."});
    }
    if (pending_.size() >= kMaximumPending || pendingBytes_ + bytes > kMaximumPendingBytes) {
        return reply(number, protocol::Failure{{ErrorCode::refused, "Too many requests are waiting already: wait for an answer first."}});
    }
    if (std::holds_alternative<protocol::QuitRequest>(message.body)) {
        if (!host_.options().allowQuit) {
            return reply(number, protocol::Failure{{ErrorCode::notSupported, "This server was not started so that clients may end it."}});
        }
        host_.log(peer_ + " ends the server.");
        return reply(number, protocol::Done{}, [this] { host_.quitRequested(); });
    }
    auto request = std::make_shared<Request>();
    request->id = number;
    request->body = std::move(message.body);
    request->bytes = bytes;
    request->client = shared_from_this();
    pending_.emplace(number, request);
    pendingBytes_ += bytes;
    host_.submit(std::move(request));
}

void Session::cancel(std::uint64_t number) {
    const auto it = pending_.find(number);
    if (it == pending_.end()) return;  // answered while the cancel was under way
    const std::shared_ptr<Request> request = it->second;
    request->cancelled = true;
    // A running one answers when its renderer returns; its stream ends at the next piece.
    const auto stream = std::find_if(streams_.begin(), streams_.end(), [&](const Stream& s) { return s.request == request; });
    if (stream != streams_.end()) {
        streams_.erase(stream);
    } else if (!host_.withdraw(request)) {
        return;
    }
    forget(number);
    reply(number, protocol::Failure{{ErrorCode::cancelled, "The request was cancelled."}});
}

void Session::inform(const Request& request, protocol::Body body) {
    if (queuedBytes_ > kPreviewBytes || request.cancelled) return;
    post(encoded(request.id, std::move(body)), 0);
}

void Session::send(const Request& request, protocol::Body body) { post(encoded(request.id, std::move(body)), 0); }

void Session::finish(const Request& request, protocol::Body body) {
    post(encoded(request.id, std::move(body)), request.id);
}

void Session::post(protocol::Frame frame, std::uint64_t finished) {
    queuedBytes_ += frame.size();
    asio::post(socket_.get_executor(), [self = shared_from_this(), frame = std::move(frame), finished] {
        if (finished != 0) self->forget(finished);
        if (self->state_ == State::open) {
            self->enqueue(frame);
        } else {
            self->queuedBytes_ -= frame.size();
        }
    });
}

void Session::stream(const Request& request, Source source) {
    asio::post(socket_.get_executor(), [self = shared_from_this(), number = request.id, source = std::move(source)]() mutable {
        const auto it = self->pending_.find(number);
        if (self->state_ != State::open || it == self->pending_.end()) return;
        if (it->second->cancelled) {
            self->forget(number);
            return self->reply(number, protocol::Failure{{ErrorCode::cancelled, "The request was cancelled."}});
        }
        self->streams_.push_back({it->second, std::move(source)});
        self->write();
    });
}

void Session::reply(std::uint64_t request, protocol::Body body, std::function<void()> sent) {
    protocol::Frame frame = encoded(request, std::move(body));
    queuedBytes_ += frame.size();
    enqueue(std::move(frame), std::move(sent));
}

void Session::enqueue(protocol::Frame frame, std::function<void()> sent) {
    Outgoing outgoing{std::move(frame), {}, std::move(sent)};
    outgoing.header = protocol::header(outgoing.frame);
    outgoing_.push_back(std::move(outgoing));
    write();
}

/// Answers that are there go before pieces of long ones, so that a click does not wait for a scene.
bool Session::pullStream() {
    while (!streams_.empty()) {
        Stream stream = std::move(streams_.front());
        streams_.pop_front();
        std::optional<protocol::Body> body;
        try {
            if (!stream.request->cancelled) body = stream.source();
        } catch (const std::bad_alloc&) {
            body = protocol::Failure{noMemory()};
            stream.source = [] { return std::optional<protocol::Body>(); };
        }
        if (!body) {
            forget(stream.request->id);
            continue;
        }
        Outgoing outgoing{encoded(stream.request->id, std::move(*body)), {}, {}};
        outgoing.header = protocol::header(outgoing.frame);
        queuedBytes_ += outgoing.frame.size();
        outgoing_.push_back(std::move(outgoing));
        streams_.push_back(std::move(stream));  // several long answers take turns
        return true;
    }
    return false;
}

void Session::write() {
    if (writing_ || state_ == State::closed) return;
    if (outgoing_.empty() && !pullStream()) {
        if (state_ == State::leaving) {
            std::error_code ignored;
            socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
        }
        return;
    }
    writing_ = true;
    const Outgoing& next = outgoing_.front();
    const std::array<asio::const_buffer, 2> buffers{asio::buffer(next.header), asio::buffer(next.frame.data(), next.frame.size())};
    asio::async_write(socket_, buffers, [self = shared_from_this()](std::error_code error, std::size_t) {
        self->writing_ = false;
        if (self->state_ == State::closed) return;
        if (error) return self->lost(error);
        const Outgoing done = std::move(self->outgoing_.front());
        self->outgoing_.pop_front();
        self->written(done.frame.size());
        if (done.sent) done.sent();
        self->write();
    });
}

void Session::written(std::size_t bytes) {
    const bool before = congested();
    queuedBytes_ -= bytes;
    if (before && !congested()) host_.readsAgain();
}

void Session::forget(std::uint64_t number) {
    const auto it = pending_.find(number);
    if (it == pending_.end()) return;
    pendingBytes_ -= it->second->bytes;
    pending_.erase(it);
}

/// So that a client knows that its request is alive even if it waits behind a long render.
void Session::keepAlive() {
    timer_.expires_after(kKeepAlive);
    timer_.async_wait([weak = weak_from_this()](std::error_code error) {
        const auto self = weak.lock();
        if (error || !self || self->state_ != State::open) return;
        if (self->queuedBytes_ == 0) {
            for (const auto& [number, request] : self->pending_) {
                self->reply(number, protocol::Progress{request->fraction, !request->running});
            }
        }
        self->keepAlive();
    });
}

}  // namespace emca
