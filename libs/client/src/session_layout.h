#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

/// How a session file lies on the disk (docs/sessions.md): a header, blocks, the table of contents as the last block, and
/// a trailer that says where that is. All numbers are little-endian; every byte is under one of the checksums.
namespace emca::client {

/// The magic shows files that a text conversion damaged, as PNG's does.
inline constexpr std::array<unsigned char, 8> kMagic{0x89, 'E', 'M', 'C', 'A', '\r', '\n', 0x1a};
inline constexpr std::size_t kFileHeaderBytes = 16, kBlockHeaderBytes = 36, kContentsEntryBytes = 8 + kBlockHeaderBytes,
                             kTrailerBytes = 16;
inline constexpr std::uint16_t kSessionVersion = 1;

/// CRC-32 as in zlib, gzip and PNG (ITU-T V.42): a reader in any language has it.
std::uint32_t checksum(std::span<const std::byte> bytes);

struct FileHeader {
    std::uint16_t neededVersion = kSessionVersion;   ///< readers of an earlier one must not try
    std::uint16_t writtenVersion = kSessionVersion;
};
std::array<std::byte, kFileHeaderBytes> bytesOf(const FileHeader& header);
bool beginsWithMagic(std::span<const std::byte> bytes);
/// Nothing if the checksum does not match.
std::optional<FileHeader> fileHeader(std::span<const std::byte, kFileHeaderBytes> bytes);

/// What a block holds. Numbers of later versions are skipped by their size.
struct BlockKind { enum : std::uint8_t { message = 1, saved = 2, contents = 255 }; };
struct Compression { enum : std::uint8_t { none = 0, zstd = 1 }; };

struct BlockHeader {
    std::uint8_t kind = 0;
    std::uint8_t compression = 0;
    std::uint32_t part = 0;           ///< what it belongs to: a number of the plan in the first block
    std::uint32_t checksum = 0;       ///< of the stored bytes
    std::uint64_t storedBytes = 0;    ///< that follow this header
    std::uint64_t contentBytes = 0;   ///< when unpacked
    friend bool operator==(const BlockHeader&, const BlockHeader&) = default;
};
std::array<std::byte, kBlockHeaderBytes> bytesOf(const BlockHeader& header);
/// Nothing if it has no mark or its checksum does not match.
std::optional<BlockHeader> blockHeader(std::span<const std::byte, kBlockHeaderBytes> bytes);

/// An entry of the table of contents: where a block is, and a second copy of its header.
struct ContentsEntry {
    std::uint64_t offset = 0;
    BlockHeader header;
};
std::array<std::byte, kContentsEntryBytes> bytesOf(const ContentsEntry& entry);
std::optional<ContentsEntry> contentsEntry(std::span<const std::byte, kContentsEntryBytes> bytes);

/// The last bytes of a file: where the block with the table of contents begins.
std::array<std::byte, kTrailerBytes> trailer(std::uint64_t contentsOffset);
std::optional<std::uint64_t> contentsOffset(std::span<const std::byte, kTrailerBytes> trailer);

}  // namespace emca::client
