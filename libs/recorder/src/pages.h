#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "emca/core/path_set.h"
#include "slab.h"

namespace emca::detail {

/// Bytes that a whole recording may still take.
class Budget {
  public:
    explicit Budget(std::size_t bytes) : left_(bytes), all_(bytes) {}
    bool take(std::size_t bytes) {
        std::size_t left = left_.load(std::memory_order_relaxed);
        while (left >= bytes)
            if (left_.compare_exchange_weak(left, left - bytes, std::memory_order_relaxed)) return true;
        return false;
    }
    void giveBack(std::size_t bytes) { left_.fetch_add(bytes, std::memory_order_relaxed); }
    std::size_t taken() const { return all_ - left_.load(std::memory_order_relaxed); }

  private:
    std::atomic<std::size_t> left_;
    std::size_t all_;
};

/// Memory in pages, for one thread. Pages are cut from slabs, so that the system is asked seldom.
class PagePool {
  public:
    static constexpr std::size_t kPageBytes = 4096;
    static constexpr std::size_t kSlabBytes = 16 * kPageBytes;
    explicit PagePool(Budget& budget) : budget_(budget) {}

    /// 64-byte aligned; nullptr when the budget, or the system's memory, is used up.
    std::byte* take() {
        if (!budget_.take(kPageBytes)) return nullptr;
        if (next_ == end_) {
            Slab slab = allocateSlab(kSlabBytes);
            if (!slab) {
                budget_.giveBack(kPageBytes);
                return nullptr;
            }
            next_ = slab.get();
            end_ = next_ + slab.get_deleter().bytes;
            slabs_.push_back(std::move(slab));
        }
        std::byte* page = next_;
        next_ += kPageBytes;
        return page;
    }

  private:
    Budget& budget_;
    std::vector<Slab> slabs_;
    std::byte* next_ = nullptr;
    std::byte* end_ = nullptr;
};

/// Rows that are read and written at any index, in pages. T is trivially copyable.
template <typename T>
class PageRows {
  public:
    T& operator[](Index i) { return reinterpret_cast<T*>(pages_[i / kPerPage])[i % kPerPage]; }
    const T& operator[](Index i) const { return reinterpret_cast<const T*>(pages_[i / kPerPage])[i % kPerPage]; }
    Index size() const { return size_; }
    /// The new row, not initialised, or nullptr if the budget is used up.
    T* append(PagePool& pool) {
        if (size_ == pages_.size() * kPerPage) [[unlikely]] {
            std::byte* page = pool.take();
            if (!page) return nullptr;
            pages_.push_back(page);
        }
        return &(*this)[size_++];
    }
    /// Forgets the rows from `size` on; their pages stay for those to come.
    void shrink(Index size) { size_ = size; }

  private:
    static constexpr Index kPerPage = static_cast<Index>(PagePool::kPageBytes / sizeof(T));
    std::vector<std::byte*> pages_;
    Index size_ = 0;
};

}  // namespace emca::detail
