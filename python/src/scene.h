#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "emca/client/connection.h"
#include "emca/core/camera.h"
#include "emca/core/mesh.h"
#include "emca/core/surface_field.h"

/// Between our values and those of emca/scene.py. All need the interpreter's lock.
namespace emca::python {

namespace py = pybind11;

/// \param camera  emca.Camera, or what has its attributes
Camera toCamera(py::handle camera);
py::dict toDict(const Camera& camera);

/// \param meshes  a sequence of emca.Mesh. Raises ValueError for indices beyond a mesh's positions.
std::vector<Mesh> toMeshes(py::handle meshes);
/// Dictionaries with the attributes of emca.Mesh; arrays are views that keep `meshes` alive.
py::list toList(const std::shared_ptr<const std::vector<Mesh>>& meshes);

py::dict toDict(const LayerDescription& layer);

/// A surface field as Python holds it.
struct SharedField {
    std::shared_ptr<const SurfaceField> field;
};

}  // namespace emca::python
