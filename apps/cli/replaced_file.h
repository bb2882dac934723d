#pragma once

#include <filesystem>
#include <fstream>

#include "emca/core/result.h"

namespace emca::cli {

/// A file that appears, or takes the place of an older one, when it is complete: until commit() it is written beside its
/// place under another name, which goes away if nothing is committed.
class ReplacedFile {
  public:
    /// Errors: fileUnwritable (no such folder, no permission, something there that is no file).
    static Result<ReplacedFile> create(const std::filesystem::path& file);
    ~ReplacedFile();
    ReplacedFile(ReplacedFile&& other) noexcept;
    ReplacedFile& operator=(ReplacedFile&&) = delete;

    std::ofstream& stream() { return stream_; }
    /// Errors: fileUnwritable (the disk is full, for instance).
    Result<void> commit();

  private:
    ReplacedFile(std::filesystem::path asked, std::filesystem::path target, std::filesystem::path temporary);
    std::filesystem::path asked_, target_, temporary_;  // no temporary: committed
    std::ofstream stream_;
};

}  // namespace emca::cli
