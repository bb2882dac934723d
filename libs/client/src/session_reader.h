#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/result.h"
#include "emca/protocol/frame.h"
#include "session_layout.h"

struct ZSTD_DCtx_s;

namespace emca::client {

/// Reads the blocks of a session file from front to back, as far as they are whole. Any bytes are safe to read.
class SessionReader {
  public:
    /// A block, or why its content is not there: a clause for a sentence.
    struct Block {
        BlockHeader header;
        protocol::Frame content;
        std::string fault;
        bool later = false;   ///< no damage: packed in a way that only later versions know
    };

    /// \param maximumBytes  that all blocks together may unpack to
    /// Errors: fileNotFound, fileUnreadable, versionMismatch.
    static Result<std::unique_ptr<SessionReader>> open(const std::filesystem::path& file, std::uint64_t maximumBytes);

    /// The next block; nothing after the last one that can be found.
    std::optional<Block> next();

    /// After the last block: what is wrong with the file as a whole, as sentences.
    const std::vector<std::string>& faults() const { return faults_; }
    bool endsEarly() const { return endsEarly_; }
    std::uint64_t bytes() const { return size_; }
    std::uint64_t position() const { return position_; }
    std::uint64_t maximumBytes() const { return allBytes_; }

  private:
    SessionReader(std::filesystem::path file, std::uint64_t size);
    Result<void> readFileHeader();
    void readContents();
    std::optional<BlockHeader> headerHere();
    std::optional<BlockHeader> copyOfHeader(std::uint64_t offset) const;
    void load(Block& block);
    void unpack(Block& block, std::span<const std::byte> stored, std::byte* content);
    void finish(const BlockHeader& contents);
    bool read(std::uint64_t offset, std::byte* to, std::size_t bytes);

    std::filesystem::path file_;
    std::ifstream stream_;
    std::uint64_t size_ = 0, position_ = 0, allBytes_ = 0, bytesLeft_ = 0;
    std::vector<ContentsEntry> contents_;   ///< as the file's end says; empty if it is not there
    std::uint64_t contentsOffset_ = 0;
    std::size_t blocks_ = 0;
    std::unique_ptr<ZSTD_DCtx_s, std::size_t (*)(ZSTD_DCtx_s*)> unpacker_;
    std::vector<std::string> faults_;
    bool ended_ = false, endsEarly_ = false;
};

}  // namespace emca::client
