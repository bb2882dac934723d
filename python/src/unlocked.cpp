#include "unlocked.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace emca::python {
namespace {

std::atomic<bool> exiting{false};
std::atomic<int> returning{0};  ///< threads that take the lock back right now
thread_local bool endsInterpreter = false;

[[noreturn]] void waitForTheEnd() {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

Unlocked::~Unlocked() {
    ++returning;
    if (exiting && !endsInterpreter) {
        --returning;
        waitForTheEnd();
    }
    PyEval_RestoreThread(state_);
    --returning;
}

void beginExit() {
    endsInterpreter = true;
    exiting = true;
    PyThreadState* const state = PyEval_SaveThread();
    while (returning > 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
    PyEval_RestoreThread(state);
}

}  // namespace emca::python
