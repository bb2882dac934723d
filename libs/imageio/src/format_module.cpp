#include "format_module.h"

#include <dlfcn.h>

#include <array>
#include <future>
#include <string>
#include <system_error>

#include "emca/imageio/imageio.h"
#include "lower_case.h"

namespace emca::imageio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = EMCA_FORMAT_MODULE_FILE;

Error unavailable(const std::string& why) {
    return {ErrorCode::notSupported, std::string("formats other than EXR and PFM need ") + kFile +
                                         ", which cannot be loaded (" + why + "); install EMCA as a whole"};
}

/// Folder of the program or library that this code was linked into.
fs::path ownFolder() {
    Dl_info info{};
    std::error_code code;
    if (dladdr(reinterpret_cast<const void*>(&formatModule), &info) == 0 || !info.dli_fname) return {};
    // A program's own name is as it was called; the kernel knows where it is.
    if (const fs::path called = info.dli_fname; called.is_absolute()) return called.parent_path();
    return fs::read_symlink("/proc/self/exe", code).parent_path();
}

/// First where the linker's paths lead (RUNPATH of the program), then beside the program, then as in an installation.
void* open(std::string& why) {
    constexpr int kFlags = RTLD_LAZY | RTLD_LOCAL;
    const auto remember = [&] {
        const char* error = dlerror();
        why = error ? error : "no reason was given";
    };
    if (void* library = dlopen(kFile, kFlags)) return library;
    remember();
    const fs::path folder = ownFolder();
    if (folder.empty()) return nullptr;
    for (const fs::path& file : std::array{folder / kFile, folder.parent_path() / EMCA_FORMAT_MODULE_FOLDER / kFile}) {
        std::error_code code;
        if (!fs::exists(file, code)) continue;
        if (void* library = dlopen(file.c_str(), kFlags)) return library;
        remember();
    }
    return nullptr;
}

Result<const FormatModule*> load() {
    std::string why;
    void* const library = open(why);  // never closed: its code is in use until the end
    if (!library) return unavailable(why);
    const auto function = reinterpret_cast<FormatModuleFunction>(dlsym(library, kFormatModuleFunction));
    if (!function) return unavailable("it is no module of EMCA's");
    const FormatModule* const module = function();
    if (module->version != kFormatModuleVersion)
        return unavailable(std::string("it is of version ") + module->version + ", not " +
                           std::string(kFormatModuleVersion));
    return module;
}

/// Whether a name promises a format that needs no module.
bool isOurs(const fs::path& file) {
    const std::string extension = lowerCase(file.extension().string());
    return extension == ".exr" || extension == ".pfm";
}

}  // namespace

const Result<const FormatModule*>& formatModule() {
    static const Result<const FormatModule*> loaded = load();
    return loaded;
}

void prepareFor(const fs::path& file) {
    if (isOurs(file)) return;
    try {
        // The future waits at the end of the program, which must not pull the libraries from under the loader.
        static const std::future<void> loading = std::async(std::launch::async, [] { (void)formatModule(); });
    } catch (const std::system_error&) {
        // No thread to be had: the module is loaded when it is needed.
    }
}

}  // namespace emca::imageio
