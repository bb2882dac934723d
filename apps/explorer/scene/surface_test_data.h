#pragma once

#include <memory>
#include <vector>

#include "emca/client/dataset.h"
#include "emca/core/surface_field.h"

namespace emca::explorer::testing {

/// A wall of 4 x 4 units at z = 0 that faces +z, and a smaller one behind it without data.
inline std::shared_ptr<const std::vector<Mesh>> wallMeshes() {
    Mesh wall, plain;
    wall.name = "wall";
    wall.positions = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    plain.name = "plain";
    plain.positions = {{2.2f, -1, -1}, {4, -1, -1}, {4, 1, -1}};
    plain.triangles = {{0, 1, 2}};
    return std::make_shared<const std::vector<Mesh>>(std::vector<Mesh>{wall, plain});
}

/// The first triangle of the wall is divided once: refined faces 0 to 3, then 4.
inline std::shared_ptr<const SurfaceField> wallField() {
    auto field = std::make_shared<SurfaceField>();
    field->meshes = {{{{1}}, 0, 5}, {{}, 5, 0}};
    const auto layer = [&](const char* name, LayerKind kind, const char* unit, std::vector<float> values) {
        field->layers.push_back({{name, kind, unit, "a test"}, SharedArray<float>(std::move(values)), 42, 15});
    };
    layer("depth", LayerKind::mean, "vertices", {1, 2, 3, 4, 5});
    layer("hits", LayerKind::density, "1/unit²", {0, 10, 100, 1000, 10000});
    layer("albedo", LayerKind::meanColor, "", {0.2f, 0.1f, 0.1f, 0.1f, 0.2f, 0.1f, 0.1f, 0.1f, 0.2f, 0.05f, 0.05f, 0.05f, 0.4f, 0.2f, 0.1f});
    field->points = SharedArray<float>(std::vector<float>{10, 10, 0, 10, 12});
    field->counts.points = 42;
    field->counts.bytesUsed = 4096;
    field->counts.budgetBytes = 1 << 20;
    return field;
}

inline void fillWall(client::Dataset& dataset) {
    const client::Dataset::Transaction together(dataset);
    client::ServerInfo info;
    info.width = info.height = 64;
    dataset.setInfo(info);
    Camera camera;
    camera.position = {0, 0, 8};
    camera.direction = {0, 0, -1};
    camera.up = {0, 1, 0};
    camera.verticalFieldOfView = 40;
    dataset.setCamera(camera);
    dataset.setMeshes(wallMeshes());
    dataset.setSurface(wallField());
}

}  // namespace emca::explorer::testing
