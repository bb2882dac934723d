#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/value.h"
#include "wire.h"

// What a published server says, as it says it. Every read function leaves the reader behind the message, or failed.
namespace emca::bridge {

struct PublishedInfo {
    std::string renderer, scene;
    std::uint32_t samplesPerPixel = 0;
};

/// World space. `fieldOfView`: degrees, of an axis that the wire does not name.
struct PublishedCamera {
    Vec3f origin, direction, up;
    float nearClip = 0, farClip = 0, fieldOfView = 0;
};

struct PublishedSphere {
    Vec3f centre;
    float radius = 0;
};

/// World space. A sphere has neither vertices nor triangles.
struct PublishedShape {
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
    std::vector<Color> faceColors;  ///< one per triangle, or none
    std::optional<PublishedSphere> sphere;
    ColorA diffuse, specular;
};

struct PublishedScene {
    struct HeatMap {
        std::string colorMap, label;
        bool colorBar = false;
    };
    std::optional<HeatMap> heatMap;  ///< if there is one, the shapes are divided by it and their faces have its values
    std::vector<PublishedShape> shapes;
};

struct PublishedImage {
    std::string path;                      ///< on the server's disk
    std::optional<PublishedScene> scene;   ///< where the render collected a heat map
};

using PublishedData = std::vector<std::pair<std::string, Value>>;

struct PublishedIntersection {
    PublishedData data;
    std::uint32_t depth = 0;
    std::optional<Vec3f> position;
    struct NextEvent {
        Vec3f position;
        bool visible = false;
    };
    std::optional<NextEvent> nextEvent;
    std::optional<ColorA> estimate, emission;
};

struct PublishedPath {
    PublishedData data;
    std::uint32_t sample = 0;
    std::uint32_t depth = 0;  ///< kNoDepth: none was set
    Vec3f origin;
    std::optional<ColorA> estimate;
    std::vector<PublishedIntersection> intersections;
};
inline constexpr std::uint32_t kNoDepth = 0xffffffffu;

struct PublishedPixel {
    std::uint32_t announced = 0;        ///< paths; more than `paths` has if the server miscounted
    std::vector<PublishedPath> paths;   ///< in the order in which they came
    std::string remark;                 ///< for people; empty if all came as announced
    bool endedBySilence = false;        ///< the server did not go on after the last path
};

// Bodies of replies: what follows the message id.
PublishedInfo readInfo(WireReader& in);
PublishedCamera readCamera(WireReader& in);
PublishedScene readScene(WireReader& in);

/// \param next  what the server sends after this reply, so that an end before the announced number of paths is seen at
///              once; empty: nothing is known of it, and only silence ends the paths that do not come
///
/// Paths that are missing at the end are no failure: published servers announce one too many for renderers that count
/// samples from 1, and one more for each gap. The reader fails if a path is cut.
PublishedPixel readPixel(WireReader& in, std::span<const std::byte> next);

}  // namespace emca::bridge
