#include "slab.h"

#include <mutex>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace emca::detail {
namespace {

constexpr std::size_t kAlignment = 4096;
constexpr std::size_t kKeptBytes = 8u << 20;

std::byte* fromSystem(std::size_t bytes) {
#ifdef __linux__
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
    return memory == MAP_FAILED ? nullptr : static_cast<std::byte*>(memory);
#else
    return static_cast<std::byte*>(::operator new(bytes, std::align_val_t(kAlignment), std::nothrow));
#endif
}

void toSystem(std::byte* slab, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
    munmap(slab, bytes);
#else
    ::operator delete(slab, std::align_val_t(kAlignment));
#endif
}

/// Slabs of the last recordings: a person clicks pixel after pixel.
class KeptSlabs {
  public:
    ~KeptSlabs() { release(); }
    void release() {
        const std::lock_guard lock(mutex_);
        for (const auto& [slab, bytes] : slabs_) toSystem(slab, bytes);
        slabs_.clear();
        kept_ = 0;
    }
    /// The smallest that is large enough and not twice too large.
    Slab take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        auto best = slabs_.end();
        for (auto it = slabs_.begin(); it != slabs_.end(); ++it)
            if (it->second >= bytes && it->second / 2 <= bytes && (best == slabs_.end() || it->second < best->second)) best = it;
        if (best == slabs_.end()) return nullptr;
        Slab slab(best->first, FreeSlab{best->second});
        kept_ -= best->second;
        *best = slabs_.back();
        slabs_.pop_back();
        return slab;
    }
    bool keep(std::byte* slab, std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        if (kept_ + bytes > kKeptBytes) return false;
        slabs_.emplace_back(slab, bytes);
        kept_ += bytes;
        return true;
    }

  private:
    std::mutex mutex_;
    std::vector<std::pair<std::byte*, std::size_t>> slabs_;
    std::size_t kept_ = 0;
};

KeptSlabs& keptSlabs() {
    static KeptSlabs slabs;
    return slabs;
}

}  // namespace

void FreeSlab::operator()(std::byte* slab) const {
    if (!keptSlabs().keep(slab, bytes)) toSystem(slab, bytes);
}

Slab allocateSlab(std::size_t bytes) {
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    if (Slab kept = keptSlabs().take(bytes)) return kept;
    return Slab(fromSystem(bytes), FreeSlab{bytes});
}

void releaseKeptSlabs() { keptSlabs().release(); }

}  // namespace emca::detail
