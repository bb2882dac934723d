#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "emca/core/result.h"
#include "emca/imageio/stored_image.h"

namespace emca::imageio {

/// What the module with all formats but EXR and PFM offers. It is a library of its own that is loaded when it is first
/// needed: OpenImageIO brings some 250 other libraries along, whose loading takes longer than most questions to `emca`.
/// Both sides are built together from these headers; nothing is thrown across.
struct FormatModule {
    const char* version;  ///< kFormatModuleVersion of its build

    /// \param fileBytes  size of the file, to judge its header by
    /// \param keepBytes  whether 8 bits stay bytes; otherwise all values become floats
    /// Errors: fileUnreadable, tooLarge, outOfMemory.
    Result<StoredImage> (*read)(const std::filesystem::path& file, std::uintmax_t fileBytes, bool keepBytes) noexcept;

    /// Writes the bytes or floats, whichever there are; bytes are sRGB-encoded.
    /// \param format  OpenImageIO's name of it, e.g. "png"
    /// Errors: fileUnwritable, notSupported, outOfMemory.
    Result<void> (*write)(const std::filesystem::path& file, const char* format, const StoredImage& image) noexcept;
};

/// Changes with each release; to be changed by hand where FormatModule or a type in it changes between releases.
inline constexpr std::string_view kFormatModuleVersion = EMCA_VERSION " (1)";

/// The module's one public name.
inline constexpr const char* kFormatModuleFunction = "emcaImageFormatModule";
using FormatModuleFunction = const FormatModule* (*)() noexcept;

/// The module, loaded at the first call. Any thread; the others wait meanwhile.
/// Errors: notSupported, with a clause that says what is missing, without a full stop.
const Result<const FormatModule*>& formatModule();

}  // namespace emca::imageio
