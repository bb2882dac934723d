#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "emca/core/replaced_file.h"
#include "emca/protocol/frame.h"
#include "session_layout.h"

struct ZSTD_CCtx_s;

namespace emca::client {

/// Writes the blocks of a session file, in order, from front to back.
class SessionWriter {
  public:
    /// Called before each step that changes the disk, with its name; tests end the process there.
    using Step = std::function<void(const char* what)>;

    explicit SessionWriter(Step step = {});
    ~SessionWriter();
    SessionWriter(const SessionWriter&) = delete;
    SessionWriter& operator=(const SessionWriter&) = delete;

    // Errors: fileUnwritable, with the reason; outOfMemory.
    Result<void> create(const std::filesystem::path& file);
    Result<void> add(std::uint8_t kind, std::uint32_t part, std::span<const std::byte> content);
    /// Table of contents, trailer, onto the disk, into its place.
    Result<void> finish();
    std::uint64_t bytes() const { return position_; }

  private:
    Result<void> append(std::uint8_t kind, std::uint8_t compression, std::uint32_t part, std::span<const std::byte> stored,
                        std::size_t contentBytes);
    Result<void> write(std::span<const std::byte> bytes);
    Result<void> flush();
    Error failed(int reason) const;
    void step(const char* what) const { if (step_) step_(what); }

    Step step_;
    std::filesystem::path asked_;
    std::optional<ReplacedFile> file_;
    int descriptor_ = -1;
    std::unique_ptr<ZSTD_CCtx_s, std::size_t (*)(ZSTD_CCtx_s*)> compressor_;
    std::vector<ContentsEntry> contents_;
    std::uint64_t position_ = 0, unpacked_ = 0;
};

}  // namespace emca::client
