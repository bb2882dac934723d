#pragma once

#include <pybind11/pybind11.h>

/// One function for each part of the extension module emca._native; emca/_native.pyi says what they add.
namespace emca::python {

void bindPaths(pybind11::module_& module);
void bindQuery(pybind11::module_& module);
void bindAnalysis(pybind11::module_& module);
void bindImages(pybind11::module_& module);
void bindScene(pybind11::module_& module);
void bindConnection(pybind11::module_& module);
void bindTrace(pybind11::module_& module);
void bindSession(pybind11::module_& module);
void bindRecorder(pybind11::module_& module);
void bindServer(pybind11::module_& module);

}  // namespace emca::python
