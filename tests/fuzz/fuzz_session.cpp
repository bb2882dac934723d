// Any file: refused, or opened so that everything in it can be read, saved and opened again. Each input is tried as it is
// and with its checksums made right, since mutations alone would never come past them.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "emca/client/session.h"
#include "session_layout.h"
#include "session_save.h"

namespace {

using namespace emca;
using namespace emca::client;

/// A file in memory that has a name.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(::memfd_create("session", 0)) {}
    ~MemoryFile() { ::close(descriptor_); }
    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
    void put(const std::vector<std::byte>& bytes) const {
        if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) < 0) std::abort();
    }

  private:
    int descriptor_;
};

void putNumber(std::byte* at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) at[i] = std::byte(value >> (8 * i) & 0xff);
}

/// Makes the checksums right wherever a header stands, as a reader would find them.
void seal(std::vector<std::byte>& file) {
    const auto sealAt = [&](std::size_t begin, std::size_t size) {
        putNumber(&file[begin + size - 4], checksum({&file[begin], size - 4}));
    };
    if (file.size() < kFileHeaderBytes) return;
    std::memcpy(file.data(), kMagic.data(), kMagic.size());
    file[8] = std::byte(1), file[9] = std::byte(0);
    sealAt(0, kFileHeaderBytes);
    std::size_t at = kFileHeaderBytes;
    while (file.size() - at >= kBlockHeaderBytes) {
        std::memcpy(&file[at], "EBLK", 4);
        std::uint64_t stored = 0;
        for (int i = 0; i < 8; ++i) stored |= std::to_integer<std::uint64_t>(file[at + 16 + i]) << (8 * i);
        const std::size_t rest = file.size() - at - kBlockHeaderBytes;
        if (stored <= rest) putNumber(&file[at + 12], checksum({file.data() + at + kBlockHeaderBytes, stored}));
        sealAt(at, kBlockHeaderBytes);
        if (stored > rest) return;
        at += kBlockHeaderBytes + stored;
    }
}

volatile double sink = 0;

void readEverything(const Session& session) {
    double sum = 0;
    for (const ImageEntry& entry : session.images) {
        for (const Image* plane : {&entry.image->color, &entry.image->samples, &entry.image->variance}) {
            for (std::size_t i = 0; i < plane->size(); ++i) sum += static_cast<double>(plane->data()[i]);
        }
    }
    for (const auto& trace : session.traces) {
        const PathSet& paths = trace->paths;
        for (Index p = 0; p < paths.pathCount(); ++p) sum += paths.depth(p) + paths.vertices(p).size();
        for (const Column& column : paths.userColumns()) {
            for (Index i = 0; i < column.count; ++i) sum += static_cast<double>(paths.value(column, i).index() + column.owner(i));
        }
    }
    for (const std::size_t index : session.shown) sum += session.traces.at(index)->renderSeconds;
    if (session.meshes) for (const Mesh& mesh : *session.meshes) if (!validate(mesh)) std::abort();
    if (session.surface && (!session.meshes || !validate(*session.surface, *session.meshes))) std::abort();
    sink = sum;
}

void openIt(const MemoryFile& file) {
    OpenOptions options;
    options.maximumBytes = 64u << 20;
    const auto opened = openSession(file.path(), options);
    if (!opened) return;
    if (!opened->whole && opened->notices.empty()) std::abort();
    readEverything(opened->session);
    Dataset dataset;
    Selection selection;
    show(opened->session, dataset, selection);
    // What was read can be saved, except an image whose pixels did not come, and comes back.
    static const std::filesystem::path again = std::filesystem::temp_directory_path() / ("fuzz_session." + std::to_string(::getpid()));
    static int runs = 0;
    if (++runs % 64 != 0) return;  // the disk is slow
    if (!saveSession(again, opened->session, {}, {}, 0, "")) std::abort();
    const auto second = openSession(again);
    if (!second || !second->whole || second->session.traces.size() != opened->session.traces.size()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MemoryFile file;
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(begin, begin + size);
    file.put(bytes);
    openIt(file);
    seal(bytes);
    file.put(bytes);
    openIt(file);
    return 0;
}
