#include "image_file.h"

#include "emca/imageio/imageio.h"

namespace emca::bridge {

Result<FolderMapping> FolderMapping::parse(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        return Error{ErrorCode::invalidArgument, "--image-folder \"" + text + "\" is no mapping: write FROM=TO, a folder of the server's machine and the same one here."};
    }
    return FolderMapping{text.substr(0, equals), text.substr(equals + 1)};
}

std::filesystem::path localPath(const std::string& path, const std::vector<FolderMapping>& mappings) {
    const FolderMapping* best = nullptr;
    for (const FolderMapping& mapping : mappings) {
        const std::size_t size = mapping.from.size();
        const bool inside = path.starts_with(mapping.from) && (mapping.from.back() == '/' || path.size() == size || path[size] == '/');
        if (inside && (best == nullptr || size > best->from.size())) best = &mapping;
    }
    if (best == nullptr) return path;
    const std::size_t rest = path.find_first_not_of('/', best->from.size());
    return rest == std::string::npos ? best->to : best->to / path.substr(rest);
}

Result<Image> readPublishedImage(const std::string& path, const std::vector<FolderMapping>& mappings) {
    const std::filesystem::path file = localPath(path, mappings);
    auto read = imageio::read(file);
    if (!read) {
        return Error{read.error().code, "The published server says that its image is \"" + path + "\" on its own disk, which cannot be read here" +
                                            (file == path ? "" : " as \"" + file.string() + "\"") + " (" + read.error().message +
                                            "): start the bridge on that machine, or share the folder and name it with --image-folder FROM=TO."};
    }
    Image image(read->width(), read->height());
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) image.setColor({x, y}, read->color({x, y}));
    return image;
}

}  // namespace emca::bridge
