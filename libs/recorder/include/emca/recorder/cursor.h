#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "emca/core/color.h"
#include "emca/core/event.h"
#include "emca/core/path_set.h"
#include "emca/core/pixel.h"
#include "emca/core/vector.h"
#include "emca/recorder/key.h"
#include "emca/recorder/recordable.h"

/// What stands behind the inline calls of PathRecorder and of the handles. Renderers do not call it.
namespace emca::detail {

/// First two bytes of every record of a thread's log: which quantity follows.
struct LogTag {
    enum : std::uint16_t {
        ignored = 0,  ///< of columns that nobody asked for; never written
        cameraVertex, lightVertex, revisit, environment,
        position, nextEvent, estimate, emission, surface, event, contribution, splat,
        wide,         ///< a user column whose number needs four bytes, which follow
        firstUser,    ///< the user column of number 0; the others follow
        end = 0xffff,
    };
};

struct SurfaceValue { std::int32_t mesh, face; };
struct EventValue { std::uint32_t label; Event event; Lobe lobe; std::uint16_t reserved = 0; };

/// Tells user columns of one thread apart, and where FastColumn keeps them. Never 0.
constexpr std::uint64_t columnId(std::uint64_t keyHash, Scope scope, ValueType type) {
    const auto kind = static_cast<std::uint64_t>(type) << 1 | static_cast<std::uint64_t>(scope);
    return ((keyHash ^ kind) * 0x9e3779b97f4a7c15ull) | 1;
}

/// One thread's place in a recording. All functions: only by the thread that holds it.
///
/// Values go to one log, in call order, each behind its tag: a single stream of writes. What is common (a known column,
/// an open vertex, room in the log) is inline, everything else one call away.
class Cursor {
  public:
    void setPixel(Pixel pixel);
    void clearPixel();
    void setPathIndex(std::int64_t sample, std::int32_t part);
    void endPath();
    void setPathOrigin(Vec3f origin);
    void setFinalEstimate(Color estimate);
    void addSplat(Pixel pixel, Color value);

    void setDepthIndex(std::int32_t depth, Subpath subpath);
    void setPosition(Vec3f position) {
        vertexFlags_ |= VertexFlag::hasPosition;
        add(LogTag::position, position);
    }
    void setEnvironmentPosition(Vec3f position);
    void addNextEvent(Vec3f position, bool visible) { add(LogTag::nextEvent, position, visible ? 1u : 0u); }
    void setSurface(std::int32_t mesh, std::int32_t face) { add(LogTag::surface, SurfaceValue{mesh, face}); }
    void setEvent(Event event, Lobe lobe, std::string_view label) { if (wants(LogTag::event)) recordEvent(event, lobe, label); }
    void setEstimate(Color estimate) { add(LogTag::estimate, estimate); }
    void setEmission(Color emission) { add(LogTag::emission, emission); }
    void addContribution(Color value, std::string_view technique, float misWeight, LightEnd end) {
        if (wants(LogTag::contribution)) recordContribution(value, technique, misWeight, end);
    }

    /// False if nobody asked for any user data, so that values need not even be computed.
    bool wantsUserData() const { return wantsUserData_; }

    /// T: one of the stored types of recordable.h.
    template <typename T>
    void addPathData(Key key, T value);
    template <typename T>
    void addVertexData(Key key, T value) {
        if constexpr (kFixedSize<T>) {
            const std::uint64_t id = columnId(key.hash(), Scope::vertex, storedType<T>());
            FastColumn& column = fastColumns_[id >> kFastShift];
            if (column.id == id && hasRoom(sizeof(T))) [[likely]] {
                if (column.tag == LogTag::ignored) return;
                ++column.count;
                return put(column.tag, value);
            }
        }
        addVertexDataSlowly(key.text(), key.hash(), key.where(), value);
    }

  protected:
    /// Where a user column is found by its id alone. One that finds its place taken goes the slow way.
    struct FastColumn {
        std::uint64_t id = 0;
        std::uint32_t count = 0;  ///< values that were added here
        std::uint16_t tag = LogTag::ignored;
    };
    static constexpr int kFastShift = 64 - 8;

    bool wants(std::uint16_t coreTag) const { return (wanted_ >> coreTag & 1) != 0; }
    void recordEvent(Event event, Lobe lobe, std::string_view label);
    void recordContribution(Color value, std::string_view technique, float misWeight, LightEnd end);

    Cursor() = default;
    ~Cursor() = default;
    Cursor(const Cursor&) = delete;
    Cursor& operator=(const Cursor&) = delete;

    template <typename T>
    static constexpr bool kFixedSize = storedType<T>() != ValueType::text && storedType<T>() != ValueType::spectrum;

    /// Room for a tag and `bytes` more, with a vertex open.
    bool hasRoom(std::size_t bytes) const {
        // As numbers, since a closed vertex has no limit.
        const auto left = reinterpret_cast<std::uintptr_t>(limit_) - reinterpret_cast<std::uintptr_t>(next_);
        return static_cast<std::intptr_t>(left) >= static_cast<std::intptr_t>(sizeof(std::uint16_t) + bytes);
    }
    /// Values one by one: to put them together first costs more than to store them.
    template <typename... T>
    void put(std::uint16_t tag, const T&... values) {
        std::byte* at = next_;
        std::memcpy(at, &tag, sizeof tag);
        at += sizeof tag;
        ((std::memcpy(at, &values, sizeof values), at += sizeof values), ...);
        next_ = at;
    }
    template <typename... T>
    void add(std::uint16_t tag, const T&... values) {
        if (hasRoom((sizeof values + ...))) [[likely]] {
            if (!wants(tag)) return;
            ++coreCounts_[tag];
            return put(tag, values...);
        }
        if (makeRoom(tag, (sizeof values + ...))) put(tag, values...);
    }
    /// What add() could not do: no vertex is open, or this part of the log is full. True if there is room now.
    bool makeRoom(std::uint16_t tag, std::size_t bytes);
    // Keys in parts, which travel in registers.
    template <typename T>
    void addVertexDataSlowly(std::string_view key, std::uint64_t hash, SourceLine where, T value);

    std::byte* next_ = nullptr;   ///< of the log
    std::byte* limit_ = nullptr;  ///< where the log has no more room; nullptr if no vertex is open
    std::uint32_t wanted_ = 0;    ///< bit per tag: core quantities that somebody asked for
    bool wantsUserData_ = true;
    std::uint8_t vertexFlags_ = 0;///< VertexFlag of the open vertex, as far as the recording itself needs them
    std::uint32_t coreCounts_[LogTag::firstUser] = {};
    FastColumn fastColumns_[std::size_t(1) << (64 - kFastShift)];
};

}  // namespace emca::detail
