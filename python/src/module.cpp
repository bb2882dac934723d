#include "bindings.h"
#include "errors.h"
#include "unlocked.h"

PYBIND11_MODULE(_native, module) {
    using namespace emca::python;
    module.doc() = "The compiled half of emca; use the package emca instead.";
    module.attr("__version__") = EMCA_VERSION;
    bindErrors();
    module.def("begin_exit", &beginExit);
    bindPaths(module);
    bindQuery(module);
    bindAnalysis(module);
    bindImages(module);
    bindScene(module);
    bindConnection(module);
    bindTrace(module);
    bindSession(module);
    bindRecorder(module);
    bindServer(module);
}
