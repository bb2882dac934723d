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
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return static_cast<std::byte*>(memory);
#else
    return static_cast<std::byte*>(::operator new(bytes, std::align_val_t(kAlignment)));
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
    ~KeptSlabs() {
        for (const auto& [slab, bytes] : slabs_) toSystem(slab, bytes);
    }
    std::byte* take(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        for (auto& entry : slabs_) {
            if (entry.second != bytes) continue;
            std::byte* slab = entry.first;
            entry = slabs_.back();
            slabs_.pop_back();
            kept_ -= bytes;
            return slab;
        }
        return nullptr;
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
    std::byte* slab = keptSlabs().take(bytes);
    return Slab(slab ? slab : fromSystem(bytes), FreeSlab{bytes});
}

}  // namespace emca::detail
