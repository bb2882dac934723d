#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "emca/render/bsdf_factory.h"
#include "emca/render/property_reader.h"
#include "emca/render/scene.h"

/// The steps of scene_loader.cpp: each reads the scene nodes of one kind into SceneParts.
namespace emca::render {

struct SceneBuilding {
    SceneParts& parts;
    std::span<const std::filesystem::path> searchFolders;
    FactoryContext& factories;
    PropertyReader reader(const SceneNode& node) const { return {node, parts.diagnostics, searchFolders}; }
};

/// Sensor with its film, filter and sampler.
void buildSensor(const SceneNode& sensor, SceneBuilding& building);
/// Integrator type and settings. An unknown type is replaced by "path".
void buildIntegrator(const SceneNode& integrator, SceneBuilding& building);
/// Shape, its material and its light. Nothing is added if its geometry cannot be had.
void buildShape(const SceneNode& shape, SceneBuilding& building);
/// A light of its own: point, spot, directional, constant, envmap.
void buildEmitter(const SceneNode& emitter, SceneBuilding& building);

/// Settings of the integrator of this name as far as it decides them: "path" or "direct".
/// \return false for other names
bool setIntegratorType(std::string_view type, IntegratorSettings& settings);

}  // namespace emca::render
