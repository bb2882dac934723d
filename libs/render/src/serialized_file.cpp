#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include "emca/render/mesh_files.h"
#include "mesh_cleanup.h"

namespace emca::render {

namespace {

static_assert(std::endian::native == std::endian::little, "serialized meshes are read as on a little-endian machine");

constexpr std::uint16_t kMagic = 0x041c;

// Bits of the flags of a mesh.
constexpr std::uint32_t kHasNormals = 0x1, kHasUvs = 0x2, kHasColors = 0x8, kFaceNormals = 0x10, kDoublePrecision = 0x2000;

/// A file of which parts are read: one file often holds hundreds of meshes.
class BinaryFile {
  public:
    explicit BinaryFile(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "rb"), &closeFile) {
        if (file_ && fseeko(file_.get(), 0, SEEK_END) == 0)
            size_ = std::max<off_t>(0, ftello(file_.get()));
    }
    bool isOpen() const { return file_ != nullptr; }
    std::uint64_t size() const { return static_cast<std::uint64_t>(size_); }

    bool read(std::uint64_t offset, void* into, std::size_t bytes) {
        return offset <= size() && bytes <= size() - offset && fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0 &&
               std::fread(into, 1, bytes, file_.get()) == bytes;
    }

  private:
    static void closeFile(std::FILE* file) { std::fclose(file); }
    std::unique_ptr<std::FILE, void (*)(std::FILE*)> file_;
    off_t size_ = 0;
};

/// Inflates a part of a file piece by piece.
class InflatedStream {
  public:
    InflatedStream(BinaryFile& file, std::uint64_t begin, std::uint64_t end) : file_(file), at_(begin), end_(end), buffer_(1 << 16) {
        good_ = inflateInit(&stream_) == Z_OK;
        initialised_ = good_;
    }
    ~InflatedStream() {
        if (initialised_)
            inflateEnd(&stream_);
    }
    InflatedStream(const InflatedStream&) = delete;
    InflatedStream& operator=(const InflatedStream&) = delete;

    /// False if the stream is damaged or ends before.
    bool read(void* into, std::size_t bytes) {
        auto* out = static_cast<Bytef*>(into);
        while (good_ && bytes > 0) {
            if (stream_.avail_in == 0 && !refill())
                return good_ = false;
            const auto piece = static_cast<uInt>(std::min<std::size_t>(bytes, std::numeric_limits<uInt>::max()));
            stream_.next_out = out;
            stream_.avail_out = piece;
            const int status = inflate(&stream_, Z_NO_FLUSH);
            const std::size_t got = piece - stream_.avail_out;
            out += got;
            bytes -= got;
            good_ = status == Z_OK || (status == Z_BUF_ERROR && stream_.avail_in == 0) || (status == Z_STREAM_END && bytes == 0);
        }
        return good_;
    }

    template <typename T>
    bool read(T& value) { return read(&value, sizeof(T)); }

  private:
    bool refill() {
        const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size(), end_ - at_));
        if (piece == 0 || !file_.read(at_, buffer_.data(), piece))
            return false;
        at_ += piece;
        stream_.next_in = buffer_.data();
        stream_.avail_in = static_cast<uInt>(piece);
        return true;
    }

    BinaryFile& file_;
    std::uint64_t at_, end_;
    std::vector<Bytef> buffer_;
    z_stream stream_{};
    bool good_ = false, initialised_ = false;
};

/// Where the compressed part of one mesh lies.
struct MeshRange { std::uint64_t begin = 0, end = 0; std::uint16_t version = 0; };

class SerializedReader {
  public:
    SerializedReader(const std::filesystem::path& path, const MeshFileOptions& options) : path_(path), options_(options) {}

    Result<LoadedMesh> read() {
        BinaryFile file(path_);
        const auto range = findMesh(file);
        if (!range)
            return range.error();
        InflatedStream stream(file, range->begin, range->end);
        return readMesh(stream, range->version);
    }

  private:
    Result<MeshRange> findMesh(BinaryFile& file) const {
        std::array<std::uint16_t, 2> head{};
        std::uint32_t count = 0;
        if (file.size() < 12 || !file.read(0, head.data(), 4) || head[0] != kMagic)
            return failure("is not a .serialized file of Mitsuba");
        const std::uint16_t version = head[1];
        if (version != 3 && version != 4)
            return failure("has version " + std::to_string(version) + "; 3 and 4 are known");
        const std::uint64_t entry = version == 4 ? 8 : 4;
        if (!file.read(file.size() - 4, &count, 4) || count == 0 || count > (file.size() - 8) / entry)
            return failure("has a damaged table of meshes at its end");
        if (options_.shapeIndex >= count)
            return failure("has " + std::to_string(count) + " meshes; shape_index " + std::to_string(options_.shapeIndex) +
                           " is not one of them (counted from 0)");
        const std::uint64_t table = file.size() - 4 - entry * count;
        const auto offset = [&](std::uint64_t index) {
            std::uint64_t value = 0;
            return index == count ? table : file.read(table + index * entry, &value, entry) ? value : file.size();
        };
        const std::uint64_t begin = offset(options_.shapeIndex), end = offset(options_.shapeIndex + 1);
        if (begin > table || table - begin < 4 || end <= begin || end > table || !file.read(begin, head.data(), 4) || head[0] != kMagic)
            return failure("has a damaged table of meshes at its end");
        return MeshRange{begin + 4, end, version};
    }

