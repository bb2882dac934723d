#pragma once

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

/// Memory in pages, for one thread. A page is small, so that a column wastes little; pages are cut from slabs, so that
/// the system is asked seldom.
class PagePool {
  public:
    static constexpr std::size_t kPageBytes = 4096;
    explicit PagePool(Budget& budget) : budget_(budget) {}

    /// 64-byte aligned; nullptr when the budget is used up.
    std::byte* take() {
        if (!budget_.take(kPageBytes)) return nullptr;
        if (next_ == end_) {
            // Small at first: most recordings are one pixel with few samples.
            const std::size_t bytes = (slabs_.size() < 2 ? 16 : 64) * kPageBytes;
            slabs_.push_back(allocateSlab(bytes));
            next_ = slabs_.back().get();
            end_ = next_ + bytes;
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

/// Append-only values of one size with their owners. An owner costs two bytes: its distance from the page's first.
/// Owners are local indices of the cursor and never fall below those of the current path's beginning.
class PageColumn {
  public:
    explicit PageColumn(std::uint32_t valueBytes) : valueBytes_(valueBytes) {
        capacity_ = static_cast<std::uint32_t>((PagePool::kPageBytes - sizeof(Page)) / (valueBytes + sizeof(std::uint16_t)));
        count_ = capacity_;
    }

    /// Room for one value, or nullptr if the budget is used up. `base`: the smallest owner that may still come.
    std::byte* append(Index owner, Index base, PagePool& pool) {
        if (count_ == capacity_ || owner - base_ > 0xffffu) [[unlikely]] {
            if (!grow(owner - base > 0xffffu ? owner : base, pool)) return nullptr;
        }
        const std::uint32_t i = count_++;
        owners_[i] = static_cast<std::uint16_t>(owner - base_);
        return values_ + std::size_t(i) * valueBytes_;
    }

    std::size_t size() const { return before_ + (pages_.empty() ? 0 : count_); }
    /// The last value, or nullptr if there is none.
    const std::byte* last() const {
        return size() == 0 ? nullptr : values_ + std::size_t(count_ - 1) * valueBytes_;
    }

    /// Forgets values at the end whose owner is `first` or later: an abandoned path.
    void dropFrom(Index first) {
        while (!pages_.empty()) {
            while (count_ > 0 && base_ + owners_[count_ - 1] >= first) --count_;
            if (count_ > 0) return;
            if (pages_.size() == 1) {
                base_ = first;
                return;
            }
            spare_.push_back(pages_.back());
            pages_.pop_back();
            const auto* page = reinterpret_cast<const Page*>(pages_.back());
            before_ -= page->count;
            enter(pages_.back(), page->base, page->count);
        }
    }

    /// Calls visit(owner, value) in call order.
    template <typename Visit>
    void forEach(Visit&& visit) const {
        for (std::size_t p = 0; p < pages_.size(); ++p) {
            const bool open = p + 1 == pages_.size();
            const auto* page = reinterpret_cast<const Page*>(pages_[p]);
            const Index base = open ? base_ : page->base;
            const std::uint32_t count = open ? count_ : page->count;
            const std::uint16_t* owners = ownersOf(pages_[p]);
            const std::byte* values = valuesOf(pages_[p]);
            for (std::uint32_t i = 0; i < count; ++i) visit(base + owners[i], values + std::size_t(i) * valueBytes_);
        }
    }

  private:
    /// Head of a page that is full. The open page's numbers are in the column itself, where appending finds them.
    struct Page {
        Index base;
        std::uint32_t count;
    };
    std::uint16_t* ownersOf(std::byte* page) const {
        return reinterpret_cast<std::uint16_t*>(page + PagePool::kPageBytes) - capacity_;
    }
    static std::byte* valuesOf(std::byte* page) { return page + sizeof(Page); }

    void enter(std::byte* page, Index base, std::uint32_t count) {
        base_ = base;
        count_ = count;
        owners_ = ownersOf(page);
        values_ = valuesOf(page);
    }

    bool grow(Index base, PagePool& pool) {
        std::byte* page;
        if (!spare_.empty()) {
            page = spare_.back();
            spare_.pop_back();
        } else {
            page = pool.take();
        }
        if (!page) return false;
        if (!pages_.empty()) {
            *reinterpret_cast<Page*>(pages_.back()) = {base_, count_};
            before_ += count_;
        }
        pages_.push_back(page);
        enter(page, base, 0);
        return true;
    }

    std::uint32_t valueBytes_, capacity_;
    // The open page. A column without one counts as full.
    Index base_ = 0;
    std::uint32_t count_;
    std::uint16_t* owners_ = nullptr;
    std::byte* values_ = nullptr;
    std::size_t before_ = 0;  ///< values in the full pages
    std::vector<std::byte*> pages_, spare_;
};

}  // namespace emca::detail
