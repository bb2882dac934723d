#include <array>
#include <new>

#include "emca/render/mesh_files.h"
#include "file_bytes.h"
#include "mesh_cleanup.h"
#include "text_cursor.h"

namespace emca::render {

namespace {

constexpr std::int64_t kAbsent = -1;
constexpr std::uint32_t kNoVertex = 0xffffffffu;

/// Positions in the file's lists of positions, uvs and normals, from 0; kAbsent if not given.
using Corner = std::array<std::int64_t, 3>;

/// Gives each distinct corner a number. Open addressing: corners are many and looked up once each.
class CornerTable {
  public:
    CornerTable() : slots_(1024, kNoVertex) {}

    std::uint32_t indexOf(const Corner& corner) {
        if (corners_.size() * 2 >= slots_.size())
            grow();
        for (std::size_t slot = hash(corner) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
            if (slots_[slot] == kNoVertex) {
                slots_[slot] = static_cast<std::uint32_t>(corners_.size());
                corners_.push_back(corner);
                return slots_[slot];
            }
            if (corners_[slots_[slot]] == corner)
                return slots_[slot];
        }
    }
    const std::vector<Corner>& corners() const { return corners_; }

  private:
    static std::size_t hash(const Corner& corner) {
        std::uint64_t h = 0;
        for (const auto index : corner) {
            h = (h ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
            h ^= h >> 29;
        }
        return static_cast<std::size_t>(h);
    }

    void grow() {
        std::vector<std::uint32_t> larger(slots_.size() * 2, kNoVertex);
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            std::size_t slot = hash(corners_[i]) & (larger.size() - 1);
            while (larger[slot] != kNoVertex)
                slot = (slot + 1) & (larger.size() - 1);
            larger[slot] = static_cast<std::uint32_t>(i);
        }
        slots_ = std::move(larger);
    }

    std::vector<std::uint32_t> slots_;
    std::vector<Corner> corners_;
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const MeshFileOptions& options, const std::filesystem::path& path)
        : cursor_(text), options_(options), path_(path) {}

    Result<LoadedMesh> read() {
        for (; !cursor_.atEnd(); cursor_.skipLine()) {
            const std::string_view keyword = cursor_.word();
            bool good = true;
            if (keyword == "v")
                good = readNumbers<3>(positions_, 3);
            else if (keyword == "vt")
                good = readNumbers<2>(uvs_, 1);
            else if (keyword == "vn")
                good = readNumbers<3>(normals_, 3);
            else if (keyword == "f")
                good = readFace();
            if (!good)
                return failure(keyword);
            if (corners_.corners().size() >= kNoVertex)
                return Error{ErrorCode::tooLarge, '"' + path_.string() + "\" has more than 2^32 vertices."};
        }
        auto loaded = cleanUp(makeMesh(), options_, path_);
        if (loaded && facesWithoutArea_ > 0)
            loaded->warnings.push_back(std::to_string(facesWithoutArea_) + " faces of \"" + path_.string() +
                                       "\" have fewer than three corners and are left out.");
        return loaded;
    }

  private:
    template <std::size_t count>
    bool readNumbers(std::vector<std::array<float, count>>& list, std::size_t needed) {
        std::array<float, count> values{};
        for (std::size_t i = 0; i < count; ++i) {
            cursor_.skipBlanks();
            double value = 0;
            if (!cursor_.number(value)) {
                if (i < needed || !cursor_.atLineEnd())
                    return false;
                break;
            }
            values[i] = static_cast<float>(value);
        }
        list.push_back(values);
        return true;
    }

    /// "f 1/2/3 4//5 -1 …" as a fan of triangles around its first corner.
    bool readFace() {
        std::uint32_t first = 0, previous = 0;
        std::size_t count = 0;
        for (; !cursor_.atLineEnd(); ++count) {
            Corner corner{kAbsent, kAbsent, kAbsent};
            if (!readCorner(corner))
                return false;
            const std::uint32_t index = corners_.indexOf(corner);
            if (count == 0)
                first = index;
            if (count >= 2)
                triangles_.push_back({first, previous, index});
            previous = index;
        }
        facesWithoutArea_ += count < 3;
        return count > 0;
    }

