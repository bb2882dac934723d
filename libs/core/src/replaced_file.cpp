#include "emca/core/replaced_file.h"

#include <atomic>
#include <random>
#include <utility>

namespace emca {

namespace {

namespace fs = std::filesystem;

/// A name beside the file that no other thread or program uses at the same time.
fs::path temporaryBeside(const fs::path& file) {
    static const unsigned program = std::random_device()();
    static std::atomic<unsigned> counter{0};
    return file.parent_path() / ("." + file.stem().string() + "." + std::to_string(program) + "-" +
                                 std::to_string(counter++) + ".tmp" + file.extension().string());
}

/// The file that is replaced: through a link to what it means; the link stays.
fs::path targetOf(const fs::path& asked) {
    std::error_code code;
    return fs::is_symlink(asked, code) ? fs::weakly_canonical(asked, code) : asked;
}

}  // namespace

ReplacedFile::ReplacedFile(fs::path asked, fs::path target, std::string noun)
    : asked_(std::move(asked)), target_(std::move(target)), noun_(std::move(noun)) {}

ReplacedFile::ReplacedFile(ReplacedFile&& other) noexcept
    : asked_(std::move(other.asked_)), target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, fs::path())), old_(other.old_), noun_(std::move(other.noun_)),
      stream_(std::move(other.stream_)) {}

ReplacedFile::~ReplacedFile() {
    if (temporary_.empty()) return;
    stream_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

Error ReplacedFile::unwritable(const std::string& why) const {
    return {ErrorCode::fileUnwritable, "The " + noun_ + " " + asked_.string() + " cannot be written: " + why + "."};
}

Result<ReplacedFile> ReplacedFile::create(const fs::path& file, std::string noun) {
    ReplacedFile created(file, targetOf(file), std::move(noun));
    const fs::path& target = created.target_;
    std::error_code code;
    created.old_ = fs::status(target, code);
    if (fs::exists(created.old_) && !fs::is_regular_file(created.old_))
        return created.unwritable("there is something of that name that is not a file");
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code)) return created.unwritable("there is no folder " + folder.string());
    // Trying is the only answer that counts permissions and read-only file systems alike.
    const fs::path temporary = temporaryBeside(target);
    created.stream_.open(temporary, std::ios::binary);
    if (!created.stream_) return created.unwritable("the folder " + folder.string() + " does not allow it");
    created.temporary_ = temporary;
    // What nobody else might read stays so meanwhile; exact permissions come at the end, as the owner must write now.
    if (fs::exists(created.old_)) fs::permissions(temporary, created.old_.permissions() | fs::perms::owner_write, code);
    return created;
}

Result<void> ReplacedFile::check(const fs::path& file, std::string noun) {
    auto probe = create(file, std::move(noun));
    if (!probe) return probe.error();
    if (probe->stream_.put('\n').flush()) return {};
    const fs::path folder = probe->target_.has_parent_path() ? probe->target_.parent_path() : fs::path(".");
    return probe->unwritable("the folder " + folder.string() + " does not allow it");
}

Result<void> ReplacedFile::commit() {
    if (stream_.is_open()) stream_.close();  // whoever wrote by name may have closed it
    if (!stream_) return unwritable("not all of it could be written, the disk may be full");
    std::error_code code;
    if (fs::exists(old_)) fs::permissions(temporary_, old_.permissions(), code);
    fs::rename(temporary_, target_, code);
    if (code) return unwritable(code.message());
    temporary_.clear();
    return {};
}

}  // namespace emca
