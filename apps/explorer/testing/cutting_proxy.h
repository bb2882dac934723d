#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace emca::explorer {

/// Stands between a client and a server on this machine, and cuts the line once: after so many bytes of the server, or
/// at once. Later connections are whole. What a server does that dies in the middle of a word.
class CuttingProxy {
  public:
    /// \param bytes  of the server, before the line is cut; negative: never
    explicit CuttingProxy(std::uint16_t server, std::int64_t bytes = -1) : server_(server), left_(bytes), cuts_(bytes >= 0) {
        listener_ = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address = loopback(0);
        bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address);
        listen(listener_, 8);
        socklen_t size = sizeof address;
        getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
        port_ = ntohs(address.sin_port);
        acceptor_ = std::thread([this] { acceptAll(); });
    }
    ~CuttingProxy() {
        ending_ = true;
        shutdown(listener_, SHUT_RDWR);
        acceptor_.join();
        close(listener_);
        cutNow();
        for (std::thread& thread : threads_) thread.join();
        for (const int end : ends_) close(end);
    }
    CuttingProxy(const CuttingProxy&) = delete;
    CuttingProxy& operator=(const CuttingProxy&) = delete;

    std::uint16_t port() const { return port_; }
    bool hasCut() const { return cut_; }
    std::int64_t bytesSent() const { return sent_; }
    void cutNow() {
        const std::lock_guard lock(mutex_);
        cut_ = true;
        for (const int end : ends_) shutdown(end, SHUT_RDWR);
    }

  private:
    static sockaddr_in loopback(std::uint16_t port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(port);
        return address;
    }
    void acceptAll() {
        while (!ending_) {
            const int client = accept(listener_, nullptr, nullptr);
            if (client < 0) return;
            const int server = socket(AF_INET, SOCK_STREAM, 0);
            const sockaddr_in address = loopback(server_);
            if (connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
                close(client);
                close(server);
                continue;
            }
            const std::lock_guard lock(mutex_);
            ends_.insert(ends_.end(), {client, server});
            threads_.emplace_back([this, client, server] { forward(client, server, false); });
            threads_.emplace_back([this, client, server] { forward(server, client, true); });
        }
    }
    void forward(int from, int to, bool counted) {
        char bytes[4096];
        for (;;) {
            ssize_t got = recv(from, bytes, sizeof bytes, 0);
            if (got <= 0) break;
            bool last = false;
            if (counted && cuts_ && !cut_) {
                got = static_cast<ssize_t>(std::min<std::int64_t>(got, left_));
                left_ -= got;
                last = left_ == 0;
            }
            for (ssize_t sent = 0; sent < got;) {
                const ssize_t part = send(to, bytes + sent, static_cast<std::size_t>(got - sent), MSG_NOSIGNAL);
                if (part <= 0) break;
                sent += part;
            }
            if (counted) sent_ += got;
            if (last) {
                cutNow();
                return;
            }
        }
        shutdown(from, SHUT_RDWR);
        shutdown(to, SHUT_RDWR);
    }

    std::uint16_t server_, port_ = 0;
    int listener_ = -1;
    std::atomic<std::int64_t> left_, sent_{0};
    const bool cuts_;
    std::atomic<bool> cut_{false}, ending_{false};
    std::mutex mutex_;
    std::vector<int> ends_;
    std::vector<std::thread> threads_;
    std::thread acceptor_;
};

}  // namespace emca::explorer
