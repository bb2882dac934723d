#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "emca/core/result.h"

namespace emca {

/// A file that appears, or takes the place of an older one, when it is complete: until commit() it is written beside its
/// place under another name, which goes away if nothing is committed. Who reads sees the old file or the new one, never
/// a part. A symbolic link stays, what it means is replaced; the new file has the permissions of the old one. One thread
/// at a time.
class ReplacedFile {
  public:
    /// Makes the temporary file, empty.
    /// \param noun  what sentences call it: "file", "image", "session"
    /// Errors: fileUnwritable (no such folder, no permission, something there that is no file).
    static Result<ReplacedFile> create(const std::filesystem::path& file, std::string noun = "file");
    /// Whether a file can be written there, asked before long work. Leaves nothing behind. Errors as create(), and
    /// where there is no room for a byte.
    static Result<void> check(const std::filesystem::path& file, std::string noun = "file");
    ~ReplacedFile();
    ReplacedFile(ReplacedFile&& other) noexcept;
    ReplacedFile& operator=(ReplacedFile&&) = delete;

    /// Where to write, either into the stream or, for a library that wants a name, into the file of that name.
    std::ofstream& stream() { return stream_; }
    const std::filesystem::path& temporary() const { return temporary_; }
    const std::filesystem::path& target() const { return target_; }   ///< where commit() puts it
    /// Errors: fileUnwritable (the disk is full, for instance); the older file is as it was.
    Result<void> commit();

  private:
    ReplacedFile(std::filesystem::path asked, std::filesystem::path target, std::string noun);
    Error unwritable(const std::string& why) const;
    std::filesystem::path asked_, target_, temporary_;  // no temporary: committed or never made
    std::filesystem::file_status old_;
    std::string noun_;
    std::ofstream stream_;
};

}  // namespace emca
