#include "slab.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <mutex>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace emca::detail {
namespace {

constexpr std::size_t kPieceBytes = 64u << 10, kBlockBytes = 2u << 20;
constexpr int kPieces = kBlockBytes / kPieceBytes;
constexpr std::size_t kKeptBlocks = 4;
static_assert(kPieces == 32, "a block's pieces are the bits of one number");

/// `bytes` at a multiple of a block, not yet backed by memory; nullptr if there is no room.
std::byte* reserve(std::size_t bytes) {
#ifdef __linux__
    void* memory =
        mmap(nullptr, bytes + kBlockBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) return nullptr;
    auto* const begin = static_cast<std::byte*>(memory);
    const std::size_t before = (kBlockBytes - reinterpret_cast<std::uintptr_t>(begin) % kBlockBytes) % kBlockBytes;
    if (before > 0) munmap(begin, before);
    if (before < kBlockBytes) munmap(begin + before + bytes, kBlockBytes - before);
    madvise(begin + before, bytes, MADV_HUGEPAGE);
    return begin + before;
#else
    return static_cast<std::byte*>(::operator new(bytes, std::align_val_t(kBlockBytes), std::nothrow));
#endif
}

/// Has the system back these bytes at once: without huge pages, touching them page by page costs a fifth more. Where
/// the system cannot, they are backed when touched.
void back([[maybe_unused]] std::byte* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_POPULATE_WRITE)
    madvise(memory, bytes, MADV_POPULATE_WRITE);
#endif
}

void giveBack(std::byte* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    munmap(memory, bytes);
#else
    ::operator delete(memory, std::align_val_t(kBlockBytes));
#endif
}

/// The blocks of this process, and which of their pieces are in use.
class BlockPool {
  public:
    std::byte* take(std::size_t pieces) {
        const std::lock_guard lock(mutex_);
        const std::uint32_t wanted = pieces == kPieces ? ~0u : (1u << pieces) - 1;
        for (Block& block : blocks_)
            for (std::uint32_t free = ~block.used; free != 0;) {
                const int first = std::countr_zero(free);
                if (first + static_cast<int>(pieces) > kPieces) break;
                if ((block.used & wanted << first) == 0) return use(block, first, wanted << first);
                // On to what is free behind the next piece in use.
                const int next = std::countr_zero(block.used & ~0u << first);
                free = ~block.used & ~0u << next;
            }
        Block block{reserve(kBlockBytes)};
        if (!block.memory) return nullptr;
        blocks_.push_back(block);
        return use(blocks_.back(), 0, wanted);
    }

    void free(std::byte* slab, std::size_t pieces) {
        const std::lock_guard lock(mutex_);
        const auto offset = reinterpret_cast<std::uintptr_t>(slab) % kBlockBytes;
        const auto block =
            std::find_if(blocks_.begin(), blocks_.end(), [&](const Block& b) { return b.memory == slab - offset; });
        const std::uint32_t mask = pieces == kPieces ? ~0u : (1u << pieces) - 1;
        block->used &= ~(mask << offset / kPieceBytes);
        if (block->used == 0) keepAtMost(kKeptBlocks);
    }

    void release() {
        const std::lock_guard lock(mutex_);
        keepAtMost(0);
    }

  private:
    struct Block {
        std::byte* memory;
        std::uint32_t used = 0;    ///< bit per piece
        std::uint32_t backed = 0;  ///< pieces that were in use once
    };

    static std::byte* use(Block& block, int first, std::uint32_t mask) {
        block.used |= mask;
        std::byte* const slab = block.memory + static_cast<std::size_t>(first) * kPieceBytes;
        if ((block.backed & mask) != mask) back(slab, static_cast<std::size_t>(std::popcount(mask)) * kPieceBytes);
        block.backed |= mask;
        return slab;
    }

    void keepAtMost(std::size_t blocks) {
        std::size_t unused = 0;
        std::erase_if(blocks_, [&](const Block& block) {
            if (block.used != 0 || ++unused <= blocks) return false;
            giveBack(block.memory, kBlockBytes);
            return true;
        });
    }

    std::mutex mutex_;
    std::vector<Block> blocks_;
};

/// Lives as long as the process: a result may be destroyed after all static objects.
BlockPool& blockPool() {
    static auto& pool = *new BlockPool;
    return pool;
}

}  // namespace

void FreeSlab::operator()(std::byte* slab) const {
    if (bytes <= kBlockBytes)
        blockPool().free(slab, bytes / kPieceBytes);
    else
        giveBack(slab, bytes);
}

Slab allocateSlab(std::size_t bytes) {
    const std::size_t pieces = std::max<std::size_t>(1, (bytes + kPieceBytes - 1) / kPieceBytes);
    bytes = pieces * kPieceBytes;
    if (bytes <= kBlockBytes) return Slab(blockPool().take(pieces), FreeSlab{bytes});
    std::byte* memory = reserve(bytes);
    if (memory) back(memory, bytes);
    return Slab(memory, FreeSlab{bytes});
}

void releaseKeptSlabs() { blockPool().release(); }

}  // namespace emca::detail
