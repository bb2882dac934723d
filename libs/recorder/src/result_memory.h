#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

#include "emca/core/shared_array.h"
#include "slab.h"

namespace emca::detail {

/// An array of the result while it is filled. Not initialised.
template <typename T>
struct ResultArray {
    std::shared_ptr<const void> owner;
    T* data = nullptr;
    /// The first `size` entries, to be read only from now on.
    SharedArray<T> share(std::size_t size) const {
        return size == 0 ? SharedArray<T>() : SharedArray<T>(owner, data, size);
    }
};

/// Memory of a PathSet's arrays: several arrays share a slab, so that the slabs of the last result can serve the next
/// one. A result that is small takes no whole slab.
class ResultMemory {
  public:
    /// \param expected  bytes that the arrays will take, roughly
    explicit ResultMemory(std::size_t expected) : blockBytes_(std::clamp(expected / 2, kSmallest, kLargest)) {}

    template <typename T>
    ResultArray<T> take(std::size_t size) {
        if (size == 0) return {};
        std::byte* bytes = takeBytes(size * sizeof(T));
        return {owner_, reinterpret_cast<T*>(bytes)};
    }
    template <typename T>
    ResultArray<T> take(std::size_t size, const T& value) {
        ResultArray<T> array = take<T>(size);
        std::fill_n(array.data, size, value);
        return array;
    }

  private:
    static constexpr std::size_t kSmallest = 4096, kLargest = 64 * 4096, kAlignment = 64, kGap = 3 * kAlignment;

    std::byte* takeBytes(std::size_t bytes) {
        // The gap: arrays of equal entries are filled side by side, and beginnings a power of two apart would compete
        // for the same few lines of the cache.
        bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment + kGap;
        if (bytes > left_) {
            left_ = std::max(bytes, blockBytes_);
            if (Slab slab = left_ < kLargest ? Slab() : allocateSlab(left_)) {
                next_ = slab.get();
                left_ = slab.get_deleter().bytes;
                owner_ = std::shared_ptr<const std::byte>(std::move(slab));
            } else {
                next_ = static_cast<std::byte*>(::operator new(left_, std::align_val_t(kAlignment)));
                owner_ = std::shared_ptr<const std::byte>(next_, [](const std::byte* block) {
                    ::operator delete(const_cast<std::byte*>(block), std::align_val_t(kAlignment));
                });
            }
        }
        std::byte* taken = next_;
        next_ += bytes;
        left_ -= bytes;
        return taken;
    }

    std::size_t blockBytes_;
    std::shared_ptr<const void> owner_;
    std::byte* next_ = nullptr;
    std::size_t left_ = 0;
};

}  // namespace emca::detail
