#pragma once

#include <cassert>
#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>

namespace emca {

/// What went wrong, for programs; the sentence beside it is for people. The numbers travel in error replies
/// (docs/protocol.md) and never change their meaning.
enum class ErrorCode : std::uint16_t {
    internal = 1,           ///< a fault of ours: please report it
    invalidArgument = 2,    ///< a value that no request may have (samples 0, an empty rectangle)
    pixelOutOfRange = 3,    ///< a pixel outside the image
    notSupported = 4,       ///< the other side does not offer this
    fileNotFound = 5,
    fileUnreadable = 6,     ///< there, but not what its name or header says
    fileUnwritable = 7,
    connectionFailed = 8,   ///< nobody listens there, or the name is unknown
    connectionLost = 9,     ///< was open, ended in the middle
    timedOut = 10,
    protocolViolation = 11, ///< the peer sent what is no EMCA message
    versionMismatch = 12,
    refused = 13,           ///< the server does not want this client (token, too many clients)
    tooLarge = 14,          ///< beyond a stated limit
    cancelled = 15,
    rendererFailed = 16,    ///< the renderer behind the server reported an error or threw
    addressInUse = 17,
    parseFailed = 18,       ///< text that does not follow its grammar (scene file, query)
    outOfMemory = 19,
};

/// Short stable name, e.g. "pixelOutOfRange"; "unknown" for a number that this version does not know.
const char* name(ErrorCode code);

struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string message;  ///< one sentence: what was asked, what was found, what to do
};

/// A value or an error. Never both, never neither.
template <typename T>
class [[nodiscard]] Result {
  public:
    Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

    /// A pointer to a derived class, where T points to its base: `return std::make_unique<MyWorker>();`.
    template <typename Derived>
        requires(!std::same_as<std::unique_ptr<Derived>, T> && std::convertible_to<std::unique_ptr<Derived>, T>)
    Result(std::unique_ptr<Derived> value) : content_(std::in_place_index<0>, std::move(value)) {}

    bool ok() const { return content_.index() == 0; }
    explicit operator bool() const { return ok(); }

    /// Only if ok().
    T& value() & { assert(ok()); return *std::get_if<0>(&content_); }
    const T& value() const& { assert(ok()); return *std::get_if<0>(&content_); }
    T&& value() && { assert(ok()); return std::move(*std::get_if<0>(&content_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    /// Only if not ok().
    const Error& error() const { assert(!ok()); return *std::get_if<1>(&content_); }

  private:
    std::variant<T, Error> content_;
};

template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : failed_(true), error_(std::move(error)) {}
    bool ok() const { return !failed_; }
    explicit operator bool() const { return ok(); }
    const Error& error() const { assert(failed_); return error_; }

  private:
    bool failed_ = false;
    Error error_;
};

}  // namespace emca
