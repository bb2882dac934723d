#include "link.h"

#include <netinet/tcp.h>
#include <sys/socket.h>

#include <utility>

namespace emca::bridge {

namespace {

using Tcp = asio::ip::tcp;

std::string secondsText(std::chrono::milliseconds time) {
    return time.count() % 1000 == 0 ? std::to_string(time.count() / 1000) + " s" : std::to_string(time.count()) + " ms";
}

}  // namespace

bool Link::run(const bool& done, std::chrono::milliseconds limit, AtLimit atLimit) {
    context_.restart();
    if (limit.count() == 0) {
        while (!done && context_.run_one() != 0) {}
    } else {
        const auto deadline = std::chrono::steady_clock::now() + limit;
        while (!done && context_.run_one_until(deadline) != 0) {}
    }
    if (done) return true;
    // The handler refers to the caller's stack: it must have run before that is gone.
    std::error_code ignored;
    if (atLimit == AtLimit::cancel) {
        socket_.cancel(ignored);
    } else {
        socket_.close(ignored);  // to connect goes on with the next address otherwise
    }
    context_.restart();
    while (!done && context_.run_one() != 0) {}
    return false;
}

Error Link::late(std::chrono::milliseconds limit) const {
    return {ErrorCode::timedOut, "The published server at " + address_ + " was silent for " + secondsText(limit) +
                                     ": it is busy, or it waits for something; its own output may tell, and --timeout gives it longer."};
}

Result<void> Link::outcome(std::error_code error, const char* doing) const {
    if (interrupted_) return Error{ErrorCode::cancelled, "The bridge is ending."};
    if (error) {
        return Error{ErrorCode::connectionLost, "The published server at " + address_ + " closed the connection while " + doing +
                                                    (error == asio::error::eof ? "." : " (" + error.message() + ").")};
    }
    return {};
}

Result<void> Link::connect(const std::string& host, std::uint16_t port, std::chrono::milliseconds limit) {
    address_ = (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + std::to_string(port);
    // Shared: a name server may answer after we gave up.
    struct State {
        bool done = false;
        std::error_code error;
        Tcp::resolver::results_type found;
    };
    const auto deadline = std::chrono::steady_clock::now() + limit;
    const auto found = std::make_shared<State>();
    std::error_code numeric;
    const auto literal = asio::ip::make_address(host, numeric);
    if (!numeric) {
        found->found = Tcp::resolver::results_type::create(Tcp::endpoint(literal, port), host, "");
    } else {
        Tcp::resolver resolver(context_);
        resolver.async_resolve(host, std::to_string(port), [found](std::error_code error, auto results) {
            found->error = error;
            found->found = results;
            found->done = true;
        });
        context_.restart();
        while (!found->done && context_.run_one_until(deadline) != 0) {}
        if (!found->done) return late(limit);
        if (found->error) return Error{ErrorCode::connectionFailed, "The name \"" + host + "\" is unknown (" + found->error.message() + ")."};
    }
    if (interrupted_) return outcome({}, "");
    bool done = false;
    std::error_code failed;
    asio::async_connect(socket_, found->found, [&](std::error_code error, const Tcp::endpoint&) {
        failed = error;
        done = true;
    });
    if (!run(done, limit, AtLimit::close)) return late(limit);
    if (interrupted_) return outcome({}, "");
    if (failed) {
        return Error{ErrorCode::connectionFailed, "No published EMCA server answers at " + address_ + " (" + failed.message() +
                                                      "): start it there (it ends when a client vanishes), or give another address."};
    }
    std::error_code ignored;
    socket_.set_option(Tcp::no_delay(true), ignored);
    socket_.set_option(asio::socket_base::keep_alive(true), ignored);  // a render may be silent for hours
    return {};
}

Result<std::size_t> Link::readSome(std::span<std::byte> into, std::chrono::milliseconds silence) {
    if (interrupted_) return outcome({}, "").error();
#ifdef TCP_QUICKACK
    // Published servers send number by number and wait for the acknowledgement before the last of them: 40 ms a reply
    // otherwise. The system forgets the option, so it is set anew.
    const int now = 1;
    (void)::setsockopt(socket_.native_handle(), IPPROTO_TCP, TCP_QUICKACK, &now, sizeof now);
#endif
    bool done = false;
    std::error_code failed;
    std::size_t came = 0;
    socket_.async_read_some(asio::buffer(into.data(), into.size()), [&](std::error_code error, std::size_t bytes) {
        failed = error;
        came = bytes;
        done = true;
    });
    if (!run(done, silence) && came == 0) return late(silence);
    if (came > 0) return came;
    return outcome(failed, "it was to answer").error();
}

Result<void> Link::write(std::span<const std::byte> bytes, std::chrono::milliseconds limit) {
    if (interrupted_) return outcome({}, "");
    bool done = false;
    std::error_code failed;
    asio::async_write(socket_, asio::buffer(bytes.data(), bytes.size()), [&](std::error_code error, std::size_t) {
        failed = error;
        done = true;
    });
    if (!run(done, limit)) return late(limit);
    return outcome(failed, "it was asked");
}

void Link::interrupt() {
    interrupted_ = true;
    asio::post(context_, [this] {
        std::error_code ignored;
        socket_.cancel(ignored);
    });
}

}  // namespace emca::bridge
