#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pages.h"
#include "slab.h"

namespace emca::detail {

/// A place between two records of a log.
struct LogPosition {
    std::uint32_t chunk = 0, offset = 0;
};

/// The memory of one thread's log: chunks of records, none of which crosses from one into the next. Who writes holds
/// the pointers `next` and `end` himself, since that is what each record changes.
class RecordLog {
  public:
    /// Longer records do not fit.
    static constexpr std::size_t kLongestRecord = std::size_t(1) << 30;

    explicit RecordLog(Budget& budget) : budget_(budget) {}

    /// Makes room for `bytes` at `next`, which moves if this chunk is full. False, and nothing changed, if the budget
    /// or the system's memory is used up.
    bool grow(std::size_t bytes, std::byte*& next, std::byte*& end);

    LogPosition position(const std::byte* next) const {
        if (chunks_.empty()) return {};
        return {current_, static_cast<std::uint32_t>(next - chunks_[current_].memory.get())};
    }
    /// Forgets the records from `position` on; their memory stays for those to come.
    void rewind(LogPosition position, std::byte*& next, std::byte*& end);
    /// Calls visit(begin, end) for the records between two positions, chunk by chunk.
    template <typename Visit>
    void read(LogPosition from, LogPosition to, Visit&& visit) const {
        for (std::uint32_t c = from.chunk; c <= to.chunk && c < chunks_.size(); ++c) {
            const std::byte* memory = chunks_[c].memory.get();
            const std::size_t first = c == from.chunk ? from.offset : 0,
                              last = c == to.chunk ? to.offset : chunks_[c].used;
            if (first < last) visit(memory + first, memory + last);
        }
    }

  private:
    struct Chunk {
        Slab memory;
        std::size_t bytes = 0;    ///< multiple of a page
        std::size_t granted = 0;  ///< of them, what the budget was asked for
        std::size_t used = 0;     ///< of chunks before the current one
    };
    bool grant(Chunk& chunk, std::size_t bytes);

    Budget& budget_;
    std::vector<Chunk> chunks_;
    std::uint32_t current_ = 0;
};

}  // namespace emca::detail
