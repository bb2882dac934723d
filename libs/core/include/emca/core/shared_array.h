#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace emca {

/// Read-only array whose copies share their storage: a vector that was moved in, or a part of a received message that
/// stays alive as long as any array looks at it. Safe to read from any thread.
template <typename T>
class SharedArray {
  public:
    SharedArray() = default;
    SharedArray(std::vector<T> values) {
        auto owner = std::make_shared<const std::vector<T>>(std::move(values));
        data_ = owner->data();
        size_ = owner->size();
        owner_ = std::move(owner);
    }
    /// `size` values at `data`, kept alive by `owner`. `data` must be aligned for T.
    SharedArray(std::shared_ptr<const void> owner, const T* data, std::size_t size)
        : owner_(std::move(owner)), data_(data), size_(size) {}

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const T* data() const { return data_; }
    const T& operator[](std::size_t i) const { assert(i < size_); return data_[i]; }
    const T& back() const { assert(size_ > 0); return data_[size_ - 1]; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }
    std::span<const T> span() const { return {data_, size_}; }
    operator std::span<const T>() const { return span(); }
    /// What keeps the values alive, for views that outlive this array.
    const std::shared_ptr<const void>& owner() const { return owner_; }

  private:
    std::shared_ptr<const void> owner_;
    const T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace emca
