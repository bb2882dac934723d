#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>

#include "light_path.h"
#include "syntax.h"

namespace emca::query::detail {

/// An array that is not cleared before it is filled.
template <typename T>
class Buffer {
  public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : data_(new T[size]), size_(size) {}
    Buffer(std::size_t size, T value) : Buffer(size) { std::fill_n(data_.get(), size, value); }
    Buffer(Buffer&&) noexcept = default;
    Buffer& operator=(Buffer&&) noexcept = default;
    Buffer(const Buffer& other) : Buffer(other.size_) { std::copy_n(other.data_.get(), size_, data_.get()); }
    Buffer& operator=(const Buffer& other) { return *this = Buffer(other); }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }

  private:
    std::unique_ptr<T[]> data_;
    std::size_t size_ = 0;
};

/// The values of an expression on a chunk of paths: one per element of its domain, or one for all if it is constant.
/// Numbers, colours and vectors have one array per component; what is unknown has an unspecified value.
struct Values {
    Type type = Type::missing;
    int components = 1;
    std::size_t size = 0;
    bool constant = false;                         ///< size 1, for every element
    std::array<Buffer<double>, 4> numbers;
    Buffer<std::uint8_t> known;                    ///< not of booleans; empty: all are
    Buffer<std::uint8_t> truth;                    ///< of booleans, after Kleene
    Buffer<std::uint32_t> texts;                   ///< identities of texts; of spectra: places in their column
    const Column* spectra = nullptr;

    bool isKnown(std::size_t i) const {
        if (type == Type::missing) return false;
        if (type == Type::boolean) return truth[constant ? 0 : i] != kUnknown;
        return known.empty() || known[constant ? 0 : i] != 0;
    }
};

}  // namespace emca::query::detail
