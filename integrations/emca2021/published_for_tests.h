#pragma once

#include <array>
#include <asio.hpp>
#include <atomic>
#include <bit>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "emca/core/pixel.h"
#include "messages.h"

// A published server, written from the description of its wire, and the faults that such servers have.
namespace emca::bridge::test {

/// Bytes as a published server writes them.
class Writer {
  public:
    explicit Writer(bool swapped = false) : swapped_(swapped) {}
    template <typename T>
    Writer& add(T value) {
        auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
        if (swapped_) std::reverse(raw.begin(), raw.end());
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
        return *this;
    }
    Writer& id(std::int16_t v) { return add(v); }
    Writer& u32(std::uint32_t v) { return add(v); }
    Writer& boolean(bool v) { return add(std::uint8_t(v)); }
    Writer& text(const std::string& v) {
        add(std::uint64_t(v.size()));
        for (const char c : v) add(c);
        return *this;
    }
    Writer& letters(const char* v) {
        for (; *v != 0; ++v) add(*v);
        return *this;
    }
    Writer& vector(Vec3f v) { return add(v.x).add(v.y).add(v.z); }
    Writer& color(ColorA c) { return add(c.r).add(c.g).add(c.b).add(c.a); }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    bool swapped_;
    std::vector<std::byte> bytes_;
};

/// What a reader gets: bytes that end; in small portions, as a network has them.
class Bytes final : public ByteSource {
  public:
    explicit Bytes(std::span<const std::byte> bytes, ErrorCode atEnd = ErrorCode::connectionLost, std::size_t portion = 7)
        : bytes_(bytes), atEnd_(atEnd), portion_(portion) {}
    Result<std::size_t> readSome(std::span<std::byte> into, std::chrono::milliseconds) override {
        if (bytes_.empty()) return Error{atEnd_, "That was all."};
        const std::size_t n = std::min({bytes_.size(), into.size(), portion_});
        std::memcpy(into.data(), bytes_.data(), n);
        bytes_ = bytes_.subspan(n);
        return n;
    }

  private:
    std::span<const std::byte> bytes_;
    ErrorCode atEnd_;
    std::size_t portion_;
};

void write(Writer& out, const PublishedInfo& info);      // each: the body of a reply
void write(Writer& out, const PublishedCamera& camera);
void write(Writer& out, const PublishedScene& scene);
void write(Writer& out, const PublishedPath& path);
/// \param announced  number of paths that is written before them
void write(Writer& out, std::uint32_t announced, const std::vector<PublishedPath>& paths);

/// What the server shows, and what goes wrong. Set before start().
struct Show {
    PublishedInfo info{"in-test renderer", "two triangles", 4};
    std::vector<std::int16_t> plugins{17, -3};
    PublishedCamera camera{{0, 0, 5}, {0, 0, -1}, {0, 1, 0}, 0.1f, 100, 40};
    PublishedScene scene;
    std::string imagePath;
    std::optional<PublishedScene> heatMap;  ///< sent behind images, and instead of the scene afterwards
    std::function<std::vector<PublishedPath>(Pixel, std::uint32_t samples)> paths;

    bool swapped = false;
    std::int16_t hello = MessageId::hello;
    std::uint32_t tooMany = 0;               ///< paths announced that do not come
    std::map<std::int16_t, bool> unanswered; ///< requests at which the renderer throws
    bool namesOnce = false;                  ///< answers for its names at the beginning of a connection alone
    /// Bytes of one connection after which it falls silent, or is closed.
    std::size_t silentAfter = SIZE_MAX, closedAfter = SIZE_MAX;
    /// Requests of one connection after which it is closed while nothing is asked.
    int restsAfter = 1 << 30;
    /// Changes a message on its way.
    std::function<void(std::int16_t id, std::vector<std::byte>& message)> alter;
    /// Called before an image is answered, in the server's thread: a long render.
    std::function<void()> rendering;
};

/// Two triangles (a square), one of them divided twice by `heatMap`, and paths with every kind of value, gaps in their
/// indices, and all optional quantities.
Show exampleShow();
std::vector<PublishedPath> examplePaths(Pixel pixel, std::uint32_t samples);

class PublishedServerForTests {
  public:
    explicit PublishedServerForTests(Show show);
    ~PublishedServerForTests();
    std::uint16_t port() const { return port_; }

    // What happened so far.
    int connections() const { return connections_; }
    int goodbyes() const { return goodbyes_; }
    bool quit() const { return quit_; }
    std::size_t sent() const { return sent_; }             ///< bytes of the last connection
    std::vector<std::int16_t> requests() const;            ///< of all connections, without those for names
    std::vector<std::array<std::uint32_t, 3>> pixels() const;

  private:
    void serve();
    void talk();
    bool answer(std::int16_t id);
    bool send(std::int16_t id, std::vector<std::byte> message);
    template <typename T>
    bool receive(T& value);

    Show show_;
    asio::io_context context_;
    asio::ip::tcp::acceptor acceptor_{context_};
    asio::ip::tcp::socket socket_{context_};
    std::uint16_t port_ = 0;
    std::atomic<bool> ending_{false}, quit_{false};
    std::atomic<int> connections_{0}, goodbyes_{0};
    std::atomic<std::size_t> sent_{0};
    bool heatMapReady_ = false;
    int namesAnswered_ = 0;  // in this connection
    mutable std::mutex mutex_;
    std::vector<std::int16_t> requests_;
    std::vector<std::array<std::uint32_t, 3>> pixels_;
    std::thread thread_;
};

}  // namespace emca::bridge::test
