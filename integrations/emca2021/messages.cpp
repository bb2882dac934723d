#include "messages.h"

#include <algorithm>
#include <limits>

namespace emca::bridge {

namespace {

Vec2f pair(WireReader& in) {
    const float x = in.real(), y = in.real();
    return {x, y};
}

Vec2i wholePair(WireReader& in) {
    const std::int64_t x = in.integer<std::int32_t>(), y = in.integer<std::int32_t>();
    return {x, y};
}

Vec3i wholeTriple(WireReader& in) {
    const std::int64_t x = in.integer<std::int32_t>(), y = in.integer<std::int32_t>(), z = in.integer<std::int32_t>();
    return {x, y, z};
}

std::string printable(char c) { return c > ' ' && c < 127 ? std::string(1, c) : "byte " + std::to_string(static_cast<unsigned char>(c)); }

/// A value behind its type: a letter as in Python's struct module, with a count before it where there are several.
Value readValue(WireReader& in, const std::string& key) {
    const char first = in.integer<char>();
    const bool several = first >= '2' && first <= '4';
    const char letter = several ? in.integer<char>() : first;
    const int size = several ? first - '0' : 1;
    if (!in.ok()) return {};
    switch (letter) {
    case '?':
        if (size == 1) return in.boolean("a yes or no");
        break;
    case 'i':
        if (size == 1) return std::int64_t(in.integer<std::int32_t>());
        if (size == 2) return wholePair(in);
        if (size == 3) return wholeTriple(in);
        break;
    case 'f':
        if (size == 1) return in.real();
        if (size == 2) return pair(in);
        if (size == 3) return in.vector();
        return in.color();
    case 'd':
        if (size == 1) return in.real64();
        break;
    case 's':
        if (size == 1) return in.text(in.limits().textBytes, "a text");
        break;
    default:
        break;
    }
    in.fail(ErrorCode::protocolViolation, "The value of \"" + key.substr(0, 100) + "\" has the type \"" + (several ? std::to_string(size) : "") + printable(letter) +
                                              "\", which published servers (2021) do not have, so that nothing behind it can be read.");
    return {};
}

PublishedData readData(WireReader& in) {
    PublishedData data;
    const std::uint32_t count = in.count(in.limits().valuesOfItem, "values of one path or intersection");
    for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
        std::string key = in.text(in.limits().nameBytes, "a name");
        Value value = readValue(in, key);
        if (in.ok()) data.emplace_back(std::move(key), std::move(value));
    }
    return data;
}

/// The recorder's indices are signed.
std::uint32_t depthIndex(WireReader& in) {
    const auto depth = in.integer<std::uint32_t>();
    if (in.ok() && depth > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max())) {
        in.fail(ErrorCode::protocolViolation, "An intersection has the depth " + std::to_string(depth) + ", more than any path has: the server's reply went wrong.");
    }
    return depth;
}

PublishedIntersection readIntersection(WireReader& in) {
    PublishedIntersection at;
    at.data = readData(in);
    at.depth = depthIndex(in);
    if (in.boolean("a position")) at.position = in.vector();
    if (in.boolean("a next-event estimation")) {
        const Vec3f position = in.vector();
        at.nextEvent = {position, in.boolean("something visible")};
    }
    if (in.boolean("an estimate")) at.estimate = in.color();
    if (in.boolean("emission")) at.emission = in.color();
    return at;
}

PublishedPath readPath(WireReader& in) {
    PublishedPath path;
    path.data = readData(in);
    path.sample = in.integer<std::uint32_t>();
    path.depth = in.integer<std::uint32_t>();
    path.origin = in.vector();
    if (in.boolean("a final estimate")) path.estimate = in.color();
    const std::uint32_t count = in.count(in.limits().intersectionsOfPath, "intersections of one path");
    for (std::uint32_t i = 0; i < count && in.ok(); ++i) path.intersections.push_back(readIntersection(in));
    return path;
}

