#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "emca/core/vector.h"

namespace emca::cli {

/// A PLY file as a reader sees it that knows the format and nothing of its writer: it goes by the header.
struct Ply {
    struct Face {
        std::array<std::uint32_t, 3> vertices{};
        float quality = 0;
        std::array<float, 3> rgb{};
        std::array<std::uint8_t, 3> color{};
    };
    std::string header;
    std::vector<Vec3f> vertices;
    std::vector<Face> faces;
};

inline Ply parsePly(const std::string& bytes) {
    Ply ply;
    const std::size_t end = bytes.find("end_header\n");
    EXPECT_NE(end, std::string::npos);
    if (end == std::string::npos) return ply;
    ply.header = bytes.substr(0, end);
    std::istringstream lines(ply.header);
    std::vector<std::string> faceProperties;
    std::size_t vertexCount = 0, faceCount = 0;
    std::string element;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word, type, name;
        words >> word >> type >> name;
        if (word == "format") {
            EXPECT_EQ(line, "format binary_little_endian 1.0");
        }
        if (word == "element") {
            element = type;
            (type == "vertex" ? vertexCount : faceCount) = std::stoull(name);
        }
        if (word == "property" && element == "face") faceProperties.push_back(line);
    }
    std::size_t at = end + 11;
    const auto take = [&](void* value, std::size_t size) {
        if (at + size <= bytes.size()) std::memcpy(value, bytes.data() + at, size);
        at += size;
    };
    ply.vertices.resize(vertexCount);
    for (Vec3f& vertex : ply.vertices) take(&vertex, 12);
    ply.faces.resize(faceCount);
    for (Ply::Face& face : ply.faces) {
        for (const std::string& property : faceProperties) {
            const std::string name = property.substr(property.rfind(' ') + 1);
            if (property == "property list uchar int vertex_indices") {
                std::uint8_t count = 0;
                take(&count, 1);
                EXPECT_EQ(count, 3);
                take(face.vertices.data(), 12);
            } else if (name == "quality") {
                take(&face.quality, 4);
            } else if (name == "r" || name == "g" || name == "b") {
                take(&face.rgb[name == "r" ? 0 : name == "g" ? 1 : 2], 4);
            } else {
                EXPECT_EQ(property.rfind("property uchar ", 0), 0u) << property;
                take(&face.color[name == "red" ? 0 : name == "green" ? 1 : 2], 1);
            }
        }
    }
    EXPECT_EQ(at, bytes.size()) << "as long as the header says";
    return ply;
}

inline Ply readPly(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return parsePly({std::istreambuf_iterator<char>(in), {}});
}

}  // namespace emca::cli
