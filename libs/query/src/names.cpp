// What a query may name: quantities, functions, domains.
#include <algorithm>

#include "syntax.h"

namespace emca::query::detail {

Domain parent(Domain domain) {
    switch (domain) {
        case Domain::contribution:
        case Domain::nextEvent: return Domain::vertex;
        case Domain::vertex: return Domain::path;
        case Domain::path: return Domain::pixel;
        default: return Domain::constant;
    }
}

bool encloses(Domain outer, Domain inner) {
    while (inner > outer) inner = parent(inner);
    return inner == outer;
}

const char* prefix(Domain domain) {
    switch (domain) {
        case Domain::vertex: return "v";
        case Domain::contribution: return "c";
        case Domain::nextEvent: return "n";
        default: return "";
    }
}

const std::vector<CoreName>& coreNames() {
    static const std::vector<CoreName> names{
        {"pixel", Domain::path, Core::pixel, Type::vector, 2, "", "column and row: pixel.x, pixel.y"},
        {"sample", Domain::path, Core::sample, Type::number, 1, "", "index of the sample in its pixel"},
        {"part", Domain::path, Core::part, Type::number, 1, "", "which part of a sample that splits"},
        {"origin", Domain::path, Core::origin, Type::vector, 3, "origin", "where the path starts"},
        {"estimate", Domain::path, Core::estimate, Type::color, 3, "estimate", "the path's value, before division by samples per pixel"},
        {"luminance", Domain::path, Core::luminance, Type::number, 1, "estimate", "of the estimate"},
        {"depth", Domain::path, Core::depth, Type::number, 1, "position", "largest depth index with a position"},
        {"vertices", Domain::path, Core::vertices, Type::number, 1, "", "number of vertices"},
        {"contributions", Domain::path, Core::contributions, Type::number, 1, "contribution", "number of contributions"},
        {"splats", Domain::path, Core::splats, Type::number, 1, "splat", "number of splats"},
        {"depth", Domain::vertex, Core::vertexDepth, Type::number, 1, "", "depth index; the first hit has 1"},
        {"index", Domain::vertex, Core::vertexIndex, Type::number, 1, "", "place in the path, from 0"},
        {"position", Domain::vertex, Core::position, Type::vector, 3, "position", "world space"},
        {"segment", Domain::vertex, Core::segment, Type::number, 1, "position", "distance from the vertex before it on its subpath; the first has none"},
        {"estimate", Domain::vertex, Core::vertexEstimate, Type::color, 3, "intersection estimate", "camera-weighted running sum"},
        {"luminance", Domain::vertex, Core::vertexLuminance, Type::number, 1, "intersection estimate", "of the running sum"},
        {"emission", Domain::vertex, Core::emission, Type::color, 3, "emission", "unweighted emitted radiance"},
        {"mesh", Domain::vertex, Core::mesh, Type::number, 1, "surface", "index of the mesh"},
        {"face", Domain::vertex, Core::face, Type::number, 1, "surface", "index of the triangle in its mesh"},
        {"event", Domain::vertex, Core::event, Type::text, 0, "event", "reflect, transmit, volume, emission, background, absorb, pass"},
        {"lobe", Domain::vertex, Core::lobe, Type::text, 0, "event", "diffuse, glossy, specular, straight, none"},
        {"label", Domain::vertex, Core::label, Type::text, 0, "event", "the renderer's word for the material"},
        {"environment", Domain::vertex, Core::environment, Type::boolean, 1, "", "the path left the scene here"},
        {"subpath", Domain::vertex, Core::subpath, Type::text, 0, "", "camera or light"},
        {"last", Domain::vertex, Core::isLast, Type::boolean, 1, "", "no vertex of the path comes after it"},
        {"value", Domain::contribution, Core::value, Type::color, 3, "contribution", "light added, camera- and MIS-weighted"},
        {"luminance", Domain::contribution, Core::valueLuminance, Type::number, 1, "contribution", "of the light added"},
        {"technique", Domain::contribution, Core::technique, Type::text, 0, "contribution", "how it was found"},
        {"weight", Domain::contribution, Core::weight, Type::number, 1, "contribution", "MIS weight"},
        {"end", Domain::contribution, Core::end, Type::text, 0, "contribution", "hit, connected or automatic"},
        {"depth", Domain::contribution, Core::contributionDepth, Type::number, 1, "contribution", "depth index of its vertex"},
        {"position", Domain::nextEvent, Core::nextEventPosition, Type::vector, 3, "nee", "the point on the light"},
        {"visible", Domain::nextEvent, Core::visible, Type::boolean, 1, "nee", "nothing was in between"},
        {"depth", Domain::nextEvent, Core::nextEventDepth, Type::number, 1, "nee", "depth index of its vertex"},
    };
    return names;
}

const CoreName* findCore(Domain domain, std::string_view name) {
    for (const CoreName& core : coreNames())
        if (core.domain == domain && name == core.name) return &core;
    return nullptr;
}

const std::vector<Function>& functions() {
    static const std::vector<Function> table{
        {"luminance", Op::luminance, 1, 1, "of a colour (Rec. 709)"},
        {"abs", Op::abs, 1, 1, ""}, {"sqrt", Op::sqrt, 1, 1, ""}, {"exp", Op::exp, 1, 1, ""},
        {"log", Op::log, 1, 1, "natural"}, {"log2", Op::log2, 1, 1, ""}, {"log10", Op::log10, 1, 1, ""},
        {"floor", Op::floor, 1, 1, ""}, {"ceil", Op::ceil, 1, 1, ""}, {"round", Op::round, 1, 1, "halves away from zero"},
        {"sin", Op::sin, 1, 1, "of radians"}, {"cos", Op::cos, 1, 1, ""}, {"tan", Op::tan, 1, 1, ""},
        {"asin", Op::asin, 1, 1, ""}, {"acos", Op::acos, 1, 1, ""}, {"atan", Op::atan, 1, 1, ""},
        {"atan2", Op::atan2, 2, 2, "of y and x"},
        {"pow", Op::power, 2, 2, "as ^"}, {"min", Op::minimum, 2, -1, ""}, {"max", Op::maximum, 2, -1, ""},
        {"clamp", Op::clamp, 3, 3, "value, lowest, highest"},
        {"length", Op::length, 1, 1, "of a vector"}, {"distance", Op::distance, 2, 2, "of two points"},
        {"dot", Op::dot, 2, 2, ""}, {"cross", Op::cross, 2, 2, ""}, {"normalize", Op::normalize, 1, 1, ""},
        {"vector", Op::makeVector, 2, 3, ""}, {"color", Op::makeColor, 3, 3, ""},
        {"nan", Op::isNan, 1, 1, "any component is not a number"}, {"inf", Op::isInf, 1, 1, "any component is infinite"},
        {"finite", Op::isFinite, 1, 1, "all components are"}, {"has", Op::has, 1, 1, "it was recorded"},
        {"contains", Op::contains, 2, 2, "a text another"}, {"starts_with", Op::startsWith, 2, 2, ""},
        {"matches", Op::matches, 2, 2, "a text a regular expression (RE2)"},
        {"if", Op::choose, 3, 3, "condition, value if true, value if false"},
        {"any", Op::any, 1, 1, "true for one at least"}, {"all", Op::all, 1, 1, "true for every one"},
        {"none", Op::none, 1, 1, "true for no one"}, {"count", Op::count, 1, 1, "for how many it is true"},
        {"first", Op::first, 1, 2, "the first value that is known [where the second is true]"},
        {"last", Op::last, 1, 2, "the last one"},
        {"sum", Op::sum, 1, 2, "of the values that are known [where the second is true]"}, {"mean", Op::mean, 1, 2, ""},
        {"variance", Op::variance, 1, 2, "of the sample, divided by n - 1"},
        {"min", Op::least, 1, 1, ""}, {"max", Op::greatest, 1, 1, ""},
        {"quantile", Op::quantile, 2, 3, "value, fraction in [0, 1]; between two values linearly"},
    };
    return table;
}

const Function* findFunction(std::string_view name, std::size_t arguments) {
    const Function* found = nullptr;
    for (const Function& f : functions()) {
        if (name != f.name) continue;
        const auto count = static_cast<int>(arguments);
        if (count >= f.minimumArguments && (f.maximumArguments < 0 || count <= f.maximumArguments)) return &f;
        if (!found) found = &f;
    }
    return found;
}

bool isReduction(Op op) { return op >= Op::any; }

}  // namespace emca::query::detail
