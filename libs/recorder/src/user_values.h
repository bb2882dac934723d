#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "emca/core/path_set.h"
#include "value_column.h"

namespace emca::detail {

/// A user column of the result while it is filled.
class UserValues {
  public:
    /// \param capacity  values that may come \param owners  paths or vertices there may be
    UserValues(std::string_view name, Scope scope, ValueType type, std::size_t capacity, std::size_t owners,
               ResultMemory& memory);

    Scope scope() const { return scope_; }
    /// Not for spectra. Text: the index into the result's strings.
    template <std::size_t kBytes>
    void add(Index owner, const std::byte* value) {
        values_.add<kBytes>(owner, value);
    }
    /// \param entries  floats at `spectrum`, which need not be aligned
    void addSpectrum(Index owner, const std::byte* spectrum, std::uint32_t entries);
    /// The source line of the value that was added last, as index into the strings.
    void addLocation(std::uint32_t line) { locations_.push_back(line); }

    /// Everything, in the order of the owners. \param owners  paths or vertices there are
    Column finish(std::size_t owners);

  private:
    void follow(const std::vector<Index>& permutation);

    std::string_view name_;
    Scope scope_;
    ValueType type_;
    ValueColumn values_;  ///< of spectra: owners only
    std::vector<float> spectra_;
    std::vector<std::uint32_t> spectrumOffsets_, locations_;
};

}  // namespace emca::detail
