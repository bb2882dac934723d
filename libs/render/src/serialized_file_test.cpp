#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

#include "emca/render/mesh_files.h"
#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <typename T>
void put(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

constexpr std::uint32_t kNormals = 0x1, kUvs = 0x2, kColors = 0x8, kFlat = 0x10, kSingle = 0x1000, kDouble = 0x2000;

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string result(size, '\0');
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()), Z_OK);
    result.resize(size);
    return result;
}

/// What one mesh of a file says: a triangle at height z.
template <typename Real>
std::string content(int version, std::uint32_t flags, Real z) {
    std::string bytes;
    put(bytes, flags | (sizeof(Real) == 8 ? kDouble : kSingle));
    if (version == 4)
        bytes += std::string("a name") + '\0';
    put(bytes, std::uint64_t(3));
    put(bytes, std::uint64_t(1));
    for (const Real v : {Real(0), Real(0), z, Real(1), Real(0), z, Real(0), Real(1), z})
        put(bytes, v);
    if (flags & kNormals)
        for (int i = 0; i < 9; ++i)
            put(bytes, Real(i % 3 == 2 ? 3 : 0));
    if (flags & kUvs)
        for (int i = 0; i < 6; ++i)
            put(bytes, Real(i));
    if (flags & kColors)
        for (int i = 0; i < 9; ++i)
            put(bytes, Real(1));
    for (const std::uint32_t index : {0u, 1u, 2u})
        put(bytes, index);
    return bytes;
}

std::string file(int version, const std::vector<std::string>& contents) {
    std::string bytes;
    std::vector<std::uint64_t> offsets;
    for (const auto& c : contents) {
        offsets.push_back(bytes.size());
        put(bytes, std::uint16_t(0x041c));
        put(bytes, std::uint16_t(version));
        bytes += deflated(c);
    }
    for (const auto offset : offsets) {
        if (version == 4)
            put(bytes, offset);
        else
            put(bytes, static_cast<std::uint32_t>(offset));
    }
    put(bytes, static_cast<std::uint32_t>(offsets.size()));
    return bytes;
}

Result<LoadedMesh> load(const std::string& bytes, const MeshFileOptions& options = {}) {
    const TemporaryFolder folder;
    return loadSerialized(folder.write("m.serialized", bytes), options);
}

TEST(SerializedFile, BothVersionsAndPrecisionsAndEachIndex) {
    for (const int version : {3, 4}) {
        const std::string bytes = file(version, {content(version, kNormals | kUvs | kColors, 1.f), content(version, kUvs, 2.0), content(version, kFlat, 3.f)});
        for (std::size_t i = 0; i < 3; ++i) {
            const auto loaded = load(bytes, {.shapeIndex = i});
            ASSERT_TRUE(loaded.ok()) << loaded.error().message;
            const float z = float(i) + 1;
            EXPECT_THAT(loaded->warnings, IsEmpty());
            EXPECT_THAT(loaded->mesh.positions, ElementsAre(Vec3f{0, 0, z}, Vec3f{1, 0, z}, Vec3f{0, 1, z}));
            EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
            if (i == 2) {
                EXPECT_THAT(loaded->mesh.normals, IsEmpty());  // the file says: flat faces
                continue;
            }
            EXPECT_THAT(loaded->mesh.uvs, ElementsAre(Vec2f{0, 1}, Vec2f{2, 3}, Vec2f{4, 5}));
            EXPECT_THAT(loaded->mesh.normals, testing::AllOf(testing::SizeIs(3), testing::Each(Vec3f{0, 0, 1})));
        }
        EXPECT_THAT(load(bytes, {.shapeIndex = 3}).error().message, HasSubstr("has 3 meshes; shape_index 3 is not one of them"));
    }
}

TEST(SerializedFile, CountsThatPromiseTooMuchAreRefusedWithoutTheMemory) {
    for (const std::uint64_t count : {std::uint64_t(4000000000), std::uint64_t(1) << 40, ~std::uint64_t(0)})
        for (const std::size_t place : {4u, 12u}) {
            std::string bytes = content(3, 0, 1.f);
            std::memcpy(bytes.data() + place, &count, 8);
            EXPECT_FALSE(load(file(3, {bytes})).ok());
        }
}

TEST(SerializedFile, OtherFilesAreRefused) {
    EXPECT_THAT(load("").error().message, HasSubstr("not a .serialized file"));
    EXPECT_THAT(load("something else entirely").error().message, HasSubstr("not a .serialized file"));
    std::string future = file(4, {content(4, 0, 1.f)});
    future[2] = 5;
    EXPECT_THAT(load(future).error().message, HasSubstr("has version 5"));
    EXPECT_EQ(loadSerialized("/nowhere/m.serialized", {}).error().code, ErrorCode::fileNotFound);
    EXPECT_EQ(loadSerialized("/", {}).error().code, ErrorCode::fileUnreadable);
}

TEST(SerializedFile, EveryTruncationIsAnError) {
    const TemporaryFolder folder;
    for (const int version : {3, 4}) {
        const std::string bytes = file(version, {content(version, kNormals, 1.f), content(version, 0, 2.0)});
        for (std::size_t length = 0; length < bytes.size(); ++length)
            ASSERT_FALSE(loadSerialized(folder.write("m.serialized", bytes.substr(0, length)), {}).ok()) << length;
    }
}

TEST(SerializedFile, EveryTruncationOfTheContentIsAnError) {
    const std::string bytes = content(4, kNormals | kUvs, 1.f);
    for (std::size_t length = 0; length < bytes.size(); ++length)
        ASSERT_FALSE(load(file(4, {bytes.substr(0, length)})).ok()) << length;
}

TEST(SerializedFile, EveryChangedByteIsAMeshOrAnError) {
    const TemporaryFolder folder;
    const std::string bytes = file(4, {content(4, kNormals, 1.f), content(4, 0, 2.0)});
    for (std::size_t i = 0; i < bytes.size(); ++i)
        for (const char c : {'\0', '\xff', '\x7f', '\x01'}) {
            std::string changed = bytes;
            changed[i] = c;
            const auto path = folder.write("m.serialized", changed);
            for (std::size_t index = 0; index < 2; ++index) {
                const auto loaded = loadSerialized(path, {.shapeIndex = index});
                for (const auto& t : loaded ? loaded->mesh.triangles : std::vector<Triangle>{})
                    for (const auto corner : t)
                        ASSERT_LT(corner, loaded->mesh.positions.size());
            }
        }
}

}  // namespace
}  // namespace emca::render
