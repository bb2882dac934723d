#include "emca/analysis/format.h"

#include <charconv>
#include <cmath>
#include <type_traits>

namespace emca::analysis {
namespace {

std::string nonFinite(double value) {
    if (std::isnan(value)) return "NaN";
    return value > 0 ? "Infinity" : "-Infinity";
}

template <typename... Args>
std::string toText(Args... args) {
    char buffer[128];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, args...);
    return std::string(buffer, end.ptr);
}

template <typename Float>
std::string shortest(Float value) {
    return std::isfinite(value) ? toText(value) : nonFinite(static_cast<double>(value));
}

std::string twoDigits(std::int64_t value) { return (value < 10 ? "0" : "") + std::to_string(value); }

/// Writes the components of any recorded value with one function per kind of number.
template <typename FormatFloat>
struct ValueFormatter {
    FormatFloat number;
    std::size_t maximumEntries;

    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return formatInteger(value); }
    std::string operator()(float value) const { return number(value); }
    std::string operator()(double value) const { return number(value); }
    std::string operator()(const std::string& value) const { return value; }
    std::string operator()(Color v) const { return tuple(v.r, v.g, v.b); }
    std::string operator()(ColorA v) const { return tuple(v.r, v.g, v.b, v.a); }
    template <typename T>
    std::string operator()(Vec2<T> v) const {
        return tuple(v.x, v.y);
    }
    template <typename T>
    std::string operator()(Vec3<T> v) const {
        return tuple(v.x, v.y, v.z);
    }
    std::string operator()(const std::vector<float>& entries) const {
        std::string text = "[";
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (i > 0) text += ", ";
            if (i == maximumEntries) return text + "…] (" + std::to_string(entries.size()) + ")";
            text += number(entries[i]);
        }
        return text + "]";
    }

    template <typename T, typename... Rest>
    std::string tuple(T first, Rest... rest) const {
        std::string text = "(" + (*this)(first);
        ((text += ", " + (*this)(rest)), ...);
        return text + ")";
    }
};

struct Rounded {
    std::string operator()(float value) const { return formatNumber(static_cast<double>(value)); }
    std::string operator()(double value) const { return formatNumber(value); }
};
struct Full {
    std::string operator()(float value) const { return formatFull(value); }
    std::string operator()(double value) const { return formatFull(value); }
};

}  // namespace

std::string formatNumber(double value) {
    if (!std::isfinite(value)) return nonFinite(value);
    if (value == 0) return std::signbit(value) ? "-0" : "0";
    constexpr int kDigits = 4;
    std::string text = toText(value, std::chars_format::scientific, kDigits - 1);
    // The exponent after rounding decides, so that 9999.6 and 10000 look alike.
    const int exponent = std::atoi(text.c_str() + text.find('e') + 1);
    if (exponent >= -4 && exponent < kDigits) return toText(value, std::chars_format::fixed, kDigits - 1 - exponent);
    return text;
}

std::string formatInteger(std::int64_t value) { return std::to_string(value); }
std::string formatFull(float value) { return shortest(value); }
std::string formatFull(double value) { return shortest(value); }

std::string formatColor(Color value) { return ValueFormatter<Rounded>{{}, 0}(value); }
std::string formatColor(ColorA value) { return ValueFormatter<Rounded>{{}, 0}(value); }
std::string formatVector(Vec3f value) { return ValueFormatter<Rounded>{{}, 0}(value); }
std::string formatPixel(Pixel pixel) { return "(" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + ")"; }

std::string formatValue(const Value& value, std::size_t maximumEntries) {
    return std::visit(ValueFormatter<Rounded>{{}, maximumEntries}, value);
}

std::string formatValueFull(const Value& value) {
    return std::visit(ValueFormatter<Full>{{}, static_cast<std::size_t>(-1)}, value);
}

std::string formatBytes(std::uint64_t bytes) {
    if (bytes < 1024) return std::to_string(bytes) + " B";
    constexpr const char* kUnits[] = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    double scaled = static_cast<double>(bytes) / 1024;
    std::size_t unit = 0;
    // From 1023.5 on, four digits would read 1024.
    while (scaled >= 1023.5 && unit + 1 < std::size(kUnits)) {
        scaled /= 1024;
        ++unit;
    }
    return formatNumber(scaled) + " " + kUnits[unit];
}

std::string formatDuration(double seconds) {
    if (!std::isfinite(seconds) || seconds <= 0) return formatNumber(seconds) + " s";
    if (seconds < 0.99995e-6) return formatNumber(seconds * 1e9) + " ns";
    if (seconds < 0.99995e-3) return formatNumber(seconds * 1e6) + " µs";
    if (seconds < 0.99995) return formatNumber(seconds * 1e3) + " ms";
    if (seconds < 59.995) return formatNumber(seconds) + " s";
    if (seconds > 1e15) return formatNumber(seconds) + " s";
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 3600) return std::to_string(whole / 60) + " min " + twoDigits(whole % 60) + " s";
    const std::int64_t minutes = (whole + 30) / 60;
    return std::to_string(minutes / 60) + " h " + twoDigits(minutes % 60) + " min";
}

bool isNonFiniteWord(std::string_view text) { return text == "NaN" || text == "Infinity" || text == "-Infinity"; }

}  // namespace emca::analysis