    bool readCorner(Corner& corner) {
        if (!readIndex(positions_.size(), corner[0]))
            return false;
        // "1/" and "1/2/" are written by some programs.
        const bool withUv = cursor_.take('/') && !atCornerEnd() && !cursor_.rest().starts_with('/');
        if (withUv && !readIndex(uvs_.size(), corner[1]))
            return false;
        if (cursor_.take('/') && !atCornerEnd() && !readIndex(normals_.size(), corner[2]))
            return false;
        if (options_.faceNormals)
            corner[2] = kAbsent;
        return atCornerEnd();
    }

    bool atCornerEnd() const {
        const auto rest = cursor_.rest();
        return rest.empty() || rest[0] == ' ' || rest[0] == '\t' || rest[0] == '\r' || rest[0] == '\n';
    }

    /// From 1, or negative from the end of what was listed so far. Beyond the list: a corner that cannot be, so that
    /// the face is dropped later, as positive ones may refer to what comes later in the file.
    bool readIndex(std::size_t listed, std::int64_t& index) {
        std::int64_t written = 0;
        if (!cursor_.integer(written))
            return false;
        index = written > 0 ? written - 1 : written < 0 ? static_cast<std::int64_t>(listed) + written : kInvalid;
        if (index < 0)
            index = kInvalid;
        return true;
    }

    TriangleMesh makeMesh() {
        TriangleMesh mesh;
        const auto& corners = corners_.corners();
        const bool withUvs = !uvs_.empty(), withNormals = !normals_.empty() && !options_.faceNormals;
        mesh.positions.reserve(corners.size());
        mesh.uvs.reserve(withUvs ? corners.size() : 0);
        mesh.normals.reserve(withNormals ? corners.size() : 0);
        bool allListed = true;
        for (const auto& corner : corners) {
            const auto& [v, vt, vn] = corner;
            const bool good = isListed(corner);
            allListed = allListed && good;
            mesh.positions.push_back(good ? toVector(positions_[static_cast<std::size_t>(v)]) : Vec3f{});
            if (withUvs)
                mesh.uvs.push_back(good && vt != kAbsent ? toUv(uvs_[static_cast<std::size_t>(vt)]) : Vec2f{});
            if (withNormals)
                mesh.normals.push_back(good && vn != kAbsent ? toVector(normals_[static_cast<std::size_t>(vn)]) : Vec3f{});
        }
        mesh.triangles = std::move(triangles_);
        if (!allListed)
            for (auto& triangle : mesh.triangles)
                for (auto& index : triangle)
                    if (!isListed(corners[index]))
                        index = kNoVertex;  // cleanUp() drops the triangle and says so
        return mesh;
    }

    /// Whether all that a corner names is in the file. A uv or normal that is not spoils the face as a position does.
    bool isListed(const Corner& corner) const {
        const auto listed = [](const auto& list, std::int64_t i) { return i >= 0 && static_cast<std::size_t>(i) < list.size(); };
        return listed(positions_, corner[0]) && (corner[1] == kAbsent || listed(uvs_, corner[1])) &&
               (corner[2] == kAbsent || listed(normals_, corner[2]));
    }

    static Vec3f toVector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }
    static Vec2f toUv(const std::array<float, 2>& a) { return {a[0], a[1]}; }

    Error failure(std::string_view keyword) const {
        const char* expected = keyword == "f"    ? "three or more corners such as 1, 1/2, 1//3 or 1/2/3"
                               : keyword == "vt" ? "one to three numbers"
                                                 : "three numbers";
        return {ErrorCode::fileUnreadable, path_.string() + ":" + std::to_string(cursor_.line()) + ": after \"" +
                                               std::string(keyword) + "\" an OBJ file has " + expected + '.'};
    }

    static constexpr std::int64_t kInvalid = -2;

    TextCursor cursor_;
    const MeshFileOptions& options_;
    const std::filesystem::path& path_;
    std::vector<std::array<float, 3>> positions_, normals_;
    std::vector<std::array<float, 2>> uvs_;
    CornerTable corners_;
    std::vector<Triangle> triangles_;
    std::size_t facesWithoutArea_ = 0;
};

}  // namespace

Result<LoadedMesh> loadObj(const std::filesystem::path& path, const MeshFileOptions& options) try {
    const auto bytes = readFileBytes(path, kMaxMeshFileBytes);
    if (!bytes)
        return bytes.error();
    return ObjReader(*bytes, options, path).read();
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::outOfMemory, "Not enough memory for the mesh \"" + path.string() + "\"."};
}

}  // namespace emca::render
