#include "scene_parameters.h"

#include <algorithm>
#include <cctype>

namespace emca::render {

namespace {

// Defaults that each name another one twice would grow without end.
constexpr std::size_t kMaxGrowth = std::size_t(1) << 20;

bool isNameCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

SceneParameters::SceneParameters(std::map<std::string, std::string> defines) : values_(std::move(defines)) {
    for (const auto& [name, value] : values_)
        defines_.insert(name);
}

void SceneParameters::setDefault(std::string name, std::string value) {
    values_.try_emplace(name, std::move(value));
    defaults_.insert(std::move(name));
}

std::string SceneParameters::substitute(std::string_view text, std::vector<std::string>& unknown) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] != '$') {
            result += text[i++];
            continue;
        }
        const std::string_view rest = text.substr(i + 1);
        const std::pair<const std::string, std::string>* best = nullptr;
        for (const auto& entry : values_)
            if (!entry.first.empty() && rest.starts_with(entry.first) && (!best || entry.first.size() > best->first.size()))
                best = &entry;
        if (best && result.size() + best->second.size() <= text.size() + kMaxGrowth) {
            result += best->second;
            used_.insert(best->first);
            i += 1 + best->first.size();
            continue;
        }
        const auto end = std::find_if_not(rest.begin(), rest.end(), isNameCharacter);
        unknown.emplace_back(rest.begin(), end);
        result += text[i++];
    }
    return result;
}

std::vector<std::string> SceneParameters::unusedDefines() const {
    std::vector<std::string> unused;
    std::set_difference(defines_.begin(), defines_.end(), used_.begin(), used_.end(), std::back_inserter(unused));
    return unused;
}

}  // namespace emca::render
