#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/recorder/surface_recorder.h"

namespace emca {

/// What one render with layers collects into.
struct SurfaceCollection {
    SurfaceCollection(std::shared_ptr<const std::vector<Mesh>> scene, SurfaceOptions options)
        : meshes(std::move(scene)), recorder(*meshes, options) {}
    const std::shared_ptr<const std::vector<Mesh>> meshes;  ///< outlive the recorder
    SurfaceRecorder recorder;
};

/// What a renderer may announce. Errors: rendererFailed.
Result<void> checkLayers(const std::vector<LayerDescription>& layers);

}  // namespace emca
