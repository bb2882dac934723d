#include "session_reader.h"

#include <zstd.h>

#include <algorithm>
#include <new>

namespace emca::client {

namespace fs = std::filesystem;

namespace {

Error unreadable(const fs::path& file, const std::string& why) {
    return {ErrorCode::fileUnreadable, "The session " + file.string() + " cannot be opened: " + why + "."};
}

/// Of what a file of this size may unpack to: a small one must not fill the memory. SessionWriter keeps to it.
std::uint64_t unpackedLimit(std::uint64_t fileBytes) { return (std::uint64_t(1) << 30) + 256 * fileBytes; }

}  // namespace

SessionReader::SessionReader(fs::path file, std::uint64_t size)
    : file_(std::move(file)), stream_(file_, std::ios::binary), size_(size), unpacker_(ZSTD_createDCtx(), &ZSTD_freeDCtx) {}

Result<std::unique_ptr<SessionReader>> SessionReader::open(const fs::path& file, std::uint64_t maximumBytes) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    if (!fs::exists(status)) {
        return Error{ErrorCode::fileNotFound, "The session " + file.string() + " was to be opened, but there is no such file."};
    }
    if (!fs::is_regular_file(status)) return unreadable(file, "it is not a file");
    const std::uint64_t size = fs::file_size(file, code);
    if (code) return unreadable(file, code.message());
    std::unique_ptr<SessionReader> reader(new SessionReader(file, size));
    if (!reader->stream_) return unreadable(file, "reading it is not allowed");
    if (!reader->unpacker_) return Error{ErrorCode::outOfMemory, "There is no memory to open the session " + file.string() + "."};
    reader->allBytes_ = reader->bytesLeft_ = std::min(maximumBytes, unpackedLimit(size));
    if (auto begun = reader->readFileHeader(); !begun) return begun.error();
    reader->readContents();
    return reader;
}

bool SessionReader::read(std::uint64_t offset, std::byte* to, std::size_t bytes) {
    if (bytes > size_ || offset > size_ - bytes) return false;
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(offset));
    stream_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(bytes));
    return stream_.gcount() == static_cast<std::streamsize>(bytes);
}

Result<void> SessionReader::readFileHeader() {
    std::array<std::byte, kFileHeaderBytes> bytes{};
    const auto there = static_cast<std::size_t>(std::min<std::uint64_t>(size_, bytes.size()));
    if (!read(0, bytes.data(), there)) return unreadable(file_, "the disk does not give its bytes");
    if (there == 0) return unreadable(file_, "it is empty");
    if (!beginsWithMagic(std::span(bytes).first(there))) return unreadable(file_, "it is no EMCA session, or its first bytes are damaged");
    if (there < bytes.size()) {
        return unreadable(file_, "it was cut after " + std::to_string(size_) + " bytes, before anything that was saved");
    }
    const auto header = fileHeader(bytes);
    if (!header) {
        faults_.push_back("The first bytes of the file are damaged; it was read as one of version " + std::to_string(kSessionVersion) + ".");
    } else if (header->neededVersion > kSessionVersion) {
        return Error{ErrorCode::versionMismatch,
                     "The session " + file_.string() + " needs a program that reads version " + std::to_string(header->neededVersion) +
                         " of session files; this one reads up to " + std::to_string(kSessionVersion) + ": open it with a newer EMCA."};
    }
    position_ = kFileHeaderBytes;
    return {};
}

/// The table of contents, if the file's end has one.
void SessionReader::readContents() {
    std::array<std::byte, kTrailerBytes> end{};
    if (size_ < kFileHeaderBytes + kBlockHeaderBytes + kTrailerBytes || !read(size_ - kTrailerBytes, end.data(), end.size())) return;
    const auto offset = contentsOffset(end);
    std::array<std::byte, kBlockHeaderBytes> bytes{};
    if (!offset || !read(*offset, bytes.data(), bytes.size())) return;
    const auto header = blockHeader(bytes);
    if (!header || header->kind != BlockKind::contents || header->compression != Compression::none) return;
    if (header->storedBytes > size_ || header->storedBytes % kContentsEntryBytes != 0) return;
    std::vector<std::byte> list(static_cast<std::size_t>(header->storedBytes));
    if (!read(*offset + kBlockHeaderBytes, list.data(), list.size()) || checksum(list) != header->checksum) return;
    for (std::size_t at = 0; at < list.size(); at += kContentsEntryBytes) {
        const auto entry = contentsEntry(std::span<const std::byte, kContentsEntryBytes>(&list[at], kContentsEntryBytes));
        if (!entry || (!contents_.empty() && entry->offset <= contents_.back().offset)) {
            contents_.clear();
            return;
        }
        contents_.push_back(*entry);
    }
    contentsOffset_ = *offset;
}

