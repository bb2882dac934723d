#include "format_module.h"

#include <dlfcn.h>
#include <link.h>

#include <cstddef>
#include <future>
#include <string>
#include <system_error>
#include <vector>

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

/// Where the dynamic linker looks for libraries of the object that this code was linked into: its RUNPATH above all.
/// Not left to dlopen(), which sanitizers take over and then call on behalf of themselves.
void addLinkerFolders(link_map* object, std::vector<fs::path>& folders) {
    Dl_serinfo size{};
    if (dlinfo(object, RTLD_DI_SERINFOSIZE, &size) != 0) return;
    std::vector<std::max_align_t> memory(size.dls_size / sizeof(std::max_align_t) + 1);
    auto* const list = reinterpret_cast<Dl_serinfo*>(memory.data());
    if (dlinfo(object, RTLD_DI_SERINFOSIZE, list) != 0 || dlinfo(object, RTLD_DI_SERINFO, list) != 0) return;
    const Dl_serpath* const first = list->dls_serpath;
    for (unsigned i = 0; i < list->dls_cnt; ++i) folders.emplace_back(first[i].dls_name);
}

/// First where the linker's paths lead, then beside the program, then as in an installation.
std::vector<fs::path> searchFolders() {
    std::vector<fs::path> folders;
    Dl_info info{};
    void* object = nullptr;
    if (dladdr1(reinterpret_cast<const void*>(&formatModule), &info, &object, RTLD_DL_LINKMAP) == 0) return folders;
    addLinkerFolders(static_cast<link_map*>(object), folders);
    // A program's own name is as it was called; the kernel knows where it is.
    std::error_code code;
    fs::path self = info.dli_fname;
    if (!self.is_absolute()) self = fs::read_symlink("/proc/self/exe", code);
    if (code) return folders;
    folders.push_back(self.parent_path());
    folders.push_back(self.parent_path().parent_path() / EMCA_FORMAT_MODULE_FOLDER);
    return folders;
}

void* open(std::string& why) {
    why = "it is not there";
    for (const fs::path& folder : searchFolders()) {
        std::error_code code;
        const fs::path file = folder / kFile;
        if (folder.empty() || !fs::exists(file, code)) continue;
        if (void* library = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL)) return library;
        const char* error = dlerror();
        why = error ? error : "no reason was given";
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
    return extension == ".exr" || extension == ".pfm" || extension == ".jpg" || extension == ".jpeg";
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