PublishedShape readShape(WireReader& in, std::uint32_t index) {
    constexpr std::int16_t kTriangles = 0, kSphere = 1;
    PublishedShape shape;
    const auto type = in.integer<std::int16_t>();
    if (!in.ok()) return shape;
    if (type == kSphere) {
        const float radius = in.real();
        shape.sphere = {in.vector(), radius};
    } else if (type == kTriangles) {
        shape.positions = in.array<Vec3f>(in.count(in.limits().verticesOfMesh, "vertices of one mesh"));
        shape.triangles = in.array<Triangle>(in.count(in.limits().trianglesOfMesh, "triangles of one mesh"));
        const std::uint32_t colors = in.count(in.limits().trianglesOfMesh, "face colours of one mesh");
        if (in.ok() && colors != 0 && colors != shape.triangles.size()) {
            in.fail(ErrorCode::protocolViolation, "Mesh " + std::to_string(index) + " has " + std::to_string(colors) + " face colours for " +
                                                      std::to_string(shape.triangles.size()) + " triangles: the server's reply went wrong.");
        }
        shape.faceColors = in.array<Color>(colors);
    } else {
        in.fail(ErrorCode::protocolViolation, "Shape " + std::to_string(index) + " is of type " + std::to_string(type) +
                                                  ", which published servers (2021) do not have, so that nothing behind it can be read.");
    }
    shape.diffuse = in.color();
    shape.specular = in.color();
    return shape;
}

std::string missing(std::uint32_t announced, std::size_t came) {
    std::string text = "The published server announced " + std::to_string(announced) + " paths and sent " + std::to_string(came) + ": ";
    if (announced == came + 1) return text + "as it does where a renderer counts samples from 1. Nothing is lost.";
    return text + "as it does for sample indices with gaps. If the renderer has no gaps, it failed.";
}

}  // namespace

PublishedInfo readInfo(WireReader& in) {
    PublishedInfo info;
    info.renderer = in.text(in.limits().nameBytes, "the renderer's name");
    info.scene = in.text(in.limits().nameBytes, "the scene's name");
    info.samplesPerPixel = in.integer<std::uint32_t>();
    return info;
}

PublishedCamera readCamera(WireReader& in) {
    PublishedCamera camera;
    camera.origin = in.vector();
    camera.direction = in.vector();
    camera.up = in.vector();
    camera.nearClip = in.real();
    camera.farClip = in.real();
    camera.fieldOfView = in.real();
    return camera;
}

PublishedScene readScene(WireReader& in) {
    PublishedScene scene;
    if (in.boolean("a heat map")) {
        PublishedScene::HeatMap heatMap;
        heatMap.colorMap = in.text(in.limits().nameBytes, "a colour map's name");
        heatMap.colorBar = in.boolean("a colour bar");
        heatMap.label = in.text(in.limits().nameBytes, "a heat map's label");
        scene.heatMap = std::move(heatMap);
    }
    const std::uint32_t count = in.count(in.limits().meshes, "meshes");
    for (std::uint32_t i = 0; i < count && in.ok(); ++i) scene.shapes.push_back(readShape(in, i));
    if (!in.ok()) return {};
    return scene;
}

PublishedPixel readPixel(WireReader& in, std::span<const std::byte> next) {
    PublishedPixel pixel;
    pixel.announced = in.count(in.limits().paths, "paths");
    while (in.ok() && pixel.paths.size() < pixel.announced) {
        if (!in.wait() && in.error().code == ErrorCode::timedOut) {
            // Between two paths: what came is whole. Anywhere else, silence is a failure.
            in.forgive();
            pixel.endedBySilence = true;
            pixel.remark = missing(pixel.announced, pixel.paths.size());
            break;
        }
        if (!next.empty() && in.nextIs(next)) {
            pixel.remark = missing(pixel.announced, pixel.paths.size());
            break;
        }
        PublishedPath path = readPath(in);
        if (in.ok()) pixel.paths.push_back(std::move(path));
    }
    in.explain(" (after " + std::to_string(pixel.paths.size()) + " of " + std::to_string(pixel.announced) + " paths)");
    return pixel;
}

}  // namespace emca::bridge
