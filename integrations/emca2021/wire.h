#pragma once

#include <algorithm>
#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/result.h"
#include "emca/core/vector.h"

// The wire of the EMCA servers that were published with the paper (2021): messages without lengths, in the byte order of
// the server's machine. docs/integrations/emca2021.md describes it byte by byte.
namespace emca::bridge {

/// First two bytes of every message, int16.
struct MessageId {
    enum : std::int16_t {
        hello = 0x01, plugins = 0x02, disconnect = 0x0E, quit = 0x0F,
        requestInfo = 0x11, requestImage = 0x12, requestPixel = 0x13, requestCamera = 0x14, requestScene = 0x15,
        info = 0x21, image = 0x22, pixel = 0x23, camera = 0x24, scene = 0x25,
    };
};

/// What no reply of a sane server exceeds; beyond, it is refused before memory is taken for it.
struct WireLimits {
    std::uint32_t nameBytes = 1u << 16;      ///< of a name, a file's path, a key; two of them fit into the reader's buffer
    std::uint32_t textBytes = 1u << 24;      ///< of a text value
    std::uint32_t plugins = 1u << 12;
    std::uint32_t meshes = 1u << 20;
    std::uint32_t verticesOfMesh = 1u << 27, trianglesOfMesh = 1u << 27;
    std::uint32_t valuesOfItem = 1u << 16;   ///< user data of one path or intersection
    std::uint32_t paths = 1u << 24, intersectionsOfPath = 1u << 20;
    std::uint64_t replyBytes = std::uint64_t(2) << 30;
};

/// Where bytes of the server come from.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    /// Waits for at least one byte.
    /// \param silence  longest wait; 0: for ever
    /// \return how many came. Errors: timedOut, connectionLost (also at the proper end), cancelled.
    virtual Result<std::size_t> readSome(std::span<std::byte> into, std::chrono::milliseconds silence) = 0;
};

/// Reads numbers and texts. After the first failure everything reads as 0 or empty, so that a decoder asks ok() where it
/// loops and at its end. Memory follows what has arrived, never what was announced.
class WireReader {
  public:
    explicit WireReader(ByteSource& source, WireLimits limits = {}) : source_(source), limits_(limits) {}

    const WireLimits& limits() const { return limits_; }
    /// From now on: longest silence within a message. 0: for ever.
    void setSilence(std::chrono::milliseconds silence) { silence_ = silence; }
    /// Numbers come with their bytes in the other order than here.
    void setSwapped(bool swapped) { swapped_ = swapped; }

    bool ok() const { return !failed_; }
    const Error& error() const { return error_; }
    void fail(ErrorCode code, std::string sentence);
    /// Adds to the sentence of a failure where it was, before its last full stop. Nothing if all is well.
    void explain(const std::string& where);
    /// Begins a reply: the count of its bytes starts at 0.
    void beginReply() { replyBytes_ = 0; }

    template <std::integral T> T integer() { return number<T>(); }
    float real() { return number<float>(); }
    double real64() { return number<double>(); }
    /// Fails at anything but 0 and 1: the surest sign of a stream that is not what it should be.
    bool boolean(const char* what);
    /// u32, at most `limit`.
    std::uint32_t count(std::uint32_t limit, const char* what);
    std::string text(std::uint32_t limit, const char* what);
    Vec3f vector();
    ColorA color();
    /// T is made of 32-bit numbers.
    template <typename T>
    std::vector<T> array(std::uint32_t count) {
        static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
        std::vector<T> values;
        constexpr std::uint32_t kStep = (1u << 20) / sizeof(T);
        while (ok() && values.size() < count) {
            const std::size_t first = values.size(), more = std::min<std::size_t>(kStep, count - first);
            values.resize(first + more);
            bytes(std::as_writable_bytes(std::span(values).subspan(first)), 4);
        }
        if (!ok()) values.clear();
        return values;
    }

    /// Waits until there is a byte to read. \return ok()
    bool wait() { return ok() && (!drained() || fill()); }
    /// Whether the next bytes are these; they stay unread. Waits for them as long as what has come agrees. False with
    /// ok() still true: others; with ok() false: nobody knows.
    bool nextIs(std::span<const std::byte> expected);
    /// Whether all that has arrived is read.
    bool drained() const { return begin_ == end_; }
    /// Forgets a failure of the source, so that the rest may be read later.
    void forgive() { failed_ = false; }

  private:
    template <typename T>
    T number() {
        T value{};
        bytes(std::as_writable_bytes(std::span(&value, 1)), sizeof(T));
        return ok() ? value : T{};
    }
    /// \param unit  bytes of one number, for the order
    void bytes(std::span<std::byte> into, std::size_t unit);
    bool fill();

    ByteSource& source_;
    WireLimits limits_;
    std::chrono::milliseconds silence_{0};
    bool swapped_ = false, failed_ = false;
    Error error_;
    std::uint64_t replyBytes_ = 0;
    std::vector<std::byte> buffer_;
    std::size_t begin_ = 0, end_ = 0;
};

/// A request.
class WireWriter {
  public:
    explicit WireWriter(bool swapped) : swapped_(swapped) {}
    template <std::integral T>
    WireWriter& add(T value) {
        std::byte raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof value);
        if (swapped_) std::reverse(raw, raw + sizeof raw);
        bytes_.insert(bytes_.end(), raw, raw + sizeof raw);
        return *this;
    }
    WireWriter& text(const std::string& value) {
        add<std::uint64_t>(value.size());
        const auto raw = std::as_bytes(std::span(value));
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
        return *this;
    }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    bool swapped_;
    std::vector<std::byte> bytes_;
};

}  // namespace emca::bridge
