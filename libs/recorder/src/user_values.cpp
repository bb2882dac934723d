#include "user_values.h"

#include <cstring>

namespace emca::detail {

UserValues::UserValues(std::string_view name, Scope scope, ValueType type, std::size_t capacity, std::size_t owners,
                       ResultMemory& memory)
    : name_(name),
      scope_(scope),
      type_(type),
      values_(capacity, type == ValueType::spectrum ? 0 : byteSize(type), capacity == owners, memory) {
    if (type == ValueType::spectrum) spectrumOffsets_.push_back(0);
}

void UserValues::addSpectrum(Index owner, const std::byte* spectrum, std::uint32_t entries) {
    const std::size_t before = spectra_.size();
    spectra_.resize(before + entries);
    if (entries > 0) std::memcpy(spectra_.data() + before, spectrum, entries * sizeof(float));
    spectrumOffsets_.push_back(static_cast<std::uint32_t>(spectra_.size()));
    values_.addOwner(owner);
}

Column UserValues::finish(std::size_t owners) {
    const std::vector<Index> permutation = values_.order();
    if (!permutation.empty()) follow(permutation);
    Column column;
    column.name = name_;
    column.scope = scope_;
    column.type = type_;
    column.count = values_.count();
    if (!values_.dense(owners)) column.owners = values_.owners();
    column.bytes = values_.share<std::byte>();
    if (type_ == ValueType::spectrum) {
        const auto bytes = std::as_bytes(std::span(spectra_));
        column.bytes = std::vector<std::byte>(bytes.begin(), bytes.end());
        column.spectrumOffsets = std::move(spectrumOffsets_);
    }
    column.locations = std::move(locations_);
    return column;
}

/// Brings what stands beside the values in their new order.
void UserValues::follow(const std::vector<Index>& permutation) {
    if (!locations_.empty()) {
        std::vector<std::uint32_t> locations;
        for (const Index i : permutation) locations.push_back(locations_[i]);
        locations_ = std::move(locations);
    }
    if (type_ != ValueType::spectrum) return;
    std::vector<float> spectra;
    std::vector<std::uint32_t> offsets{0};
    for (const Index i : permutation) {
        spectra.insert(spectra.end(), spectra_.begin() + spectrumOffsets_[i],
                       spectra_.begin() + spectrumOffsets_[i + 1]);
        offsets.push_back(static_cast<std::uint32_t>(spectra.size()));
    }
    spectra_ = std::move(spectra);
    spectrumOffsets_ = std::move(offsets);
}

}  // namespace emca::detail
