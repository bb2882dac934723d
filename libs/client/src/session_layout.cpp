#include "session_layout.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace emca::client {

namespace {

constexpr std::array<char, 4> kBlockMark{'E', 'B', 'L', 'K'}, kTrailerMark{'E', 'E', 'N', 'D'};

template <typename T>
void put(std::byte* at, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) at[i] = static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
}
template <typename T>
T get(const std::byte* at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::to_integer<std::uint64_t>(at[i]) << (8 * i);
    return static_cast<T>(value);
}

/// The last four bytes are the checksum of those before.
void seal(std::span<std::byte> bytes) { put(bytes.data() + bytes.size() - 4, checksum(bytes.first(bytes.size() - 4))); }
bool isSealed(std::span<const std::byte> bytes) {
    return get<std::uint32_t>(bytes.data() + bytes.size() - 4) == checksum(bytes.first(bytes.size() - 4));
}

}  // namespace

std::uint32_t checksum(std::span<const std::byte> bytes) {
    return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::array<std::byte, kFileHeaderBytes> bytesOf(const FileHeader& header) {
    std::array<std::byte, kFileHeaderBytes> bytes{};
    std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
    put(&bytes[8], header.neededVersion);
    put(&bytes[10], header.writtenVersion);
    seal(bytes);
    return bytes;
}

bool beginsWithMagic(std::span<const std::byte> bytes) {
    return std::memcmp(bytes.data(), kMagic.data(), std::min(bytes.size(), kMagic.size())) == 0;
}

std::optional<FileHeader> fileHeader(std::span<const std::byte, kFileHeaderBytes> bytes) {
    if (!beginsWithMagic(bytes) || !isSealed(bytes)) return std::nullopt;
    return FileHeader{get<std::uint16_t>(&bytes[8]), get<std::uint16_t>(&bytes[10])};
}

std::array<std::byte, kBlockHeaderBytes> bytesOf(const BlockHeader& header) {
    std::array<std::byte, kBlockHeaderBytes> bytes{};
    std::memcpy(bytes.data(), kBlockMark.data(), kBlockMark.size());
    put(&bytes[4], header.kind);
    put(&bytes[5], header.compression);
    put(&bytes[8], header.part);
    put(&bytes[12], header.checksum);
    put(&bytes[16], header.storedBytes);
    put(&bytes[24], header.contentBytes);
    seal(bytes);
    return bytes;
}

std::optional<BlockHeader> blockHeader(std::span<const std::byte, kBlockHeaderBytes> bytes) {
    if (std::memcmp(bytes.data(), kBlockMark.data(), kBlockMark.size()) != 0 || !isSealed(bytes)) return std::nullopt;
    return BlockHeader{get<std::uint8_t>(&bytes[4]),  get<std::uint8_t>(&bytes[5]),   get<std::uint32_t>(&bytes[8]),
                       get<std::uint32_t>(&bytes[12]), get<std::uint64_t>(&bytes[16]), get<std::uint64_t>(&bytes[24])};
}

std::array<std::byte, kContentsEntryBytes> bytesOf(const ContentsEntry& entry) {
    std::array<std::byte, kContentsEntryBytes> bytes{};
    put(bytes.data(), entry.offset);
    const auto header = bytesOf(entry.header);
    std::copy(header.begin(), header.end(), bytes.begin() + 8);
    return bytes;
}

std::optional<ContentsEntry> contentsEntry(std::span<const std::byte, kContentsEntryBytes> bytes) {
    const auto header = blockHeader(bytes.last<kBlockHeaderBytes>());
    if (!header) return std::nullopt;
    return ContentsEntry{get<std::uint64_t>(bytes.data()), *header};
}

std::array<std::byte, kTrailerBytes> trailer(std::uint64_t offset) {
    std::array<std::byte, kTrailerBytes> bytes{};
    std::memcpy(bytes.data(), kTrailerMark.data(), kTrailerMark.size());
    put(&bytes[4], offset);
    seal(bytes);
    return bytes;
}

std::optional<std::uint64_t> contentsOffset(std::span<const std::byte, kTrailerBytes> bytes) {
    if (std::memcmp(bytes.data(), kTrailerMark.data(), kTrailerMark.size()) != 0 || !isSealed(bytes)) return std::nullopt;
    return get<std::uint64_t>(&bytes[4]);
}

}  // namespace emca::client
