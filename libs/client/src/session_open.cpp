#include <array>
#include <fstream>
#include <new>

#include "emca/client/session.h"
#include "session_parts.h"
#include "session_reader.h"

namespace emca::client {

namespace {

Result<OpenedSession> open(const std::filesystem::path& file, const OpenOptions& options, const RequestObserver& observer) {
    auto reader = SessionReader::open(file, options.maximumBytes);
    if (!reader) return reader.error();
    SessionReader& blocks = **reader;
    OpenedSession opened;
    PartCollector parts(opened, blocks.maximumBytes());
    while (auto block = blocks.next()) {
        parts.add(std::move(*block));
        if (observer.cancel && *observer.cancel) {
            return Error{ErrorCode::cancelled, "Opening the session " + file.string() + " was cancelled."};
        }
        if (observer.progress) observer.progress(static_cast<double>(blocks.position()) / static_cast<double>(blocks.bytes()));
    }
    parts.finish(blocks.endsEarly() ? std::optional(blocks.bytes()) : std::nullopt);
    if (!blocks.faults().empty()) opened.whole = false;
    opened.notices.insert(opened.notices.begin(), blocks.faults().begin(), blocks.faults().end());
    return opened;
}

}  // namespace

Result<OpenedSession> openSession(const std::filesystem::path& file, const OpenOptions& options, const RequestObserver& observer) {
    try {
        return open(file, options, observer);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::outOfMemory, "The session " + file.string() + " needs more memory than there is."};
    }
}

bool isSession(const std::filesystem::path& file) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return false;
    std::ifstream in(file, std::ios::binary);
    std::array<std::byte, kMagic.size()> begin{};
    in.read(reinterpret_cast<char*>(begin.data()), begin.size());
    return in.gcount() == static_cast<std::streamsize>(begin.size()) && beginsWithMagic(begin);
}

}  // namespace emca::client
