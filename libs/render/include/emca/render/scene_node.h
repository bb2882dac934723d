#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "emca/core/color.h"
#include "emca/core/vector.h"
#include "emca/render/transform.h"

namespace emca::render {

/// Where in a scene file something was written.
struct SourceLocation {
    std::string file;
    int line = 0;
    std::string text() const { return file + ":" + std::to_string(line); }
};

/// Something about a scene that a person should know; the scene still loads.
struct Diagnostic {
    SourceLocation where;
    std::string message;  ///< one sentence
};

struct SceneNode;

/// Value of a property. Spectra (rgb, srgb, spectrum, blackbody) arrive as linear Rec. 709 Color.
using Property = std::variant<bool, std::int64_t, double, std::string, Vec3f, Color, Transform>;

/// One element of a scene file, after defaults, $names, <include> and <ref> are resolved and both dialects are
/// spelled alike: types and property names in snake_case (to_world, int_ior), as the 3.x dialect writes them.
/// Knows nothing of what plugins mean.
struct SceneNode {
    std::string kind;   ///< "shape", "bsdf", "texture", "emitter", "sensor", "film", "sampler", "rfilter", "integrator", "medium", …
    std::string type;   ///< "obj", "roughplastic", …
    std::string id;     ///< may be empty
    SourceLocation where;
    bool early = false; ///< written for Mitsuba 0.4 to 0.6, for the few properties that mean something else there
    struct Entry { Property value; SourceLocation where; mutable bool used = false; };
    std::map<std::string, Entry> properties;
    /// name: role such as "reflectance"; may be empty. where: of the element or of the <ref> to it
    struct Child {
        std::string name;
        std::shared_ptr<const SceneNode> node;
        SourceLocation where{};
        mutable bool used = false;
    };
    std::vector<Child> children;
};

}  // namespace emca::render
