#pragma once

#include <cstddef>
#include <memory>

namespace emca::detail {

struct FreeSlab {
    std::size_t bytes = 0;
    void operator()(std::byte* slab) const;
};
using Slab = std::unique_ptr<std::byte, FreeSlab>;

/// Memory straight from the system, page-aligned and already backed: touching it page by page costs several times as
/// much as asking for all of it at once. It may be up to twice as large as asked for; nullptr if the system has none.
/// Freed slabs are kept for the next recording, of whatever thread: 8 MiB at most in the whole process.
Slab allocateSlab(std::size_t bytes);
/// Gives what is kept back to the system.
void releaseKeptSlabs();

}  // namespace emca::detail
