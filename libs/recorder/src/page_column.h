#pragma once

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "emca/core/path_set.h"

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

/// Memory in pages, for one thread. A page is small, so that a column wastes little; pages are cut from slabs, so that
/// few allocations happen.
class PagePool {
  public:
    static constexpr std::size_t kPageBytes = 4096;
    explicit PagePool(Budget& budget) : budget_(budget) {}

    /// 64-byte aligned; nullptr when the budget is used up.
    std::byte* take() {
        if (!budget_.take(kPageBytes)) return nullptr;
        if (next_ == end_) {
            // Small at first: most recordings are one pixel with few samples.
            const std::size_t bytes = slabs_.size() < 2 ? 16 * kPageBytes : 128 * kPageBytes;
            slabs_.emplace_back(static_cast<std::byte*>(::operator new(bytes, std::align_val_t(64))));
            next_ = slabs_.back().get();
            end_ = next_ + bytes;
        }
        std::byte* page = next_;
        next_ += kPageBytes;
        return page;
    }

  private:
    struct Free {
        void operator()(std::byte* slab) const { ::operator delete(slab, std::align_val_t(64)); }
    };
    Budget& budget_;
    std::vector<std::unique_ptr<std::byte, Free>> slabs_;
    std::byte* next_ = nullptr;
    std::byte* end_ = nullptr;
};

/// Append-only values of one size with their owners. An owner costs two bytes: its distance from the page's first.
/// Owners are local indices of the cursor and never fall below those of the current path's beginning.
class PageColumn {
  public:
    explicit PageColumn(std::uint32_t valueBytes) : valueBytes_(valueBytes) {
        capacity_ = static_cast<std::uint32_t>((PagePool::kPageBytes - sizeof(Page) - kValueAlign) / (valueBytes + sizeof(std::uint16_t)));
    }

    /// Room for one value, or nullptr if the budget is used up. `base`: the smallest owner that may still come.
    std::byte* append(Index owner, Index base, PagePool& pool) {
        Page* page = last_;
        if (!page || page->count == capacity_ || owner - page->base > 0xffffu) [[unlikely]] {
            page = grow(owner - base > 0xffffu ? owner : base, pool);
            if (!page) return nullptr;
        }
        const std::uint32_t i = page->count++;
        owners(page)[i] = static_cast<std::uint16_t>(owner - page->base);
        ++size_;
        return values(page) + std::size_t(i) * valueBytes_;
    }

    std::size_t size() const { return size_; }
    /// The last value, or nullptr if there is none.
    const std::byte* last() const {
        return size_ == 0 ? nullptr : values(last_) + std::size_t(last_->count - 1) * valueBytes_;
    }
    std::uint32_t valueBytes() const { return valueBytes_; }

    /// Forgets values at the end whose owner is `first` or later: an abandoned path.
    void dropFrom(Index first) {
        while (!pages_.empty()) {
            Page* page = pages_.back();
            while (page->count > 0 && page->base + owners(page)[page->count - 1] >= first) {
                --page->count;
                --size_;
            }
            // An emptied page stays for what comes next, unless its base lies behind.
            if (page->count > 0 || pages_.size() == 1) {
                if (page->count == 0) page->base = first;
                break;
            }
            spare_.push_back(page);
            pages_.pop_back();
        }
        last_ = pages_.empty() ? nullptr : pages_.back();
    }

    /// Calls visit(owner, value) in call order.
    template <typename Visit>
    void forEach(Visit&& visit) const {
        for (Page* page : pages_)
            for (std::uint32_t i = 0; i < page->count; ++i)
                visit(page->base + owners(page)[i], static_cast<const std::byte*>(values(page) + std::size_t(i) * valueBytes_));
    }

  private:
    static constexpr std::size_t kValueAlign = 8;
    struct Page {
        Index base;
        std::uint32_t count;
    };
    std::uint16_t* owners(Page* page) const {
        return reinterpret_cast<std::uint16_t*>(reinterpret_cast<std::byte*>(page) + PagePool::kPageBytes) - capacity_;
    }
    static std::byte* values(Page* page) { return reinterpret_cast<std::byte*>(page + 1); }

    Page* grow(Index base, PagePool& pool) {
        std::byte* memory;
        if (!spare_.empty()) {
            memory = reinterpret_cast<std::byte*>(spare_.back());
            spare_.pop_back();
        } else {
            memory = pool.take();
        }
        if (!memory) return nullptr;
        last_ = new (memory) Page{base, 0};
        pages_.push_back(last_);
        return last_;
    }

    std::uint32_t valueBytes_, capacity_;
    Page* last_ = nullptr;
    std::size_t size_ = 0;
    std::vector<Page*> pages_, spare_;
};

}  // namespace emca::detail
