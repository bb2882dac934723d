#include "scene_values.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "text_numbers.h"

namespace emca::render {

namespace {

using ValueReader = Result<Property> (*)(const SceneElement&, SpectrumUse, const std::filesystem::path&);

std::string shortened(const std::string& text) { return text.size() <= 60 ? text : text.substr(0, 57) + "..."; }

/// A sentence to be continued.
std::string withoutStop(std::string sentence) {
    if (sentence.ends_with('.'))
        sentence.pop_back();
    return sentence;
}

/// What is wrong with the value of an element: `value "abc" of float "alpha" <what>`.
Error badValue(const SceneElement& element, const std::string& value, std::string_view what) {
    std::string message = "value \"" + shortened(value) + "\" of " + element.tag();
    if (const auto* name = element.find("name"))
        message += " \"" + *name + '"';
    return {ErrorCode::parseFailed, message + " " + std::string(what)};
}

Result<std::string> valueOf(const SceneElement& element) {
    if (const auto* value = element.find("value"))
        return *value;
    const auto* name = element.find("name");
    return Error{ErrorCode::parseFailed, element.tag() + (name ? " \"" + *name + '"' : "") + " has no attribute \"value\""};
}

Result<double> numberOf(const SceneElement& element, const std::string& attribute, double fallback) {
    const auto* text = element.find(attribute);
    if (!text)
        return fallback;
    if (const auto number = parseNumber<double>(*text))
        return *number;
    return badValue(element, *text, "(" + attribute + ") is not a finite number");
}

Result<Property> readFloat(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    const auto text = valueOf(element);
    if (!text)
        return text.error();
    if (const auto number = parseNumber<double>(*text))
        return Property(*number);
    return badValue(element, *text, "is not a finite number");
}

Result<Property> readInteger(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    const auto text = valueOf(element);
    if (!text)
        return text.error();
    if (const auto number = parseNumber<std::int64_t>(*text))
        return Property(*number);
    return badValue(element, *text, "is not an integer");
}

Result<Property> readBoolean(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    const auto text = valueOf(element);
    if (!text)
        return text.error();
    std::string lower(trimmed(*text));
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    if (lower == "true" || lower == "false")
        return Property(lower == "true");
    return badValue(element, *text, "is neither \"true\" nor \"false\"");
}

Result<Property> readString(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    auto text = valueOf(element);
    if (!text)
        return text.error();
    return Property(std::move(*text));
}

/// x, y and z as attributes, or together in `value`: 1 number (all three, if `one`) or 3.
Result<Vec3d> readTriple(const SceneElement& element, double fallback, bool one) {
    if (const auto* text = element.find("value")) {
        const auto numbers = parseNumbers(*text);
        if (numbers && numbers->size() == 3)
            return Vec3d{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
        if (numbers && numbers->size() == 1 && one)
            return Vec3d{numbers->front(), numbers->front(), numbers->front()};
        return badValue(element, *text, one ? "is not one or three finite numbers" : "is not three finite numbers");
    }
    Vec3d result;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto number = numberOf(element, std::string(1, "xyz"[i]), fallback);
        if (!number)
            return number.error();
        result[i] = *number;
    }
    return result;
}

Result<Property> readVector(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    const auto triple = readTriple(element, 0, false);
    if (!triple)
        return triple.error();
    return Property(Vec3f{static_cast<float>(triple->x), static_cast<float>(triple->y), static_cast<float>(triple->z)});
}

/// "#rrggbb" as components in [0, 1].
std::optional<Color> parseHex(std::string_view text) {
    text = trimmed(text);
    unsigned value = 0;
    if (text.size() != 7 || text[0] != '#')
        return {};
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
    if (error != std::errc() || end != text.data() + 7)
        return {};
    const auto component = [&](int shift) { return static_cast<float>((value >> shift) & 255u) / 255.f; };
    return Color{component(16), component(8), component(0)};
}

std::optional<Color> parseRgb(std::string_view text) {
    if (const auto hex = parseHex(text))
        return hex;
    const auto numbers = parseNumbers(text);
    if (!numbers || (numbers->size() != 1 && numbers->size() != 3))
        return {};
    const auto component = [&](std::size_t i) { return static_cast<float>((*numbers)[numbers->size() == 1 ? 0 : i]); };
    return Color{component(0), component(1), component(2)};
}

Result<Property> readRgb(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    const auto text = valueOf(element);
    if (!text)
        return text.error();
    element.find("intent");  // of the 0.6 dialect; matters only to renderers that calculate with spectra
    if (const auto color = parseRgb(*text))
        return Property(*color);
    return badValue(element, *text, "is not a colour (\"r, g, b\", \"#rrggbb\" or one number)");
}

Result<Property> readSrgb(const SceneElement& element, SpectrumUse use, const std::filesystem::path& folder) {
    auto encoded = readRgb(element, use, folder);
    if (!encoded)
        return encoded;
    const Color c = std::get<Color>(*encoded);
    return Property(Color{srgbToLinear(c.r), srgbToLinear(c.g), srgbToLinear(c.b)});
}

Result<Property> readSpectrum(const SceneElement& element, SpectrumUse use, const std::filesystem::path& folder) {
    if (const auto* intent = element.find("intent"))
        use = *intent == "illuminant" ? SpectrumUse::light : SpectrumUse::ratio;
    if (const auto* file = element.find("filename")) {
        const auto samples = readSpectrumFile(folder / *file);
        if (!samples)
            return badValue(element, *file, "is not a readable spectrum: " + withoutStop(samples.error().message));
        return Property(toRgb(*samples, use));
    }
    const auto text = valueOf(element);
    if (!text)
        return text.error();
    if (text->find(':') == text->npos) {
        // Without wavelengths: the same everywhere, or what the 0.6 dialect means by as many values as it has channels.
        if (const auto color = parseRgb(*text))
            return Property(*color);
        return badValue(element, *text, "is not a spectrum (one number, or \"wavelength:value\" pairs)");
    }
    const auto samples = parseSpectrum(*text);
    if (!samples)
        return badValue(element, *text, "is not a spectrum: " + withoutStop(samples.error().message));
    if (samples->size() == 1)
        return Property(Color(static_cast<float>(samples->front().value)));
    return Property(toRgb(*samples, use));
}

Result<Property> readBlackbody(const SceneElement& element, SpectrumUse, const std::filesystem::path&) {
    std::string temperature = element.get("temperature");
    std::string_view digits = trimmed(temperature);
    if (digits.ends_with('K') || digits.ends_with('k'))
        digits.remove_suffix(1);
    const auto kelvin = parseNumber<double>(digits);
    if (!kelvin || *kelvin <= 0)
        return badValue(element, temperature, "(temperature) is not a positive number of kelvins");
    const auto scale = numberOf(element, "scale", 1);
    if (!scale)
        return scale.error();
    return Property(blackbodyRgb(*kelvin) * static_cast<float>(*scale));
}

struct ValueTag { std::string_view tag; ValueReader read; };
constexpr ValueTag kValueTags[] = {
    {"float", readFloat}, {"integer", readInteger}, {"boolean", readBoolean}, {"string", readString},
    {"point", readVector}, {"vector", readVector}, {"rgb", readRgb}, {"srgb", readSrgb},
    {"spectrum", readSpectrum}, {"blackbody", readBlackbody},
};

Result<Transform> readMatrix(const SceneElement& element) {
    const auto text = valueOf(element);
    if (!text)
        return text.error();
    const auto n = parseNumbers(*text);
    if (n && n->size() == 16) {
        std::array<double, 16> m;
        std::copy(n->begin(), n->end(), m.begin());
        return Transform(m);
    }
    if (n && n->size() == 9)
        return Transform({(*n)[0], (*n)[1], (*n)[2], 0, (*n)[3], (*n)[4], (*n)[5], 0, (*n)[6], (*n)[7], (*n)[8], 0, 0, 0, 0, 1});
    return badValue(element, *text, "is not a matrix of 16 or 9 finite numbers");
}

Result<Transform> readRotation(const SceneElement& element) {
    const auto axis = readTriple(element, 0, false);
    if (!axis)
        return axis.error();
    if (length(*axis) == 0)
        return Error{ErrorCode::parseFailed, "rotate has no axis (x, y, z or value)"};
    if (!element.find("angle"))
        return Error{ErrorCode::parseFailed, "rotate has no attribute \"angle\""};
    const auto angle = numberOf(element, "angle", 0);
    if (!angle)
        return angle.error();
    return Transform::rotate(*axis, *angle);
}

Result<Transform> readLookAt(const SceneElement& element) {
    const auto triple = [&](const std::string& attribute, Vec3d fallback) -> Result<Vec3d> {
        const auto* text = element.find(attribute);
        if (!text)
            return fallback;
        const auto numbers = parseNumbers(*text);
        if (!numbers || numbers->size() != 3)
            return badValue(element, *text, "(" + attribute + ") is not three finite numbers");
        return Vec3d{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    };
    const auto origin = triple("origin", {}), target = triple("target", {0, 0, 1}), up = triple("up", {});
    for (const auto* part : {&origin, &target, &up})
        if (!*part)
            return part->error();
    if (!(length(*target - *origin) > 0))
        return Error{ErrorCode::parseFailed, "lookat has the same origin and target"};
    return Transform::lookAt(*origin, *target, *up);
}

Result<Color> samplesToRgb(const std::vector<double>& wavelengths, const std::vector<double>& values, SpectrumUse use) {
    if (wavelengths.size() != values.size() || values.empty())
        return Error{ErrorCode::parseFailed, "spectrum has " + std::to_string(wavelengths.size()) + " wavelengths and " +
                                                 std::to_string(values.size()) + " values"};
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < values.size(); ++i)
        samples.push_back({wavelengths[i], values[i]});
    return toRgb(samples, use);
}

}  // namespace

std::string toSnakeCase(std::string_view name) {
    const auto lower = [](char c) { return std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)); };
    const auto upper = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        // A word begins at a capital after a small letter, and at the last capital of several (as in "UVScale").
        const bool begins = i > 0 && upper(name[i]) &&
                            (lower(name[i - 1]) || (upper(name[i - 1]) && i + 1 < name.size() && lower(name[i + 1])));
        if (begins)
            result += '_';
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
    return result;
}