    Result<LoadedMesh> readMesh(InflatedStream& stream, std::uint16_t version) const {
        std::uint32_t flags = 0;
        std::uint64_t vertices = 0, triangles = 0;
        if (!stream.read(flags) || (version == 4 && !skipName(stream)) || !stream.read(vertices) || !stream.read(triangles))
            return damaged("its counts");
        constexpr std::uint64_t kLimit = std::numeric_limits<std::uint32_t>::max();
        if (vertices >= kLimit || triangles >= kLimit)
            return Error{ErrorCode::tooLarge, text() + " announces " + std::to_string(vertices) + " vertices and " +
                                                  std::to_string(triangles) + " triangles, more than 2^32."};
        TriangleMesh mesh;
        const bool good = (flags & kDoublePrecision) ? readVertices<double>(stream, flags, vertices, mesh)
                                                     : readVertices<float>(stream, flags, vertices, mesh);
        if (!good)
            return damaged("its " + std::to_string(vertices) + " vertices");
        if (!readArray(stream, triangles, mesh.triangles))
            return damaged("its " + std::to_string(triangles) + " triangles");
        MeshFileOptions options = options_;
        options.faceNormals = options.faceNormals || (flags & kFaceNormals);
        return cleanUp(std::move(mesh), options, path_);
    }

    static bool skipName(InflatedStream& stream) {
        char c = 1;
        while (c != 0)
            if (!stream.read(c))
                return false;
        return true;
    }

    template <typename T>
    static bool readVertices(InflatedStream& stream, std::uint32_t flags, std::uint64_t count, TriangleMesh& mesh) {
        std::vector<Vec3f> forgotten;
        return readComponents<T, 3>(stream, count, mesh.positions) &&
               (!(flags & kHasNormals) || readComponents<T, 3>(stream, count, mesh.normals)) &&
               (!(flags & kHasUvs) || readComponents<T, 2>(stream, count, mesh.uvs)) &&
               (!(flags & kHasColors) || readComponents<T, 3>(stream, count, forgotten));
    }

    // Memory grows with what the stream really holds: the announced counts may be anything.
    static constexpr std::size_t kPiece = std::size_t(1) << 18;

    template <typename T>
    static bool readArray(InflatedStream& stream, std::uint64_t count, std::vector<T>& array) {
        while (array.size() < count) {
            const std::size_t filled = array.size();
            array.resize(filled + static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, count - filled)));
            if (!stream.read(array.data() + filled, (array.size() - filled) * sizeof(T)))
                return false;
        }
        return true;
    }

    template <typename T, std::size_t n, typename Vector>
    static bool readComponents(InflatedStream& stream, std::uint64_t count, std::vector<Vector>& vectors) {
        std::vector<std::array<T, n>> piece;
        while (vectors.size() < count) {
            piece.clear();
            if (!readArray(stream, std::min<std::uint64_t>(kPiece, count - vectors.size()), piece))
                return false;
            for (const auto& a : piece) {
                if constexpr (n == 3)
                    vectors.push_back({static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])});
                else
                    vectors.push_back({static_cast<float>(a[0]), static_cast<float>(a[1])});
            }
        }
        return true;
    }

    std::string text() const {
        return '"' + path_.string() + "\" (mesh " + std::to_string(options_.shapeIndex) + ")";
    }
    Error failure(const std::string& what) const { return {ErrorCode::fileUnreadable, '"' + path_.string() + "\" " + what + '.'}; }
    Error damaged(const std::string& where) const {
        return {ErrorCode::fileUnreadable, text() + " is damaged or ends before the end of " + where + '.'};
    }

    const std::filesystem::path& path_;
    const MeshFileOptions& options_;
};

}  // namespace

Result<LoadedMesh> loadSerialized(const std::filesystem::path& path, const MeshFileOptions& options) try {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        return Error{ErrorCode::fileNotFound, "File \"" + path.string() + "\" does not exist."};
    if (!std::filesystem::is_regular_file(status) || !BinaryFile(path).isOpen())
        return Error{ErrorCode::fileUnreadable, '"' + path.string() + "\" is not a file that can be opened."};
    return SerializedReader(path, options).read();
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::outOfMemory, "Not enough memory for the mesh \"" + path.string() + "\"."};
}

}  // namespace emca::render
