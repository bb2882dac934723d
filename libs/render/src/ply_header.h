#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "emca/core/result.h"

namespace emca::render {

enum class PlyFormat { ascii, littleEndian, bigEndian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
std::size_t plySize(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;       ///< of the value, or of each entry of a list
    bool isList = false;
    PlyType countType = PlyType::uint8;    ///< lists only
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    /// Place of a property in `properties`, -1 if there is none of these names.
    int find(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t dataBegin = 0;  ///< bytes from the begin of the file
};

/// Reads the header, and refuses element counts that the bytes after it cannot hold, so that they are safe to reserve.
/// Errors: fileUnreadable with the line.
Result<PlyHeader> readPlyHeader(std::string_view file, const std::filesystem::path& path);

}  // namespace emca::render