std::optional<BlockHeader> SessionReader::copyOfHeader(std::uint64_t offset) const {
    const auto found = std::lower_bound(contents_.begin(), contents_.end(), offset,
                                        [](const ContentsEntry& entry, std::uint64_t o) { return entry.offset < o; });
    if (found == contents_.end() || found->offset != offset) return std::nullopt;
    return found->header;
}

std::optional<BlockHeader> SessionReader::headerHere() {
    std::array<std::byte, kBlockHeaderBytes> bytes{};
    if (!read(position_, bytes.data(), bytes.size())) {
        endsEarly_ = true;
        return std::nullopt;
    }
    if (const auto header = blockHeader(bytes)) return header;
    const auto copy = copyOfHeader(position_);
    if (copy) {
        faults_.push_back("The file is damaged at byte " + std::to_string(position_) + "; nothing is lost there, as its table of contents has a copy.");
        return copy;
    }
    faults_.push_back("The file is damaged at byte " + std::to_string(position_) + ", and what follows cannot be found.");
    return std::nullopt;
}

std::optional<SessionReader::Block> SessionReader::next() {
    if (ended_) return std::nullopt;
    const auto header = headerHere();
    if (header && header->kind == BlockKind::contents) {
        finish(*header);
        return std::nullopt;
    }
    if (header && header->storedBytes > size_ - position_ - kBlockHeaderBytes) endsEarly_ = true;
    if (!header || endsEarly_) {
        ended_ = true;
        return std::nullopt;
    }
    Block block;
    block.header = *header;
    load(block);
    position_ += kBlockHeaderBytes + header->storedBytes;
    ++blocks_;
    return block;
}

void SessionReader::load(Block& block) {
    const BlockHeader& header = block.header;
    if (header.compression > Compression::zstd) {
        block.fault = "it is packed in a way that only a later version knows";
        block.later = true;
        return;
    }
    if (header.contentBytes > protocol::kMaximumReplyBytes || header.contentBytes > bytesLeft_) {
        block.fault = "it would unpack to " + std::to_string(header.contentBytes) + " bytes, more than is accepted here";
        return;
    }
    if (header.compression == Compression::none && header.storedBytes != header.contentBytes) {
        block.fault = "its sizes contradict each other";
        return;
    }
    auto content = protocol::allocatePayload(static_cast<std::size_t>(header.contentBytes));
    const std::uint64_t offset = position_ + kBlockHeaderBytes;
    const auto storedBytes = static_cast<std::size_t>(header.storedBytes);
    const std::unique_ptr<std::byte[]> packed(header.compression == Compression::none ? nullptr : new (std::nothrow) std::byte[storedBytes]);
    std::byte* const stored = packed ? packed.get() : content ? content->get() : nullptr;
    if (!content || !stored || (header.compression != Compression::none && !packed)) {
        block.fault = "there is no memory for its " + std::to_string(header.contentBytes) + " bytes";
    } else if (!read(offset, stored, storedBytes)) {
        block.fault = "the disk does not give its bytes";
    } else if (checksum({stored, storedBytes}) != header.checksum) {
        block.fault = "its checksum does not match";
    } else if (packed && ZSTD_decompressDCtx(unpacker_.get(), content->get(), static_cast<std::size_t>(header.contentBytes), stored, storedBytes) !=
                             header.contentBytes) {
        block.fault = "it cannot be unpacked";
    } else {
        bytesLeft_ -= header.contentBytes;
        const std::byte* data = content->get();
        block.content = protocol::Frame(std::move(content).value(), data, static_cast<std::size_t>(header.contentBytes));
    }
}

/// At the table of contents: everything before it was seen.
void SessionReader::finish(const BlockHeader& contents) {
    ended_ = true;
    const std::uint64_t end = position_ + kBlockHeaderBytes + contents.storedBytes;
    const bool known = contentsOffset_ == position_ && contents_.size() == blocks_;
    if (known && end + kTrailerBytes == size_) return;
    if (contents.storedBytes > size_ || end + kTrailerBytes > size_) {
        faults_.push_back("The file ends in its table of contents; the parts do not need it.");
    } else if (end + kTrailerBytes < size_) {
        faults_.push_back(std::to_string(size_ - end - kTrailerBytes) + " bytes that are not part of the session follow its end.");
    } else {
        faults_.push_back("The table of contents is damaged; the parts do not need it.");
    }
}

}  // namespace emca::client
