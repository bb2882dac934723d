#pragma once

#include <cstddef>
#include <memory>

namespace emca::detail {

struct FreeSlab {
    std::size_t bytes = 0;
    void operator()(std::byte* slab) const;
};
/// Its deleter knows its size.
using Slab = std::unique_ptr<std::byte, FreeSlab>;

/// Memory of recordings and of their results, 64-byte aligned, rounded up to pieces of 64 KiB; nullptr if the system
/// has none. Any thread. Pieces are cut from blocks of 2 MiB, one huge page each where the system has them: a fresh
/// page of 4 KiB costs as much as recording 7 intersections. What is freed serves later recordings of any thread; of
/// blocks that nobody uses, the process keeps 8 MiB.
Slab allocateSlab(std::size_t bytes);
/// Gives the blocks that nobody uses back to the system.
void releaseKeptSlabs();

}  // namespace emca::detail
