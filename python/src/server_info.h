#pragma once

#include <pybind11/pybind11.h>

namespace emca::python {

/// ServerInfo as a class of Python, so that sessions can hold what a connection said.
void bindServerInfo(pybind11::module_& module);

}  // namespace emca::python
