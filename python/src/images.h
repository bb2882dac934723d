#pragma once

#include <pybind11/pybind11.h>

#include "emca/client/dataset.h"
#include "emca/core/image.h"

namespace emca::python {

namespace py = pybind11;

/// An image of an array of shape (height, width), (height, width, 1) or (height, width, channels). Copies.
/// \param channels  names; empty: by their number (Y; R, G, B; R, G, B, A; else "0", "1", …)
/// Raises ValueError for other shapes.
Image toImage(py::handle array, std::vector<std::string> channels = {});
/// Read-only view of shape (height, width, channels); None for an empty image.
py::object toArray(const Image& image, std::shared_ptr<const void> owner);

}  // namespace emca::python
