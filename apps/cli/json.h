#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "emca/core/color.h"
#include "emca/core/pixel.h"
#include "emca/core/value.h"
#include "emca/core/vector.h"

// Values of EMCA as JSON (docs/command-line.md): numbers read back as the same bits, and what JSON has no number for is
// one of the strings "NaN", "Infinity", "-Infinity".
namespace emca::cli {

/// Members stay in the order in which they were added.
using Json = nlohmann::ordered_json;

Json toJson(float value);  ///< the shortest decimal that reads back as this float: 0.1, not 0.10000000149011612
Json toJson(double value);
Json toJson(Vec3f value);  ///< [x, y, z]
Json toJson(Color value);  ///< [r, g, b]
Json toJson(Pixel value);  ///< [x, y]
Json toJson(const Value& value);

/// null for nothing.
template <typename T>
Json toJson(const std::optional<T>& value) {
    return value ? toJson(*value) : Json(nullptr);
}

/// Text with two blanks of indentation and a line feed at its end; invalid UTF-8 becomes U+FFFD.
std::string dump(const Json& json);

}  // namespace emca::cli
