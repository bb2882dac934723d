#pragma once

#include <asio.hpp>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "wire.h"

namespace emca::bridge {

/// A socket to a published server. Used by one thread at a time, except interrupt().
class Link final : public ByteSource {
  public:
    /// \param limit  for finding the name and connecting
    /// Errors: connectionFailed (nobody listens there, unknown name), timedOut, cancelled (by interrupt).
    Result<void> connect(const std::string& host, std::uint16_t port, std::chrono::milliseconds limit);

    Result<std::size_t> readSome(std::span<std::byte> into, std::chrono::milliseconds silence) override;
    /// Errors: connectionLost, timedOut, cancelled.
    Result<void> write(std::span<const std::byte> bytes, std::chrono::milliseconds limit);

    /// From any thread: what runs returns "cancelled", and so does everything later, until resume().
    void interrupt();
    void resume() { interrupted_ = false; }

  private:
    enum class AtLimit { cancel, close };
    /// Runs the network until `done`, as long as `limit` (0: for ever). \return false at the limit
    bool run(const bool& done, std::chrono::milliseconds limit, AtLimit atLimit = AtLimit::cancel);
    /// What an operation that ended in time gave.
    Result<void> outcome(std::error_code error, const char* doing) const;
    Error late(std::chrono::milliseconds limit) const;

    asio::io_context context_{1};
    asio::ip::tcp::socket socket_{context_};
    std::atomic<bool> interrupted_{false};
    std::string address_;
};

}  // namespace emca::bridge
