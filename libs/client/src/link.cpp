#include "link.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "emca/protocol/codec.h"

namespace emca::client {

namespace {

using Tcp = asio::ip::tcp;
constexpr std::chrono::milliseconds kCancelPoll{5};

Error closedByUs() { return {ErrorCode::connectionLost, "The connection to the renderer was closed."}; }

}  // namespace

Link::Link(Address address, Connection::Options options) : address_(std::move(address)), options_(std::move(options)) {}

Link::~Link() {
    close();
    // The last owner may be the connection's own thread, which then ends by itself.
    if (thread_.joinable()) thread_.detach();
}

Result<void> Link::open() {
    const auto deadline = Clock::now() + options_.connectTimeout;
    if (auto connected = connect(deadline); !connected) return connected;
    if (auto greeted = greet(deadline); !greeted) return greeted;
    open_ = true;
    lastReceived_ = Clock::now().time_since_epoch().count();
    context_.restart();
    readHeader();
    thread_ = std::thread([self = shared_from_this()] { self->context_.run(); });
    return {};
}

bool Link::runUntil(const bool& done, Clock::time_point deadline) {
    context_.restart();
    while (!done && Clock::now() < deadline) {
        if (context_.run_one_until(deadline) == 0 && context_.stopped()) context_.restart();
    }
    return done;
}

Result<void> Link::connect(Clock::time_point deadline) {
    const Error late{ErrorCode::timedOut, "No renderer answered at " + address_.text() + " within " +
                                              std::to_string(options_.connectTimeout.count()) + " ms: is the address right?"};
    // Shared: a name server may answer after we gave up.
    struct State {
        bool done = false;
        std::error_code error;
        Tcp::resolver::results_type found;
    };
    const auto state = std::make_shared<State>();
    std::error_code numeric;
    const auto literal = asio::ip::make_address(address_.host, numeric);
    if (!numeric) {
        state->found = Tcp::resolver::results_type::create(Tcp::endpoint(literal, address_.port), address_.host, "");
    } else {
        Tcp::resolver resolver(context_);
        resolver.async_resolve(address_.host, std::to_string(address_.port), [state](std::error_code error, auto results) {
            state->error = error;
            state->found = results;
            state->done = true;
        });
        if (!runUntil(state->done, deadline)) return late;
        if (state->error) {
            return Error{ErrorCode::connectionFailed, "The name \"" + address_.host + "\" is unknown (" + state->error.message() + ")."};
        }
    }
    state->done = false;
    asio::async_connect(socket_, state->found, [state](std::error_code error, const Tcp::endpoint&) {
        state->error = error;
        state->done = true;
    });
    if (!runUntil(state->done, deadline)) {
        std::error_code ignored;
        socket_.close(ignored);
        return late;
    }
    if (state->error) {
        return Error{ErrorCode::connectionFailed, "No renderer answers at " + address_.text() + " (" + state->error.message() +
                                                      "): start it there, or give another address."};
    }
    std::error_code ignored;
    socket_.set_option(Tcp::no_delay(true), ignored);
    return {};
}

Result<void> Link::greet(Clock::time_point deadline) {
    const auto hello = protocol::encode({0, protocol::Hello{"EMCA client", protocol::kMinimumVersion, protocol::kMaximumVersion, {}, options_.token}});
    if (!hello) return hello.error();
    if (hello->size() > protocol::kMaximumHandshakeBytes) {
        return Error{ErrorCode::tooLarge, "The token is too long: a greeting may have " + std::to_string(protocol::kMaximumHandshakeBytes) + " bytes."};
    }
    const auto other = [&](const std::string& what) {
        return Error{ErrorCode::protocolViolation, "What listens at " + address_.text() + " is no EMCA renderer: " + what};
    };
    struct State {
        bool done = false;
        std::error_code error;
        std::array<std::byte, protocol::kHeaderBytes> header{};
        std::shared_ptr<std::byte[]> payload;
    };
    const auto state = std::make_shared<State>();
    const auto finished = [state](std::error_code error, std::size_t) {
        state->error = error;
        state->done = true;
    };
    const auto step = [&](auto start) -> Result<void> {
        state->done = false;
        start();
        if (!runUntil(state->done, deadline)) {
            std::error_code ignored;
            socket_.close(ignored);
            return Error{ErrorCode::timedOut, "What listens at " + address_.text() + " did not greet in time: is it an EMCA renderer?"};
        }
        if (state->error) return other("it closed the connection instead of greeting.");
        return {};
    };
    state->header = protocol::header(*hello);
    // A failed write is no answer yet: the reason may be waiting to be read.
    const std::array<asio::const_buffer, 2> out{asio::buffer(state->header), asio::buffer(hello->data(), hello->size())};
    if (auto sent = step([&] { asio::async_write(socket_, out, finished); }); !sent && sent.error().code == ErrorCode::timedOut) return sent;
    if (auto read = step([&] { asio::async_read(socket_, asio::buffer(state->header), finished); }); !read) return read;
    const auto bytes = protocol::payloadBytes(state->header, protocol::kMaximumHandshakeBytes);
    if (!bytes) return other(bytes.error().message);
    auto payload = protocol::allocatePayload(*bytes);
    if (!payload) return payload.error();
    state->payload = std::move(payload).value();
    if (auto read = step([&] { asio::async_read(socket_, asio::buffer(state->payload.get(), *bytes), finished); }); !read) return read;
    const auto message = protocol::decode(protocol::Frame(state->payload, state->payload.get(), *bytes));
    if (!message) return other(message.error().message);
    if (const auto* refusal = std::get_if<protocol::Refusal>(&message->body)) {
        return Error{refusal->error.code, "The renderer at " + address_.text() + " refused: " + refusal->error.message};
    }
    const auto* welcome = std::get_if<protocol::Welcome>(&message->body);
    if (!welcome) return other("it did not greet.");
    if (welcome->version < protocol::kMinimumVersion || welcome->version > protocol::kMaximumVersion) {
        return Error{ErrorCode::versionMismatch, "The renderer at " + address_.text() + " wants to speak version " +
                                                     std::to_string(welcome->version) + " of the protocol, which this program does not know."};
    }
    greeting_ = {welcome->software, welcome->version};
    if (welcome->maximumRequestBytes != 0) maximumRequestBytes_ = welcome->maximumRequestBytes;
    return {};
}

void Link::close() {
    const std::lock_guard once(closeMutex_);
    closing_ = true;
    if (!thread_.joinable()) return;
    asio::post(context_, [this] { fail(closedByUs()); });
    if (thread_.get_id() != std::this_thread::get_id()) thread_.join();
}

Result<void> Link::request(protocol::Body body, Handler handler, const std::atomic<bool>* cancel) {
    Pending pending{std::move(handler), std::nullopt};
    std::uint64_t number = 0;
    {
        const std::lock_guard lock(mutex_);
        if (lost_) return Error{ErrorCode::connectionLost, lost_->message};
        number = nextRequest_++;
    }
    auto frame = protocol::encode({number, std::move(body)});
    if (!frame) return frame.error();
    if (frame->size() > maximumRequestBytes_) {
        return Error{ErrorCode::tooLarge, "The request has " + std::to_string(frame->size()) + " bytes, but the renderer accepts at most " +
                                              std::to_string(maximumRequestBytes_) + ": ask for less at once."};
    }
    {
        const std::lock_guard lock(mutex_);
        if (lost_) return Error{ErrorCode::connectionLost, lost_->message};
        pending_.emplace(number, &pending);
    }
    const auto sent = Clock::now();
    asio::post(context_, [self = shared_from_this(), frame = std::move(frame).value()] { self->send(frame); });
    return waitFor(number, pending, cancel, sent);
}

Result<void> Link::waitFor(std::uint64_t number, Pending& pending, const std::atomic<bool>* cancel, Clock::time_point sent) {
    std::unique_lock lock(mutex_);
    while (!pending.outcome) {
        const auto silentUntil = std::max(sent, lastSign()) + options_.silenceTimeout;
        const auto now = Clock::now();
        if (cancel && *cancel) {
            pending_.erase(number);
            lock.unlock();
            if (auto frame = protocol::encode({number, protocol::Cancel{}})) {
                asio::post(context_, [self = shared_from_this(), frame = std::move(frame).value()] { self->send(frame); });
            }
            return Error{ErrorCode::cancelled, "The request was cancelled."};
        }
        if (now >= silentUntil) {
            pending_.erase(number);
            lock.unlock();
            const Error silent{ErrorCode::timedOut, "The renderer at " + address_.text() + " was silent for " +
                                                        std::to_string(options_.silenceTimeout.count()) + " ms."};
            asio::post(context_, [self = shared_from_this(), silent] { self->fail(silent); });
            return silent;
        }
        changed_.wait_until(lock, cancel ? std::min(silentUntil, now + kCancelPoll) : silentUntil);
    }
    return *pending.outcome;
}

void Link::readHeader() {
    asio::async_read(socket_, asio::buffer(header_), [self = shared_from_this()](std::error_code error, std::size_t) {
        if (error) return self->fail({ErrorCode::connectionLost, "The renderer at " + self->address_.text() + " closed the connection (" + error.message() + ")."});
        self->lastReceived_ = Clock::now().time_since_epoch().count();
        const auto bytes = protocol::payloadBytes(self->header_, self->options_.maximumFrameBytes);
        if (!bytes) return self->fail(bytes.error());
        self->readPayload(*bytes);
    });
}

void Link::readPayload(std::size_t bytes) {
    auto memory = protocol::allocatePayload(bytes);
    if (!memory) return fail(memory.error());
    const std::shared_ptr<std::byte[]> payload = std::move(memory).value();
    // Every piece is a sign of life, not only the whole of a large answer.
    const auto condition = [this](const std::error_code& error, std::size_t) -> std::size_t {
        lastReceived_ = Clock::now().time_since_epoch().count();
        return error ? 0 : std::numeric_limits<int>::max();
    };
    asio::async_read(socket_, asio::buffer(payload.get(), bytes), condition,
                     [self = shared_from_this(), payload, bytes](std::error_code error, std::size_t) {
                         if (error) return self->fail({ErrorCode::connectionLost, "The renderer at " + self->address_.text() + " closed the connection in the middle of an answer (" + error.message() + ")."});
                         self->received(protocol::Frame(payload, payload.get(), bytes));
                         if (self->socket_.is_open()) self->readHeader();
                     });
}

void Link::received(const protocol::Frame& frame) {
    Result<void> outcome;
    try {
        auto message = protocol::decode(frame);
        if (!message) return fail(message.error());
        if (message->request == 0) {
            const auto* failure = std::get_if<protocol::Failure>(&message->body);
            return fail(failure ? failure->error : Error{ErrorCode::protocolViolation, "The renderer sent an answer that belongs to no request."});
        }
        const std::lock_guard lock(mutex_);
        const auto it = pending_.find(message->request);
        if (it == pending_.end()) return;  // cancelled meanwhile
        Pending& pending = *it->second;
        if (const auto* failure = std::get_if<protocol::Failure>(&message->body)) {
            pending.outcome = Result<void>(failure->error);
        } else if (!std::holds_alternative<protocol::Unknown>(message->body)) {
            pending.outcome = pending.handler(message->body);
        }
        if (!pending.outcome) return;
        pending_.erase(it);
        changed_.notify_all();
    } catch (const std::bad_alloc&) {
        fail({ErrorCode::outOfMemory, "There was not enough memory for the renderer's answer: ask for less at once."});
    }
}

void Link::send(protocol::Frame frame) {
    if (!socket_.is_open()) return;
    const auto header = protocol::header(frame);
    outgoing_.push_back({std::move(frame), header});
    if (outgoing_.size() == 1) write();
}

void Link::write() {
    const Outgoing& next = outgoing_.front();
    const std::array<asio::const_buffer, 2> buffers{asio::buffer(next.header), asio::buffer(next.frame.data(), next.frame.size())};
    asio::async_write(socket_, buffers, [self = shared_from_this()](std::error_code error, std::size_t) {
        if (error) return;  // reading tells why
        self->outgoing_.pop_front();
        if (!self->outgoing_.empty()) self->write();
    });
}

void Link::fail(Error error) {
    std::error_code ignored;
    socket_.close(ignored);
    bool tell = false;
    {
        const std::lock_guard lock(mutex_);
        if (lost_) return;
        open_ = false;
        lost_ = closing_ ? closedByUs() : error;
        tell = !closing_;
        for (auto& [number, pending] : pending_) pending->outcome = Result<void>(*lost_);
        pending_.clear();
        changed_.notify_all();
    }
    if (tell && options_.lost) options_.lost(error);
}

}  // namespace emca::client
