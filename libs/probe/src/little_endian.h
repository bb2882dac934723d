#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "emca/core/vector.h"

namespace emca::probe {

/// Appends numbers, lowest byte first whatever the machine does.
class Writer {
  public:
    template <typename T>
    void put(T value) {
        auto raw = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
        if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    }
    void put(Vec3f v) { put(v.x), put(v.y), put(v.z); }
    void put(const void* data, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }
    void reserve(std::size_t size) { bytes_.reserve(size); }
    std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
};

/// Reads them again. Beyond the end everything is 0, and complete() is false.
class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <typename T>
    T get() {
        std::array<std::byte, sizeof(T)> raw{};
        if (sizeof(T) > left()) {
            complete_ = false;
            at_ = bytes_.size();
        } else {
            std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
            at_ += sizeof(T);
        }
        if constexpr (std::endian::native == std::endian::big) std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }
    Vec3f vector() {
        const auto x = get<float>(), y = get<float>(), z = get<float>();
        return {x, y, z};
    }
    std::size_t left() const { return bytes_.size() - at_; }
    bool complete() const { return complete_; }
    std::span<const std::byte> rest() const { return bytes_.subspan(at_); }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    bool complete_ = true;
};

}  // namespace emca::probe
