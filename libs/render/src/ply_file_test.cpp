#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "emca/render/mesh_files.h"
#include "testing/temporary_folder.h"

namespace emca::render {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Result<LoadedMesh> load(const std::string& bytes, const MeshFileOptions& options = {}) {
    const TemporaryFolder folder;
    return loadPly(folder.write("mesh.ply", bytes), options);
}

/// Bytes of values, in either order.
class Bytes {
  public:
    explicit Bytes(bool big) : big_(big) {}
    template <typename T>
    Bytes& operator<<(T value) {
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), &value, sizeof(T));
        if (big_)
            std::reverse(bytes.begin(), bytes.end());
        text.append(bytes.data(), bytes.size());
        return *this;
    }
    std::string text;

  private:
    bool big_;
};

/// A quad and a triangle with an element, a list and properties that mean nothing to us.
std::string header(const std::string& format) {
    return "ply\nformat " + format + " 1.0\ncomment made by hand\nelement camera 1\nproperty uchar kind\nproperty list uchar short knots\n"
           "element vertex 5\nproperty double z\nproperty float x\nproperty float y\nproperty uchar red\n"
           "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
           "element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";
}

const float kPositions[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5f, 2}};

std::string binaryFile(bool big) {
    Bytes b(big);
    b << std::uint8_t(7) << std::uint8_t(2) << std::int16_t(1) << std::int16_t(-1);
    for (const auto& p : kPositions)
        b << 3.0 << p[0] << p[1] << std::uint8_t(255) << 0.f << 0.f << 2.f << p[0] << p[1];
    b << std::uint8_t(0) << std::uint8_t(4) << 0 << 1 << 2 << 3;
    b << std::uint8_t(0) << std::uint8_t(3) << 3 << 2 << 4;
    return header(big ? "binary_big_endian" : "binary_little_endian") + b.text;
}

std::string textFile() {
    return header("ascii") + "7 2 1 -1\n3 0 0 255 0 0 2 0 0\n3 1 0 255 0 0 2 1 0\n3 1 1 255 0 0 2 1 1\n3 0 1 255 0 0 2 0 1\n"
                             "3 0.5 2 255 0 0 2 0.5 2\n0 4 0 1 2 3\n0 3 3 2 4\n";
}

TEST(PlyFile, AllFormatsSayTheSame) {
    for (const auto& bytes : {textFile(), binaryFile(false), binaryFile(true)}) {
        const auto loaded = load(bytes);
        ASSERT_TRUE(loaded.ok()) << loaded.error().message;
        EXPECT_THAT(loaded->warnings, IsEmpty());
        EXPECT_THAT(loaded->mesh.positions, ElementsAre(Vec3f{0, 0, 3}, Vec3f{1, 0, 3}, Vec3f{1, 1, 3}, Vec3f{0, 1, 3}, Vec3f{0.5f, 2, 3}));
        EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{3, 2, 4}));
        EXPECT_THAT(loaded->mesh.normals, testing::Each(Vec3f{0, 0, 1}));
        EXPECT_THAT(loaded->mesh.uvs, ElementsAre(Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{1, 1}, Vec2f{0, 1}, Vec2f{0.5f, 2}));
    }
}

TEST(PlyFile, WindowsLineEndsAndAMissingLastOneAreFine) {
    std::string text = textFile();
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += 2)
        text.insert(at, "\r");
    EXPECT_TRUE(load(text).ok());
    text = textFile();
    text.pop_back();
    EXPECT_TRUE(load(text).ok()) << load(text).error().message;
}

TEST(PlyFile, NormalsAreComputedOrForgotten) {
    const std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_THAT(load(text)->mesh.normals, testing::Each(Vec3f{0, 0, 1}));
    EXPECT_THAT(load(text, {.faceNormals = true})->mesh.normals, IsEmpty());
    EXPECT_THAT(load(textFile(), {.faceNormals = true})->mesh.normals, IsEmpty());
}

TEST(PlyFile, HeadersThatPromiseTooMuchAreRefusedBeforeAnythingIsReserved) {
    for (const char* format : {"ascii", "binary_little_endian"})
        for (const char* count : {"1000000000000", "18446744073709551615", "4294967296"})
            for (const char* element : {"vertex", "face", "camera"}) {
                std::string text = header(format);
                const auto at = text.find(std::string("element ") + element) + 9 + std::strlen(element);
                text.replace(at, text.find('\n', at) - at, count);
                const auto loaded = load(text + "1 2 3");
                ASSERT_FALSE(loaded.ok());
                EXPECT_THAT(loaded.error().message, HasSubstr("more than the 5 bytes after it can hold"));
            }
}

