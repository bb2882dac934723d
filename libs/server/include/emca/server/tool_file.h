#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "emca/server/server_tool.h"

namespace emca {

/// A server tool in a file of its own: a shared library that exports one object, `emca_server_tool`. The macro at the end
/// makes it. Such a tool answers requests; the recording of a replay it cannot reach (its emca::recorder() is its own), so
/// that a tool which adds data while pixels are replayed is linked into the renderer instead.
inline constexpr std::uint32_t kToolInterface = 1;            ///< raised with every change of ServerTool and what it uses
inline constexpr const char* kToolVersion = "0.1.0";          ///< EMCA's; both sides have the same

/// What differs between compilers and standard libraries, so that objects of one cannot be used by the other.
constexpr const char* toolBinaryInterface() {
#if defined(_LIBCPP_VERSION) && defined(__LP64__)
    return "itanium, libc++, 64 bit";
#elif defined(__GLIBCXX__) && defined(__LP64__) && !defined(_GLIBCXX_DEBUG) && _GLIBCXX_USE_CXX11_ABI
    return "itanium, libstdc++, 64 bit";
#else
    return "unknown";
#endif
}

/// The exported object: plain data, read before anything of the tool is called.
struct ToolEntry {
    char magic[8];                   ///< "EMCAtool"
    std::uint32_t bytes;             ///< sizeof(ToolEntry)
    std::uint32_t interfaceVersion;  ///< kToolInterface
    const char* emca;                ///< kToolVersion
    const char* binary;              ///< toolBinaryInterface()
    ServerTool* (*make)();           ///< with new; may throw
};

/// Loads a tool. Its library stays loaded until the process ends.
/// Errors: fileNotFound; fileUnreadable (no shared library, or what the system says); notSupported (no tool inside, or
/// one for another version); rendererFailed (it threw).
Result<std::shared_ptr<ServerTool>> loadTool(const std::filesystem::path& file);

}  // namespace emca

/// Once in one source file, outside of all namespaces. \param make  a function emca::ServerTool*()
#define EMCA_SERVER_TOOL(make)                                                                              \
    extern "C" __attribute__((visibility("default"))) const ::emca::ToolEntry emca_server_tool;             \
    const ::emca::ToolEntry emca_server_tool = {{'E', 'M', 'C', 'A', 't', 'o', 'o', 'l'}, sizeof(::emca::ToolEntry), \
                                                ::emca::kToolInterface, ::emca::kToolVersion, ::emca::toolBinaryInterface(), make};
