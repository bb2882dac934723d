#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/image.h"
#include "emca/core/result.h"
#include "emca/imageio/stored_image.h"

namespace emca::imageio {

// OpenEXR with its own library: what nearly every EXR is, one part of half or float channels. The rest (several parts,
// deep pixels, whole numbers, subsampled channels) is left to the module.

/// Whether a file begins as one.
bool isExr(const std::filesystem::path& file);

/// Nothing for the kinds that are left to the module.
/// Errors: fileUnreadable, tooLarge, outOfMemory.
Result<std::optional<StoredImage>> readExr(const std::filesystem::path& file, std::uintmax_t fileBytes);

/// 32-bit floats, all channels, zip.
/// Errors: fileUnwritable, outOfMemory; invalidArgument (channels without name or with the same one).
Result<void> writeExr(const std::filesystem::path& file, const Image& image);

/// What OpenEXR says of a file, without the file's name in front, which our sentences have already.
std::string exrReason(const std::filesystem::path& file, const std::string& message);

/// Order in which StoredImage has its channels (see there).
std::vector<std::string> inLayerOrder(std::vector<std::string> channels);

/// Index of the first channel of opacity, or -1.
int alphaOf(const std::vector<std::string>& channels);

}  // namespace emca::imageio
