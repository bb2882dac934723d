#include "value_column.h"

#include <algorithm>
#include <numeric>

namespace emca::detail {

void ValueColumn::writeOwners(Index until) {
    owners_ = memory_->take<Index>(capacity_);
    std::iota(owners_.data, owners_.data + until, 0u);
}

std::vector<Index> ValueColumn::order() {
    if (owners_.data == nullptr || std::is_sorted(owners_.data, owners_.data + count_)) return {};
    std::vector<Index> permutation(count_);
    std::iota(permutation.begin(), permutation.end(), 0u);
    const Index* owners = owners_.data;
    std::stable_sort(permutation.begin(), permutation.end(),
                     [owners](Index a, Index b) { return owners[a] < owners[b]; });
    const ResultArray<Index> orderedOwners = memory_->take<Index>(count_);
    const ResultArray<std::byte> orderedValues = memory_->take<std::byte>(count_ * bytes_);
    for (Index i = 0; i < count_; ++i) {
        orderedOwners.data[i] = owners_.data[permutation[i]];
        if (bytes_ > 0) std::memcpy(orderedValues.data + i * bytes_, values_.data + permutation[i] * bytes_, bytes_);
    }
    owners_ = orderedOwners;
    values_ = orderedValues;
    return permutation;
}

bool ValueColumn::dense(std::size_t ownerCount) const {
    if (count_ != ownerCount) return false;
    if (owners_.data == nullptr) return true;
    for (Index i = 0; i < count_; ++i)
        if (owners_.data[i] != i) return false;
    return true;
}

}  // namespace emca::detail