TEST(PlyFile, ListsThatPromiseTooMuchEndWithTheFile) {
    std::string bytes = binaryFile(false);
    bytes[bytes.size() - 13] = '\xff';  // 255 corners instead of 3
    const auto loaded = load(bytes);
    ASSERT_FALSE(loaded.ok());
    EXPECT_THAT(loaded.error().message, HasSubstr("in face 1 of 2"));
}

TEST(PlyFile, FacesThatCannotBeAreLeftOutAndTheRestLoads) {
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 4\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\nnan 0 1\n";
    const auto loaded = load(head + "3 0 1 2\n3 0 1 4\n3 0 1 -1\n3 1 2 3\n");
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_THAT(loaded->mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
    EXPECT_THAT(loaded->mesh.positions, SizeIs(3));
    EXPECT_THAT(loaded->warnings, ElementsAre(AllOf(HasSubstr("2 triangles"), HasSubstr("first is triangle 1,")),
                                              AllOf(HasSubstr("1 triangles"), HasSubstr("first is triangle 3,"))));
}

TEST(PlyFile, WhatIsNoPlyFileIsRefused) {
    const auto message = [](const std::string& text) {
        const auto loaded = load(text);
        EXPECT_FALSE(loaded.ok()) << text;
        return loaded.ok() ? "" : loaded.error().message;
    };
    EXPECT_THAT(message(""), HasSubstr("not a PLY file"));
    EXPECT_THAT(message("plx\n"), HasSubstr("mesh.ply:1: not a PLY file"));
    EXPECT_THAT(message("ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
    EXPECT_THAT(message("ply\nend_header\n"), HasSubstr("names no format"));
    EXPECT_THAT(message("ply\nformat octal 1.0\nend_header\n"), HasSubstr("mesh.ply:2:"));
    EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex -3\nend_header\n"), HasSubstr("mesh.ply:3:"));
    EXPECT_THAT(message("ply\nformat ascii 1.0\nproperty float x\nend_header\n"), HasSubstr("mesh.ply:3:"));
    EXPECT_THAT(message("ply\nformat ascii 1.0\nelement face 1\nproperty list float int vertex_indices\nend_header\n"), HasSubstr("mesh.ply:4:"));
    EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"), HasSubstr("without x, y and z"));
    EXPECT_THAT(message("ply\nformat ascii 1.0\nelement face 1\nproperty int vertex_indices\nend_header\n1\n"), HasSubstr("without a list"));
    EXPECT_THAT(message(textFile().replace(textFile().find("0.5 2 255"), 3, "abc")), HasSubstr("in vertex 4 of 5"));
    EXPECT_EQ(loadPly("/nowhere/mesh.ply", {}).error().code, ErrorCode::fileNotFound);
}

TEST(PlyFile, EveryTruncationIsAnError) {
    const TemporaryFolder folder;
    for (const auto& bytes : {binaryFile(false), binaryFile(true), textFile()}) {
        const bool text = bytes == textFile();
        // The last number of a text file may be cut short and still be a number.
        for (std::size_t length = 0; length + (text ? 2 : 0) < bytes.size(); ++length) {
            const auto loaded = loadPly(folder.write("mesh.ply", bytes.substr(0, length)), {});
            ASSERT_FALSE(loaded.ok()) << length;
        }
    }
}

TEST(PlyFile, EveryChangedByteIsAMeshOrAnError) {
    const TemporaryFolder folder;
    for (const auto& bytes : {binaryFile(false), textFile()})
        for (std::size_t i = 0; i < bytes.size(); ++i)
            for (const char c : {'\0', '\xff', '9', ' '}) {
                std::string changed = bytes;
                changed[i] = c;
                const auto loaded = loadPly(folder.write("mesh.ply", changed), {});
                for (const auto& t : loaded ? loaded->mesh.triangles : std::vector<Triangle>{})
                    for (const auto index : t)
                        ASSERT_LT(index, loaded->mesh.positions.size());
            }
}

}  // namespace
}  // namespace emca::render
