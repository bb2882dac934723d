#include "replaced_file.h"

#include <unistd.h>

#include <string>
#include <utility>

namespace emca::cli {
namespace {

namespace fs = std::filesystem;

Error unwritable(const fs::path& file, const std::string& why) {
    return {ErrorCode::fileUnwritable, "The file " + file.string() + " cannot be written: " + why + "."};
}

}  // namespace

ReplacedFile::ReplacedFile(fs::path asked, fs::path target, fs::path temporary)
    : asked_(std::move(asked)), target_(std::move(target)), temporary_(std::move(temporary)),
      stream_(temporary_, std::ios::binary) {}

ReplacedFile::ReplacedFile(ReplacedFile&& other) noexcept
    : asked_(std::move(other.asked_)), target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, fs::path())), stream_(std::move(other.stream_)) {}

ReplacedFile::~ReplacedFile() {
    if (temporary_.empty()) return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

Result<ReplacedFile> ReplacedFile::create(const fs::path& file) {
    std::error_code code;
    // Through a link to what it means; the link stays.
    const fs::path target = fs::is_symlink(file, code) ? fs::weakly_canonical(file, code) : file;
    const fs::file_status old = fs::status(target, code);
    if (fs::exists(old) && !fs::is_regular_file(old)) return unwritable(file, "there is something of that name that is not a file");
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code)) return unwritable(file, "there is no folder " + folder.string());
    const fs::path temporary = folder / ("." + target.stem().string() + "." + std::to_string(::getpid()) + ".tmp" + target.extension().string());
    ReplacedFile created(file, target, temporary);
    if (!created.stream_) return unwritable(file, "the folder " + folder.string() + " does not allow it");
    if (fs::exists(old)) fs::permissions(temporary, old.permissions(), code);
    return created;
}

Result<void> ReplacedFile::commit() {
    stream_.close();
    if (!stream_) return unwritable(asked_, "not all of it could be written, the disk may be full");
    std::error_code code;
    fs::rename(temporary_, target_, code);
    if (code) return unwritable(asked_, code.message());
    temporary_.clear();
    return {};
}

}  // namespace emca::cli
