#pragma once

#include <exception>
#include <new>
#include <string>

#define EMCA_NO_INLINE
#include "emca/core/result.h"
#include "emca/emca.h"

/// What every exported function needs: errors as numbers and sentences, nothing thrown, structs of any age.
namespace emca::c {

/// Writes an error to the caller's struct, if there is one. \return its code
emca_code fail(emca_error* error, const Error& what);
emca_code invalid(emca_error* error, const std::string& sentence);

/// The error that a function of the renderer left, with what it was asked if it said nothing.
Error errorOf(emca_code code, const emca_error& error, const char* function);

/// Runs `call` (which returns an emca_code); whatever it throws is an error.
template <typename Call>
emca_code guarded(emca_error* error, const Call& call) noexcept {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return emca_fail(error, EMCA_OUT_OF_MEMORY, "There was not enough memory.");
    } catch (const std::exception& exception) {
        return emca_fail(error, EMCA_INTERNAL, exception.what());
    } catch (...) {
        return emca_fail(error, EMCA_INTERNAL, "Something was thrown that is no std::exception: please report it.");
    }
}

/// Runs `call` of a function without an error; what could not be done for lack of memory is left out.
template <typename Call>
void quiet(const Call& call) noexcept {
    try {
        call();
    } catch (...) {
    }
}

/// Counts a call of `function` that is ignored, and remembers the first one's sentence. Any thread.
void countMisuse(const char* function, const char* why) noexcept;
std::uint64_t misuses();

inline std::string text(const char* given) { return given == nullptr ? std::string() : std::string(given); }

}  // namespace emca::c
