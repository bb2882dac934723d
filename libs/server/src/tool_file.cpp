#include "emca/server/tool_file.h"

#include <dlfcn.h>

#include <cstring>
#include <exception>

namespace emca {

namespace {

Error notATool(const std::filesystem::path& file, const std::string& why) {
    return {ErrorCode::notSupported, "The server tool " + file.string() + " cannot be used: " + why};
}

/// Why the entry does not fit, or empty.
std::string obstacle(const ToolEntry& entry) {
    if (std::memcmp(entry.magic, "EMCAtool", sizeof entry.magic) != 0) return "it holds no tool of EMCA.";
    if (entry.bytes != sizeof(ToolEntry) || entry.interfaceVersion != kToolInterface) {
        return "it was built for interface " + std::to_string(entry.interfaceVersion) + ", but this is interface " +
               std::to_string(kToolInterface) + "; build it again.";
    }
    if (std::strcmp(entry.emca, kToolVersion) != 0) {
        return std::string("it was built for EMCA ") + entry.emca + ", but this is " + kToolVersion + "; build it again.";
    }
    if (std::strcmp(entry.binary, toolBinaryInterface()) != 0) {
        return std::string("it was built by another kind of compiler (") + entry.binary + " in the place of " + toolBinaryInterface() + ").";
    }
    return entry.make ? "" : "it makes no tool.";
}

}  // namespace

Result<std::shared_ptr<ServerTool>> loadTool(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        return Error{ErrorCode::fileNotFound, "There is no server tool " + file.string() + ": give the path of a shared library."};
    }
    // With a slash the system does not search its own folders.
    void* library = dlopen(std::filesystem::absolute(file, ignored).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char* why = dlerror();
        return Error{ErrorCode::fileUnreadable, "The server tool " + file.string() + " cannot be loaded: " + (why ? why : "the system does not say why.")};
    }
    const auto* entry = static_cast<const ToolEntry*>(dlsym(library, "emca_server_tool"));
    const std::string why = entry ? obstacle(*entry) : "it holds no tool of EMCA.";
    if (!why.empty()) {
        dlclose(library);
        return notATool(file, why);
    }
    try {
        // Code of the tool may still be in use when the last pointer to it goes, so the library stays.
        if (ServerTool* tool = entry->make()) return std::shared_ptr<ServerTool>(tool);
        return notATool(file, "it made no tool.");
    } catch (const std::exception& exception) {
        return Error{ErrorCode::rendererFailed, "The server tool " + file.string() + " failed when it was made: " + exception.what()};
    } catch (...) {
        return Error{ErrorCode::rendererFailed, "The server tool " + file.string() + " failed when it was made."};
    }
}

}  // namespace emca
