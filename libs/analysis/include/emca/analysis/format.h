#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emca/core/color.h"
#include "emca/core/pixel.h"
#include "emca/core/value.h"
#include "emca/core/vector.h"

// Numbers as the whole program shows them: plots, tables, tool tips, command line. Never localised: the decimal
// separator is a point whatever the machine speaks.
namespace emca::analysis {

/// Four significant digits: "1.000", "0.01235", "1234", "1.234e+05", "1.234e-05"; "0", "-0"; "NaN", "Infinity",
/// "-Infinity". Fixed from 1e-4 up to 9999.5, scientific beyond: at most 10 characters with the sign (11 if the exponent has
/// three digits). The last digit is rounded to nearest, exact halves of the decimal expansion to even.
std::string formatNumber(double value);
/// In full: counts and indices have no rounding.
std::string formatInteger(std::int64_t value);
/// The shortest text that reads back as the same bits, for copying and files: "0.1", "1e-07"; "NaN", "Infinity".
std::string formatFull(float value);
std::string formatFull(double value);

/// "(0.1000, 1.000, 0)": components of a colour or vector by formatNumber.
std::string formatColor(Color value);
std::string formatColor(ColorA value);
std::string formatVector(Vec3f value);
std::string formatPixel(Pixel pixel);  ///< "(12, 345)"

/// Any recorded value on one line: "true", integers in full, numbers and vectors as above, text as it is, spectra as
/// "[0.1000, 0.2000, …] (31)" after `maximumEntries` entries.
std::string formatValue(const Value& value, std::size_t maximumEntries = 8);
/// As formatValue, in full and with nothing left out.
std::string formatValueFull(const Value& value);

/// "512 B", "1.500 KiB", "256.0 MiB", "3.000 GiB": binary units.
std::string formatBytes(std::uint64_t bytes);
/// "850.0 ns", "12.34 ms", "1.500 s" below a minute, then "2 min 05 s", "3 h 07 min". Negative and NaN: as formatNumber with " s".
std::string formatDuration(double seconds);

/// True for words of formatNumber that views show in warning colour.
bool isNonFiniteWord(std::string_view text);

}  // namespace emca::analysis
