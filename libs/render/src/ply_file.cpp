#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <new>

#include "emca/render/mesh_files.h"
#include "file_bytes.h"
#include "mesh_cleanup.h"
#include "ply_header.h"
#include "text_cursor.h"

namespace emca::render {

namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY files are read as on a little-endian machine");

/// Values of a binary file one after the other. After its end: false.
class BinaryValues {
  public:
    BinaryValues(std::string_view data, bool swap) : data_(data), swap_(swap) {}

    bool next(PlyType type, double& value) {
        switch (type) {
            case PlyType::int8: return load<std::int8_t>(value);
            case PlyType::uint8: return load<std::uint8_t>(value);
            case PlyType::int16: return load<std::int16_t>(value);
            case PlyType::uint16: return load<std::uint16_t>(value);
            case PlyType::int32: return load<std::int32_t>(value);
            case PlyType::uint32: return load<std::uint32_t>(value);
            case PlyType::float32: return load<float>(value);
            case PlyType::float64: return load<double>(value);
        }
        return false;
    }

  private:
    template <typename T>
    bool load(double& value) {
        if (data_.size() < sizeof(T))
            return false;
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), data_.data(), sizeof(T));
        if (swap_)
            for (std::size_t i = 0; i < sizeof(T) / 2; ++i)
                std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
        value = static_cast<double>(std::bit_cast<T>(bytes));
        data_.remove_prefix(sizeof(T));
        return true;
    }

    std::string_view data_;
    bool swap_;
};

/// Values of a text file. After its end, or at a word that is no number: false.
class TextValues {
  public:
    explicit TextValues(std::string_view data) : cursor_(data) {}

    bool next(PlyType, double& value) {
        cursor_.skipSpace();
        return cursor_.number(value);
    }

  private:
    TextCursor cursor_;
};

template <typename Values>
class PlyReader {
  public:
    PlyReader(Values values, const MeshFileOptions& options, const std::filesystem::path& path)
        : values_(std::move(values)), options_(options), path_(path) {}

    Result<LoadedMesh> read(const PlyHeader& header) {
        for (const auto& element : header.elements) {
            if (element.properties.empty())
                continue;
            const auto done = element.name == "vertex" ? readVertices(element)
                              : element.name == "face" ? readFaces(element)
                                                       : skip(element);
            if (!done)
                return done.error();
        }
        return cleanUp(std::move(mesh_), options_, path_);
    }

  private:
    Result<void> readVertices(const PlyElement& element) {
        // Where each property goes: x, y, z, nx, ny, nz, u, v; the rest is read and forgotten.
        enum Place : std::size_t { kX, kNx = 3, kU = 6, kPlaces = 8 };
        const std::array<int, kPlaces> found = {
            element.find({"x"}), element.find({"y"}), element.find({"z"}),
            element.find({"nx"}), element.find({"ny"}), element.find({"nz"}),
            element.find({"u", "s", "texture_u", "texture_s"}), element.find({"v", "t", "texture_v", "texture_t"})};
        if (found[kX] < 0 || found[1] < 0 || found[2] < 0)
            return Error{ErrorCode::fileUnreadable, '"' + path_.string() + "\" has vertices without x, y and z."};
        const bool withNormals = !options_.faceNormals && found[kNx] >= 0 && found[4] >= 0 && found[5] >= 0;
        const bool withUvs = found[kU] >= 0 && found[kU + 1] >= 0;
        std::vector<std::size_t> places(element.properties.size(), kPlaces);
        for (std::size_t place = 0; place < kPlaces; ++place)
            if (found[place] >= 0)
                places[static_cast<std::size_t>(found[place])] = place;

        const auto count = static_cast<std::size_t>(element.count);
        mesh_.positions.reserve(count);
        mesh_.normals.reserve(withNormals ? count : 0);
        mesh_.uvs.reserve(withUvs ? count : 0);
        std::array<float, kPlaces + 1> row{};
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t p = 0; p < places.size(); ++p) {
                double value = 0;
                if (!readProperty(element.properties[p], value))
                    return endedEarly(element, i);
                row[places[p]] = static_cast<float>(value);
            }
            mesh_.positions.push_back({row[0], row[1], row[2]});
            if (withNormals)
                mesh_.normals.push_back({row[kNx], row[kNx + 1], row[kNx + 2]});
            if (withUvs)
                mesh_.uvs.push_back({row[kU], row[kU + 1]});
        }
        return {};
    }

    Result<void> readFaces(const PlyElement& element) {
        const int indices = element.find({"vertex_indices", "vertex_index"});
        if (indices < 0 || !element.properties[static_cast<std::size_t>(indices)].isList)
            return Error{ErrorCode::fileUnreadable, '"' + path_.string() + "\" has faces without a list vertex_indices."};
        mesh_.triangles.reserve(static_cast<std::size_t>(element.count));
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                double unused = 0;
                const bool good = static_cast<int>(p) == indices ? readPolygon(element.properties[p])
                                                                 : readProperty(element.properties[p], unused);
                if (!good)
                    return endedEarly(element, i);
            }
        }
        return {};
    }

    bool readPolygon(const PlyProperty& property) {
        double count = 0;
        if (!values_.next(property.countType, count))
            return false;
        std::uint32_t first = 0, previous = 0;
        for (double corner = 0; corner < count; ++corner) {
            double value = 0;
            if (!values_.next(property.type, value))
                return false;
            const std::uint32_t index = toIndex(value);
            if (corner == 0)
                first = index;
            if (corner >= 2)
                mesh_.triangles.push_back({first, previous, index});
            previous = index;
        }
        return true;
    }

    /// What is no index becomes one that no vertex has, so that cleanUp() drops the triangle.
    static std::uint32_t toIndex(double value) {
        constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
        return value >= 0 && value < double(kNone) ? static_cast<std::uint32_t>(value) : kNone;
    }

    /// One value; of a list its last one.
    bool readProperty(const PlyProperty& property, double& value) {
        if (!property.isList)
            return values_.next(property.type, value);
        double count = 0;
        if (!values_.next(property.countType, count))
            return false;
        for (double i = 0; i < count; ++i)
            if (!values_.next(property.type, value))
                return false;
        return true;
    }

    Result<void> skip(const PlyElement& element) {
        for (std::uint64_t i = 0; i < element.count; ++i)
            for (const auto& property : element.properties) {
                double unused = 0;
                if (!readProperty(property, unused))
                    return endedEarly(element, i);
            }
        return {};
    }

    Error endedEarly(const PlyElement& element, std::uint64_t index) const {
        return {ErrorCode::fileUnreadable, '"' + path_.string() + "\" ends, or has something that is no number, in " +
                                               element.name + " " + std::to_string(index) + " of " +
                                               std::to_string(element.count) + " (counted from 0)."};
    }

    Values values_;
    const MeshFileOptions& options_;
    const std::filesystem::path& path_;
    TriangleMesh mesh_;
};

}  // namespace

Result<LoadedMesh> loadPly(const std::filesystem::path& path, const MeshFileOptions& options) try {
    const auto bytes = readFileBytes(path, kMaxMeshFileBytes);
    if (!bytes)
        return bytes.error();
    const auto header = readPlyHeader(*bytes, path);
    if (!header)
        return header.error();
    const std::string_view data = std::string_view(*bytes).substr(header->dataBegin);
    if (header->format == PlyFormat::ascii)
        return PlyReader(TextValues(data), options, path).read(*header);
    return PlyReader(BinaryValues(data, header->format == PlyFormat::bigEndian), options, path).read(*header);
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::outOfMemory, "Not enough memory for the mesh \"" + path.string() + "\"."};
}

}  // namespace emca::render