bool isValueTag(std::string_view tag) {
    return std::any_of(std::begin(kValueTags), std::end(kValueTags), [&](const ValueTag& t) { return t.tag == tag; });
}

Result<Property> readValue(const SceneElement& element, SpectrumUse use, const std::filesystem::path& folder) {
    for (const auto& [tag, read] : kValueTags)
        if (tag == element.tag())
            return read(element, use, folder);
    return Error{ErrorCode::internal, element.tag() + " is not a value"};
}

bool isTransformTag(std::string_view tag) {
    return tag == "translate" || tag == "scale" || tag == "rotate" || tag == "lookat" || tag == "lookAt" || tag == "matrix";
}

Result<Transform> readTransformStep(const SceneElement& element) {
    if (element.tag() == "matrix")
        return readMatrix(element);
    if (element.tag() == "rotate")
        return readRotation(element);
    if (element.tag() == "lookat" || element.tag() == "lookAt")
        return readLookAt(element);
    const bool scale = element.tag() == "scale";
    const auto by = readTriple(element, scale ? 1 : 0, scale);
    if (!by)
        return by.error();
    return scale ? Transform::scale(*by) : Transform::translate(*by);
}

Result<Color> evaluateSpectrum(const SceneNode& spectrum, SpectrumUse use) {
    const auto number = [&](const char* name, double fallback) {
        const auto found = spectrum.properties.find(name);
        if (found == spectrum.properties.end())
            return fallback;
        if (const auto* value = std::get_if<double>(&found->second.value))
            return *value;
        if (const auto* value = std::get_if<std::int64_t>(&found->second.value))
            return static_cast<double>(*value);
        return fallback;
    };
    const auto list = [&](const char* name) -> std::vector<double> {
        const auto found = spectrum.properties.find(name);
        const auto* text = found == spectrum.properties.end() ? nullptr : std::get_if<std::string>(&found->second.value);
        return text ? parseNumbers(*text).value_or(std::vector<double>{}) : std::vector<double>{};
    };
    if (spectrum.type == "uniform")
        return Color(static_cast<float>(number("value", 1)));
    if (spectrum.type == "d65")
        return Color(static_cast<float>(number("scale", 1)));
    if (spectrum.type == "blackbody" && number("temperature", 0) > 0)
        return blackbodyRgb(number("temperature", 0)) * static_cast<float>(number("scale", 1));
    if (spectrum.type == "irregular")
        return samplesToRgb(list("wavelengths"), list("values"), use);
    if (spectrum.type == "regular") {
        const auto values = list("values");
        const double first = number("wavelength_min", 360), last = number("wavelength_max", 830);
        std::vector<double> wavelengths;
        for (std::size_t i = 0; i < values.size(); ++i)
            wavelengths.push_back(first + (last - first) * double(i) / double(std::max<std::size_t>(values.size() - 1, 1)));
        return samplesToRgb(wavelengths, values, use);
    }
    if (spectrum.type == "rgb" || spectrum.type == "srgb")
        if (const auto found = spectrum.properties.find("color"); found != spectrum.properties.end())
            if (const auto* color = std::get_if<Color>(&found->second.value))
                return *color;
    return Error{ErrorCode::notSupported, "spectrum of type \"" + spectrum.type + "\" is not known or incomplete"};
}

}  // namespace emca::render
