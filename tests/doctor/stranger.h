#pragma once

#include <asio.hpp>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace emca::test {

/// Something on a port that is no EMCA server: tells each client the same bytes, then keeps still or hangs up.
class Stranger {
  public:
    Stranger(std::string bytes, bool hangsUp) : bytes_(std::move(bytes)), hangsUp_(hangsUp) {
        acceptor_ = asio::ip::tcp::acceptor(context_, {asio::ip::address_v4::loopback(), 0});
        accept();
        thread_ = std::thread([this] { context_.run(); });
    }
    ~Stranger() {
        context_.stop();
        thread_.join();
    }
    Stranger(const Stranger&) = delete;
    Stranger& operator=(const Stranger&) = delete;
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  private:
    void accept() {
        acceptor_.async_accept([this](std::error_code error, asio::ip::tcp::socket socket) {
            if (error) return;
            std::error_code ignored;
            asio::write(socket, asio::buffer(bytes_), ignored);
            if (!hangsUp_) kept_.push_back(std::move(socket));
            accept();
        });
    }
    const std::string bytes_;
    const bool hangsUp_;
    asio::io_context context_;
    asio::ip::tcp::acceptor acceptor_{context_};
    std::vector<asio::ip::tcp::socket> kept_;
    std::thread thread_;
};

/// Stands between a client and a server, and ends each connection after so many bytes of the server's.
class Scissors {
  public:
    /// \param connections  how many come through at all; later ones find nobody
    Scissors(std::uint16_t server, std::size_t bytes, int connections) : server_(server), bytes_(bytes), connections_(connections) {
        acceptor_ = asio::ip::tcp::acceptor(context_, {asio::ip::address_v4::loopback(), 0});
        port_ = acceptor_.local_endpoint().port();
        accept();
        thread_ = std::thread([this] { context_.run(); });
    }
    ~Scissors() {
        context_.stop();
        thread_.join();
    }
    Scissors(const Scissors&) = delete;
    Scissors& operator=(const Scissors&) = delete;
    std::uint16_t port() const { return port_; }

  private:
    struct Pair {
        explicit Pair(asio::io_context& context) : client(context), server(context) {}
        asio::ip::tcp::socket client, server;
        std::array<char, 4096> up{}, down{};
        std::size_t left = 0;
        void close() {
            std::error_code ignored;
            client.close(ignored);
            server.close(ignored);
        }
    };
    void accept() {
        auto pair = std::make_shared<Pair>(context_);
        acceptor_.async_accept(pair->client, [this, pair](std::error_code error) {
            if (error) return;
            pair->left = bytes_;
            pair->server.connect({asio::ip::address_v4::loopback(), server_});
            forward(pair, pair->client, pair->server, pair->up, false);
            forward(pair, pair->server, pair->client, pair->down, true);
            if (--connections_ > 0) accept();
            else acceptor_.close();
        });
    }
    void forward(std::shared_ptr<Pair> pair, asio::ip::tcp::socket& from, asio::ip::tcp::socket& to, std::array<char, 4096>& buffer, bool cuts) {
        from.async_read_some(asio::buffer(buffer), [this, pair, &from, &to, &buffer, cuts](std::error_code error, std::size_t n) {
            if (error) return pair->close();
            const std::size_t passed = cuts ? std::min(n, pair->left) : n;
            std::error_code ignored;
            asio::write(to, asio::buffer(buffer.data(), passed), ignored);
            if (cuts && (pair->left -= passed) == 0) return pair->close();
            forward(pair, from, to, buffer, cuts);
        });
    }
    const std::uint16_t server_;
    const std::size_t bytes_;
    int connections_;
    std::uint16_t port_ = 0;
    asio::io_context context_;
    asio::ip::tcp::acceptor acceptor_{context_};
    std::thread thread_;
};

}  // namespace emca::test
