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
/// much as asking for all of it at once. Recently freed slabs are kept for the next recording, a few megabytes at most.
/// Throws std::bad_alloc.
Slab allocateSlab(std::size_t bytes);

}  // namespace emca::detail
