#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "emca/recorder/cursor.h"
#include "emca/recorder/recording.h"
#include "page_column.h"

namespace emca::detail {

/// Core quantities as bits, for the choice of columns.
struct Core {
    enum : std::uint32_t {
        origin = 1, estimate = 2, position = 4, nextEvent = 8, vertexEstimate = 16, emission = 32, surface = 64,
        event = 128, contribution = 256, splat = 512, all = 1023,
    };
};

/// Which columns a request wants; shared by all cursors of a recording, read-only.
struct ColumnChoice {
    explicit ColumnChoice(const std::vector<std::string>& names);
    bool wantsKey(std::string_view key) const;
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
    Index firstVertex = 0;  ///< local; the path's vertices end where the next path's begin
    bool hasPixel = false;
    bool keptBySplat = false;
    bool byHandle = false;  ///< others may add to it until the end: only then is it decided whether it stays
    std::uint8_t flags = 0;
    Vec3f origin;
    Color estimate;
};

struct VertexRow {
    std::int32_t depth;
    std::uint8_t flags;  ///< VertexFlag
    Vec3f position;
};

struct SurfaceValue { std::int32_t mesh, face; };
struct EventValue { std::uint32_t label; Event event; Lobe lobe; };

/// A user column of one thread.
struct KeyedColumn {
    KeyedColumn(const Key& key, Scope s, ValueType t, bool w, std::uint32_t bytes)
        : hash(key.hash()), scope(s), type(t), wanted(w), name(key.text()), values(bytes) {}
    std::uint64_t hash;
    Scope scope;
    ValueType type;
    bool wanted;
    std::string name;
    PageColumn values;                          ///< spectra: position and length in `floats`
    std::vector<float> floats;                  ///< spectra only
    std::vector<std::source_location> locations;///< only where asked for
    KeyedColumn* next = nullptr;                ///< the one that was used after this the last time
};

struct SpectrumSpan { std::uint32_t first, size; };

/// Strings of one thread, each once.
class Interner {
  public:
    /// Index of the text, new or known; kNoString if it is new and the budget has no room for it.
    std::uint32_t add(std::string_view text, Budget& budget);
    const std::vector<std::string>& strings() const { return strings_; }

  private:
    std::uint32_t find(std::string_view text, Budget& budget);
    void rehash(std::size_t slots);
    /// Texts that came lately, by where they lie: a renderer says the same literals and names again and again.
    struct Recent {
        const char* data = nullptr;
        std::size_t size = 0;
        std::uint32_t index = 0;
    };
    Recent recent_[16];
    std::vector<std::string> strings_;
    std::vector<std::uint32_t> slots_;  ///< open addressing; kNoString marks a free slot
    std::vector<std::uint64_t> hashes_;
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
    void forgetPath();
    void dropWithoutPath() { ++(starved_ ? stats_.droppedByBudget : stats_.droppedWithoutPath); }
    void dropWithoutVertex() { ++(starved_ ? stats_.droppedByBudget : stats_.droppedWithoutVertex); }
    template <typename T>
    void appendCore(PageColumn& column, std::uint32_t bit, const T& value);
    template <typename T>
    void append(const Key& key, Scope scope, Index owner, Index base, const T& value);
    KeyedColumn& column(const Key& key, Scope scope, ValueType type, std::uint32_t bytes);
    KeyedColumn& findColumn(const Key& key, Scope scope, ValueType type, std::uint32_t bytes);
    bool charge(std::size_t bytes);
    VertexRow& vertex() { return vertices_[vertex_]; }

    RecordingShared& shared_;
    PagePool pool_;
    RecordingStats stats_;

    Pixel pixel_;
    bool hasPixel_ = false;
    bool inPath_ = false;
    bool starved_ = false;  ///< the budget left no room for the current path or vertex itself
    bool byHandle_ = false;
    Index path_ = kNone, vertex_ = kNone;
    std::int32_t deepest_[2] = {};   ///< per subpath, of the current path
    bool anyVertex_[2] = {};

    PageRows<PathRow> paths_;
    PageRows<VertexRow> vertices_;
    PageColumn nextEvents_{sizeof(NextEvent)}, estimates_{sizeof(Color)}, emissions_{sizeof(Color)},
        surfaces_{sizeof(SurfaceValue)}, events_{sizeof(EventValue)}, contributions_{sizeof(Contribution)},
        splats_{sizeof(Splat)};
    std::vector<std::unique_ptr<KeyedColumn>> columns_;
    std::vector<std::uint32_t> table_;  ///< open addressing over columns_
    KeyedColumn* lastColumn_ = nullptr;
    Interner strings_;
};

}  // namespace emca::detail
