#include "record_log.h"

#include <algorithm>

namespace emca::detail {
namespace {

std::size_t wholePages(std::size_t bytes) {
    return (bytes + PagePool::kPageBytes - 1) / PagePool::kPageBytes * PagePool::kPageBytes;
}

}  // namespace

/// The budget pays page by page, although the system gives whole chunks: what is never touched is no use to anybody.
bool RecordLog::grant(Chunk& chunk, std::size_t bytes) {
    if (bytes <= chunk.granted) return true;
    const std::size_t more = wholePages(bytes - chunk.granted);
    if (!budget_.take(more)) return false;
    chunk.granted += more;
    return true;
}

bool RecordLog::grow(std::size_t bytes, std::byte*& next, std::byte*& end) {
    if (bytes > kLongestRecord) return false;
    std::uint32_t following = 0;
    if (!chunks_.empty()) {
        Chunk& open = chunks_[current_];
        open.used = static_cast<std::size_t>(next - open.memory.get());
        if (open.bytes - open.used >= bytes) {
            if (!grant(open, open.used + bytes)) return false;
            end = open.memory.get() + open.granted;
            return true;
        }
        following = current_ + 1;
    }
    if (following == chunks_.size() || chunks_[following].bytes < bytes) {
        // Small at first: most recordings are one pixel with few samples.
        const std::size_t usual = (chunks_.size() < 2 ? 16 : 64) * PagePool::kPageBytes;
        Chunk chunk;
        chunk.bytes = std::max(usual, wholePages(bytes));
        if (!grant(chunk, bytes)) return false;
        chunk.memory = allocateSlab(chunk.bytes);
        if (!chunk.memory) {
            budget_.giveBack(chunk.granted);
            return false;
        }
        chunk.bytes = chunk.memory.get_deleter().bytes;
        chunks_.insert(chunks_.begin() + following, std::move(chunk));
    } else if (!grant(chunks_[following], bytes)) {
        return false;
    }
    current_ = following;
    next = chunks_[current_].memory.get();
    end = next + chunks_[current_].granted;
    return true;
}

void RecordLog::rewind(LogPosition position, std::byte*& next, std::byte*& end) {
    if (chunks_.empty()) return;
    current_ = position.chunk;
    next = chunks_[current_].memory.get() + position.offset;
    end = chunks_[current_].memory.get() + chunks_[current_].granted;
}

}  // namespace emca::detail
