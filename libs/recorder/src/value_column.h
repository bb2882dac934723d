#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "emca/core/path_set.h"
#include "result_memory.h"

namespace emca::detail {

/// Values with owners of the result while they arrive, in an order that is nearly always the result's.
class ValueColumn {
  public:
    /// \param capacity  values that may come \param bytes  of one value \param mayBeDense  owners may be left out at
    /// the end
    ValueColumn(std::size_t capacity, std::size_t bytes, bool mayBeDense, ResultMemory& memory)
        : memory_(&memory), capacity_(capacity), bytes_(bytes), values_(memory.take<std::byte>(capacity * bytes)) {
        if (!mayBeDense) owners_ = memory.take<Index>(capacity);
    }

    template <std::size_t kBytes>
    void add(Index owner, const std::byte* value) {
        std::memcpy(values_.data + std::size_t(count_) * kBytes, value, kBytes);
        addOwner(owner);
    }
    /// As long as value i belongs to owner i, no owners are written.
    void addOwner(Index owner) {
        const Index i = count_++;
        if (owners_.data == nullptr) {
            if (owner == i) [[likely]]
                return;
            writeOwners(i);
        }
        owners_.data[i] = owner;
    }

    Index count() const { return count_; }
    const std::byte* values() const { return values_.data; }

    /// Brings the values in the order of their owners; those of one owner stay in the order of their arrival. Returns
    /// the permutation, empty if all was in order: what stands beside this column must follow it.
    std::vector<Index> order();
    /// Whether there is one value for each of the owners.
    bool dense(std::size_t ownerCount) const;

    SharedArray<Index> owners() {
        if (owners_.data == nullptr) writeOwners(count_);
        return owners_.share(count_);
    }
    template <typename T>
    SharedArray<T> share() const {
        return ResultArray<T>{values_.owner, reinterpret_cast<T*>(values_.data)}.share(count_ * bytes_ / sizeof(T));
    }

  private:
    void writeOwners(Index until);

    ResultMemory* memory_;
    std::size_t capacity_, bytes_;
    Index count_ = 0;
    ResultArray<std::byte> values_;
    ResultArray<Index> owners_;
};

}  // namespace emca::detail
