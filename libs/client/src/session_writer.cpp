#include "session_writer.h"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <string>

namespace emca::client {

namespace {

/// docs/performance.md has the figures of levels 1 to 3.
constexpr int kCompressionLevel = 1;
/// Less is not worth unpacking.
constexpr std::size_t kSmallestCompressed = 256;

/// A reader believes that a file unpacks to 1 GiB and 256 times its size: blocks beyond half of that stay as they are.
bool mayCompress(std::uint64_t unpacked, std::uint64_t stored) {
    return unpacked < (std::uint64_t(1) << 29) || unpacked / 128 < stored;
}

}  // namespace

SessionWriter::SessionWriter(Step step) : step_(std::move(step)), compressor_(ZSTD_createCCtx(), &ZSTD_freeCCtx) {}

SessionWriter::~SessionWriter() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Error SessionWriter::failed(int reason) const {
    return {ErrorCode::fileUnwritable, "The session " + asked_.string() + " cannot be written: " + std::strerror(reason) + "."};
}

Result<void> SessionWriter::create(const std::filesystem::path& file) {
    asked_ = file;
    if (!compressor_) return Error{ErrorCode::outOfMemory, "There is no memory to save the session " + file.string() + "."};
    step("create");
    auto created = ReplacedFile::create(file, "session");
    if (!created) return created.error();
    file_.emplace(std::move(created).value());
    file_->stream().close();
    descriptor_ = ::open(file_->temporary().c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) return failed(errno);
    return write(bytesOf(FileHeader{}));
}

Result<void> SessionWriter::write(std::span<const std::byte> bytes) {
    // Small enough that a disk that is pulled or full is noticed soon.
    constexpr std::size_t kMostAtOnce = 16u << 20;
    while (!bytes.empty()) {
        step("write");
        const ssize_t written = ::write(descriptor_, bytes.data(), std::min(bytes.size(), kMostAtOnce));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return failed(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        position_ += static_cast<std::uint64_t>(written);
    }
    return {};
}

Result<void> SessionWriter::append(std::uint8_t kind, std::uint8_t compression, std::uint32_t part,
                                   std::span<const std::byte> stored, std::size_t contentBytes) {
    const BlockHeader header{kind, compression, part, checksum(stored), stored.size(), contentBytes};
    contents_.push_back({position_, header});
    if (auto written = write(bytesOf(header)); !written) return written;
    return write(stored);
}

Result<void> SessionWriter::add(std::uint8_t kind, std::uint32_t part, std::span<const std::byte> content) {
    unpacked_ += content.size();
    if (content.size() >= kSmallestCompressed && mayCompress(unpacked_, position_)) {
        const std::size_t room = ZSTD_compressBound(content.size());
        const std::unique_ptr<std::byte[]> packed(new (std::nothrow) std::byte[room]);
        if (!packed) return Error{ErrorCode::outOfMemory, "There is no memory to save the session " + asked_.string() + "."};
        const std::size_t size = ZSTD_compressCCtx(compressor_.get(), packed.get(), room, content.data(), content.size(), kCompressionLevel);
        if (!ZSTD_isError(size) && size < content.size()) {
            return append(kind, Compression::zstd, part, {packed.get(), size}, content.size());
        }
    }
    return append(kind, Compression::none, part, content, content.size());
}

Result<void> SessionWriter::flush() {
    step("sync");
    if (::fsync(descriptor_) != 0) return failed(errno);
    const int closed = ::close(std::exchange(descriptor_, -1));
    return closed == 0 || errno == EINTR ? Result<void>() : failed(errno);
}

Result<void> SessionWriter::finish() {
    const std::uint64_t begin = position_;
    std::vector<std::byte> list;
    list.reserve(contents_.size() * kContentsEntryBytes);
    for (const ContentsEntry& entry : contents_) {
        const auto bytes = bytesOf(entry);
        list.insert(list.end(), bytes.begin(), bytes.end());
    }
    if (auto added = append(BlockKind::contents, Compression::none, 0, list, list.size()); !added) return added;
    if (auto written = write(trailer(begin)); !written) return written;
    if (auto flushed = flush(); !flushed) return flushed;
    step("rename");
    const auto folder = file_->target().has_parent_path() ? file_->target().parent_path() : std::filesystem::path(".");
    if (auto committed = file_->commit(); !committed) return committed;
    step("sync folder");
    // The new name itself is to survive a loss of power. Some file systems cannot do that: no reason to call it a failure.
    if (const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); directory >= 0) {
        ::fsync(directory);
        ::close(directory);
    }
    step("done");
    return {};
}

}  // namespace emca::client
