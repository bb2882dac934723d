#pragma once

#include <cstddef>
#include <cstring>
#include <string>

#include "guard.h"

namespace emca::c {

/// No struct of ours will ever be larger: a size beyond it is a member that nobody set.
inline constexpr std::uint32_t kLargestStruct = 1u << 16;

/// Copies a struct that the caller filled, whose `size` says how much of it there was when the caller was compiled:
/// what it lacks is 0. What a newer caller has beyond ours must be 0, since nobody here would know what it means.
///
/// \param first  size of its first version: what every caller has
/// \param name   for people: "emca_renderer"
/// Errors: invalidArgument (null, a size that no version had), versionMismatch.
template <typename T>
Result<T> sized(const T* given, std::size_t first, const char* name) {
    if (given == nullptr)
        return Error{ErrorCode::invalidArgument, std::string("A null pointer was given where ") + name + " is needed."};
    std::uint32_t header[2];
    std::memcpy(header, given, sizeof header);
    const auto [size, version] = header;
    if (size < first || size > kLargestStruct)
        return Error{ErrorCode::invalidArgument, std::string(name) + " says that it has " + std::to_string(size) +
                                                     " bytes, but it has at least " + std::to_string(first) +
                                                     ": set `size` and `version` with EMCA_SIZED(" + name + ")."};
    emca_error mismatch{};
    if (emca_check_abi(version, &mismatch) != EMCA_OK) return Error{ErrorCode::versionMismatch, mismatch.message};
    const auto* bytes = reinterpret_cast<const unsigned char*>(given);
    for (std::size_t i = sizeof(T); i < size; ++i)
        if (bytes[i] != 0)
            return Error{ErrorCode::versionMismatch, std::string(name) +
                                                         " says something that this libemca.so (EMCA " EMCA_VERSION
                                                         ") does not know yet: install a newer one."};
    T copy;
    std::memset(&copy, 0, sizeof copy);
    std::memcpy(&copy, given, size < sizeof(T) ? size : sizeof(T));
    return copy;
}

/// The bytes up to and with the last member that the first version had.
#define EMCA_SIZE_UP_TO(type, member) (offsetof(type, member) + sizeof(type::member))

/// A struct that a function of the renderer gets: zero, with our size and version.
template <typename T>
T filled() {
    T made;
    std::memset(&made, 0, sizeof made);
    made.size = sizeof made;
    made.version = EMCA_ABI;
    return made;
}

}  // namespace emca::c
