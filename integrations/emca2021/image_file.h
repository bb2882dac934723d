#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "emca/core/image.h"
#include "emca/core/result.h"

namespace emca::bridge {

/// Where a folder of the server's machine is on this one.
struct FolderMapping {
    std::string from;            ///< as the server writes it
    std::filesystem::path to;
    /// "FROM=TO". Errors: invalidArgument.
    static Result<FolderMapping> parse(const std::string& text);
};

/// The file here that a published server names by its own path: the longest mapped folder that the path is in counts.
std::filesystem::path localPath(const std::string& path, const std::vector<FolderMapping>& mappings);

/// Reads such a file as R, G, B. Errors: fileNotFound, fileUnreadable, notSupported, with what to do about it.
Result<Image> readPublishedImage(const std::string& path, const std::vector<FolderMapping>& mappings);

}  // namespace emca::bridge
