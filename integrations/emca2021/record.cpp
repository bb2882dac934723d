#include <limits>
#include <map>
#include <type_traits>
#include <variant>

#include "bridge_renderer.h"
#include "emca/recorder/recorder.h"

namespace emca::bridge {

namespace {

// Colours of the recorder's own quantities have no alpha; published ones nearly always say 1.
constexpr float kOpaque = 1;

template <typename Add>
void addAll(const PublishedData& data, Add add) {
    for (const auto& [name, value] : data) {
        std::visit([&, &key = name](const auto& v) {
            // Published servers have no short arrays.
            if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(v)>, std::vector<float>>) add(Key(key), v);
        }, value);
    }
}

Color opaque(ColorA c) { return {c.r, c.g, c.b}; }

void record(PathRecorder& emca, const PublishedIntersection& at) {
    emca.setDepthIndex(static_cast<std::int32_t>(at.depth));
    if (at.position) emca.setIntersectionPos(*at.position);
    if (at.nextEvent) emca.setNextEventEstimationPos(at.nextEvent->position, at.nextEvent->visible);
    if (at.estimate) {
        emca.setIntersectionEstimate(opaque(*at.estimate));
        if (at.estimate->a != kOpaque) emca.addIntersectionData("alpha of the estimate", at.estimate->a);
    }
    if (at.emission) {
        emca.setIntersectionEmission(opaque(*at.emission));
        if (at.emission->a != kOpaque) emca.addIntersectionData("alpha of the emission", at.emission->a);
    }
    addAll(at.data, [&](Key key, const auto& value) { emca.addIntersectionData(key, value); });
}

/// The depth that the server states is that of the deepest intersection, where it has one.
bool statesOtherDepth(const PublishedPath& path) {
    std::uint32_t deepest = kNoDepth;
    for (const PublishedIntersection& at : path.intersections) deepest = deepest == kNoDepth ? at.depth : std::max(deepest, at.depth);
    return path.depth != deepest && path.depth != kNoDepth;
}

}  // namespace

void record(const PublishedPixel& pixel) {
    PathRecorder& emca = recorder();
    std::map<std::uint32_t, std::int32_t> seen;  // a renderer may use an index twice: parts of one sample
    for (const PublishedPath& path : pixel.paths) {
        emca.setPathIndex(path.sample, seen[path.sample]++);
        emca.setPathOrigin(path.origin);
        addAll(path.data, [&](Key key, const auto& value) { emca.addPathData(key, value); });
        if (statesOtherDepth(path)) emca.addPathData("published depth", path.depth);
        for (const PublishedIntersection& at : path.intersections) record(emca, at);
        if (path.estimate) {
            emca.setFinalEstimate(opaque(*path.estimate));
            if (path.estimate->a != kOpaque) emca.addPathData("alpha of the final estimate", path.estimate->a);
        }
        if (&path == &pixel.paths.front() && !pixel.remark.empty()) emca.addPathData("remark of the bridge", pixel.remark);
        emca.endPath();
    }
}

}  // namespace emca::bridge
