#pragma once

#include <pybind11/pybind11.h>

namespace emca::python {

/// While it lives, the calling thread does without the interpreter's lock: as pybind11's gil_scoped_release, but a
/// thread that wants the lock back when the interpreter exits waits for the end of the process. (The interpreter would
/// end such a thread in the middle of C++, which ends the process with it.)
class Unlocked {
  public:
    Unlocked() : state_(PyEval_SaveThread()) {}
    ~Unlocked();
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

  private:
    PyThreadState* state_;
};

/// What `work` returns, which needs nothing of the interpreter and must not touch it.
template <typename Work>
auto unlocked(Work&& work) {
    const Unlocked released;
    return work();
}

/// The interpreter exits: called once, by the thread that ends it. No other thread takes the lock back afterwards.
void beginExit();

}  // namespace emca::python
