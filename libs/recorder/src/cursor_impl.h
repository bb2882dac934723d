#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emca/recorder/cursor.h"
#include "emca/recorder/recording.h"
#include "interner.h"
#include "pages.h"
#include "record_log.h"

namespace emca::detail {

/// Core quantities as bits, for the choice of columns: those of a log by their tags, and two that paths have.
struct Core {
    enum : std::uint32_t {
        origin = 1u << 30, estimate = 1u << 31, all = 0xffffffffu,
    };
};
static_assert(LogTag::firstUser < 30);

/// Which columns a request wants; shared by all cursors of a recording, read-only.
struct ColumnChoice {
    explicit ColumnChoice(const std::vector<std::string>& names);
    bool wantsKey(std::string_view key) const;
    bool wantsUserData() const { return all || !keys.empty(); }
    bool wantsCore(std::uint32_t bit) const { return (core & bit) != 0; }
    std::uint32_t core = Core::all;
    bool all = true;
    std::vector<std::string> keys;
};

/// What the cursors of one recording share.
struct RecordingShared {
    explicit RecordingShared(RecordingOptions o);
    bool asksFor(Pixel pixel) const;
    bool keeps(const struct PathRow& path) const;
    RecordingOptions options;
    ColumnChoice choice;
    Budget budget;
};

struct PathRow {
    Pixel pixel;
    std::int64_t sample = 0;
    std::int32_t part = 0;
    LogPosition begin;          ///< of the path's records, which end where the next path's begin
    Index vertices = 0;         ///< counted at the path's end
    Vec3f origin;
    Color estimate;
    bool hasPixel = false;
    bool keptBySplat = false;
    bool byHandle = false;      ///< others may add to it until the end: only then is it decided whether it stays
    bool ordered = true;        ///< its vertices were begun in the order of the result
    std::uint8_t flags = 0;     ///< PathFlag
};

/// What a Key says.
struct KeyParts {
    std::string_view text;
    std::uint64_t hash;
    SourceLine where;
};

/// A user column of one thread.
struct UserColumn {
    std::uint64_t hash;         ///< of the key
    Scope scope;
    ValueType type;
    bool wanted;
    std::string name;
    std::uint32_t count = 0;    ///< values, besides those that FastColumn counted
};

class CursorImpl final : public Cursor {
  public:
    explicit CursorImpl(RecordingShared& shared);

    void endScope() { endPath(); starved_ = false; }
    /// For handles: makes that path, or vertex, the current one.
    void select(Pixel pixel, std::int64_t sample, std::int32_t part);
    void select(Pixel pixel, std::int64_t sample, std::int32_t part, std::int32_t depth, Subpath subpath);

  private:
    friend class Cursor;
    friend class Assembler;
    static constexpr Index kNone = 0xffffffffu;

    void startVertex(std::int32_t depth, Subpath subpath);
    void finishVertex();
    void openVertex(Index vertex);
    bool keeps(const PathRow& path);
    void forgetPath();
    void dropWithoutPath() { ++(starved_ ? stats_.droppedByBudget : stats_.droppedWithoutPath); }
    void dropWithoutVertex() { ++(starved_ ? stats_.droppedByBudget : stats_.droppedWithoutVertex); }
    /// Room for `bytes` at next_, or false, counted.
    bool reserve(std::size_t bytes);
    template <typename T>
    void append(const KeyParts& key, Scope scope, const T& value);
    std::uint32_t findColumn(const KeyParts& key, Scope scope, ValueType type);
    std::uint32_t addColumn(const KeyParts& key, Scope scope, ValueType type);
    std::uint32_t countOf(std::uint32_t column) const;
    template <typename Visit>
    void readRecords(LogPosition from, LogPosition to, Visit&& visit) const;
    LogPosition logEnd() const { return log_.position(next_); }

    RecordingShared& shared_;
    PagePool pool_;
    RecordingStats stats_;

    Pixel pixel_;
    std::optional<Pixel> keptPixel_;  ///< is asked for
    bool hasPixel_ = false;
    bool inPath_ = false;
    bool starved_ = false;  ///< the budget left no room for the current path or vertex itself
    bool byHandle_ = false;
    Index path_ = kNone;
    Index vertex_ = kNone;  ///< place in `visited_`; limit_ is set while there is one
    struct Visited {
        std::int32_t depth;
        std::uint8_t flags;  ///< VertexFlag, as vertexFlags_
    };
    std::vector<Visited> visited_;  ///< the current path's vertices
    static constexpr std::int64_t kNoDepth = std::numeric_limits<std::int64_t>::min();
    std::int64_t deepest_[2] = {};  ///< of the current path, per subpath
    bool ordered_ = true;           ///< its vertices were begun in the order of the result

    std::byte* end_ = nullptr;      ///< of the room behind next_
    RecordLog log_;
    PageRows<PathRow> paths_;
    std::vector<UserColumn> columns_;
    std::vector<std::uint32_t> table_;  ///< open addressing over columns_
    Interner strings_;
};

/// Reads what the log holds, once more: visit(tag, value), where a user column's tag is its number behind firstUser.
template <typename Visit>
void CursorImpl::readRecords(LogPosition from, LogPosition to, Visit&& visit) const {
    constexpr std::size_t kCoreBytes[] = {
        0, sizeof(std::int32_t), sizeof(std::int32_t), sizeof(Index), 0,
        sizeof(Vec3f), sizeof(NextEvent), sizeof(Color), sizeof(Color), sizeof(SurfaceValue), sizeof(EventValue),
        sizeof(Contribution), sizeof(Splat), 0};
    static_assert(std::size(kCoreBytes) == LogTag::firstUser);
    const std::size_t place = shared_.options.locations ? sizeof(SourceLine) : 0;
    log_.read(from, to, [&](const std::byte* at, const std::byte* end) {
        while (at < end) {
            std::uint16_t shortTag;
            std::memcpy(&shortTag, at, sizeof shortTag);
            at += sizeof shortTag;
            std::uint32_t tag = shortTag;
            if (tag == LogTag::wide) {
                std::memcpy(&tag, at, sizeof tag);
                tag += LogTag::firstUser;
                at += sizeof tag;
            }
            std::size_t bytes;
            if (tag < LogTag::firstUser) {
                bytes = kCoreBytes[tag];
            } else if (const ValueType type = columns_[tag - LogTag::firstUser].type; type != ValueType::spectrum) {
                bytes = byteSize(type) + place;
            } else {
                std::uint32_t entries;
                std::memcpy(&entries, at, sizeof entries);
                bytes = sizeof entries + std::size_t(entries) * sizeof(float) + place;
            }
            visit(tag, at);
            at += bytes;
        }
    });
}

}  // namespace emca::detail
