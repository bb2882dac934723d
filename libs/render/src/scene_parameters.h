#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace emca::render {

/// The $names of a scene: values from outside win over the file's <default>s.
class SceneParameters {
  public:
    explicit SceneParameters(std::map<std::string, std::string> defines);

    void setDefault(std::string name, std::string value);
    /// Replaces every $name; at each $ the longest known name counts, as names may be glued to other text.
    /// \param unknown  gets the names that are not known, or whose value is far too long; they stay in the text
    std::string substitute(std::string_view text, std::vector<std::string>& unknown);
    /// Names given from outside that no $name asked for.
    std::vector<std::string> unusedDefines() const;
    /// Whether the file has a <default> of this name.
    bool hasDefault(const std::string& name) const { return defaults_.contains(name); }

  private:
    std::map<std::string, std::string> values_;
    std::set<std::string> defines_, defaults_, used_;
};

}  // namespace emca::render
