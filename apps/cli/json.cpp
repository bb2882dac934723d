#include "json.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "emca/analysis/format.h"

namespace emca::cli {
namespace {

struct ToJson {
    Json operator()(bool value) const { return value; }
    Json operator()(std::int64_t value) const { return value; }
    Json operator()(float value) const { return toJson(value); }
    Json operator()(double value) const { return toJson(value); }
    Json operator()(Color c) const { return toJson(c); }
    Json operator()(ColorA c) const { return Json::array({toJson(c.r), toJson(c.g), toJson(c.b), toJson(c.a)}); }
    Json operator()(const std::string& text) const { return text; }
    template <typename T>
    Json operator()(Vec2<T> v) const {
        return Json::array({(*this)(v.x), (*this)(v.y)});
    }
    template <typename T>
    Json operator()(Vec3<T> v) const {
        return Json::array({(*this)(v.x), (*this)(v.y), (*this)(v.z)});
    }
    Json operator()(const std::vector<float>& entries) const {
        Json array = Json::array();
        for (const float v : entries) array.push_back(toJson(v));
        return array;
    }
};

}  // namespace

Json toJson(double value) { return std::isfinite(value) ? Json(value) : Json(analysis::formatFull(value)); }

Json toJson(float value) {
    if (!std::isfinite(value)) return analysis::formatFull(value);
    // The double nearest to the float's shortest decimal prints as that decimal. Should it ever round to another float,
    // the exact value is printed.
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    double decimal = 0;
    std::from_chars(text, end, decimal);
    return static_cast<float>(decimal) == value ? decimal : static_cast<double>(value);
}

Json toJson(Vec3f v) { return Json::array({toJson(v.x), toJson(v.y), toJson(v.z)}); }
Json toJson(Color c) { return Json::array({toJson(c.r), toJson(c.g), toJson(c.b)}); }
Json toJson(Pixel p) { return Json::array({p.x, p.y}); }
Json toJson(const Value& value) { return std::visit(ToJson(), value); }

namespace {

bool isShort(const Json& json) {
    return json.is_array() && json.size() <= 4 &&
           std::none_of(json.begin(), json.end(), [](const Json& e) { return e.is_structured(); });
}

/// As nlohmann's dump(2), but vectors and colours stay on one line: a person reads them as one thing.
void write(const Json& json, std::size_t depth, std::string& out) {
    const auto separate = [&](bool first) { out += (first ? "\n" : ",\n") + std::string(2 * (depth + 1), ' '); };
    const auto scalar = [](const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); };
    if (!json.is_structured() || json.empty()) {
        out += scalar(json);
    } else if (isShort(json)) {
        out += '[';
        for (std::size_t i = 0; i < json.size(); ++i) out += (i > 0 ? ", " : "") + scalar(json[i]);
        out += ']';
    } else {
        out += json.is_array() ? '[' : '{';
        bool first = true;
        for (auto it = json.begin(); it != json.end(); ++it) {
            separate(first);
            first = false;
            if (json.is_object()) out += scalar(Json(it.key())) + ": ";
            write(*it, depth + 1, out);
        }
        out += '\n' + std::string(2 * depth, ' ') + (json.is_array() ? ']' : '}');
    }
}

}  // namespace

std::string dump(const Json& json) {
    std::string text;
    write(json, 0, text);
    return text + '\n';
}

}  // namespace emca::cli
