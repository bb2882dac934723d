#include "file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <system_error>

namespace emca::render {

Result<std::string> readFileBytes(const std::filesystem::path& path, std::uint64_t limit) try {
    const std::string name = '"' + path.string() + '"';
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        return Error{ErrorCode::fileNotFound, "File " + name + " does not exist."};
    if (std::filesystem::is_directory(status))
        return Error{ErrorCode::fileUnreadable, name + " is a folder, not a file."};
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file)
        return Error{ErrorCode::fileUnreadable, "File " + name + " cannot be opened: " + std::strerror(errno) + '.'};
    // Grown while reading: the announced size of a pipe or of a file that changes means nothing.
    std::string bytes;
    std::uint64_t wanted = std::filesystem::file_size(path, error);
    if (error || wanted > limit)
        wanted = 0;
    for (std::size_t filled = 0;;) {
        bytes.resize(filled + (wanted > filled ? static_cast<std::size_t>(wanted - filled) + 1 : std::size_t(1) << 20));
        const std::size_t got = std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get());
        filled += got;
        if (filled > limit)
            return Error{ErrorCode::tooLarge, "File " + name + " has more than " + std::to_string(limit) + " bytes, the limit."};
        if (filled < bytes.size()) {
            bytes.resize(filled);
            break;
        }
    }
    if (std::ferror(file.get()))
        return Error{ErrorCode::fileUnreadable, "File " + name + " cannot be read: " + std::strerror(errno) + '.'};
    return bytes;
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::outOfMemory, "Not enough memory to read file \"" + path.string() + "\"."};
}

}  // namespace emca::render
