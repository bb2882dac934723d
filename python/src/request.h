#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "emca/recorder/recording.h"
#include "emca/server/renderer.h"

/// What the methods of a renderer in Python get besides settings. They end with the call: used later, they raise
/// RuntimeError. All need the interpreter's lock.
namespace emca::python {

namespace py = pybind11;

/// One call of the server. Python objects share it; the call itself takes everything away at its end.
struct Call {
    RequestMonitor* monitor = nullptr;
    Recording* recording = nullptr;
    int openScopes = 0;  ///< of threads that record for this call
};

/// Makes a call's Python arguments and takes their insides away at its end. Threads that still record are waited for,
/// without the interpreter's lock.
class CallArguments {
  public:
    CallArguments(RequestMonitor& monitor, Recording* recording);
    ~CallArguments();
    CallArguments(const CallArguments&) = delete;
    CallArguments& operator=(const CallArguments&) = delete;
    py::object monitor() const;
    py::object recording() const;

  private:
    std::shared_ptr<Call> call_;
};

}  // namespace emca::python
