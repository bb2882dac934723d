#include "waiting.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "unlocked.h"

namespace emca::python {
namespace {

/// How soon Ctrl-C is noticed.
constexpr auto kPatience = std::chrono::milliseconds(50);

/// Shared by who waits and who works.
struct Progress {
    std::mutex mutex;
    std::condition_variable changed;
    bool done = false;
    double fraction = -1;  ///< the newest, -1 if it was told already
    std::exception_ptr failure;

    void finish(std::exception_ptr exception) {
        const std::lock_guard lock(mutex);
        done = true;
        failure = std::move(exception);
        changed.notify_all();
    }
    void advance(double to) {
        const std::lock_guard lock(mutex);
        fraction = to;
        changed.notify_all();
    }
    /// Waits a little without the interpreter's lock. \return whether the work is done; `told` is the fraction, or -1
    bool wait(double& told) {
        const Unlocked unlocked;
        std::unique_lock lock(mutex);
        changed.wait_for(lock, kPatience, [this] { return done || fraction >= 0; });
        told = std::exchange(fraction, -1);
        return done;
    }
};

template <typename Work>
void runAndTell(Progress& progress, const Work& work) {
    std::exception_ptr failure;
    try {
        work();
    } catch (...) {
        failure = std::current_exception();
    }
    progress.finish(std::move(failure));
}

void checkSignals() {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void runInterruptibly(const Work& work, const py::object& progress) {
    Progress state;
    client::RequestObserver observer;
    observer.cancel = std::make_shared<std::atomic<bool>>(false);
    if (!progress.is_none()) observer.progress = [&state](double fraction) { state.advance(fraction); };
    std::thread worker([&] { runAndTell(state, [&] { work(observer); }); });
    std::exception_ptr raised;  // by Python
    double told = -1, last = -1;
    for (bool done = false; !done;) {
        done = state.wait(told);
        try {
            if (raised) continue;
            checkSignals();
            if (told >= 0 && told != last) progress(last = told);
        } catch (...) {
            raised = std::current_exception();
            *observer.cancel = true;
        }
    }
    {
        const Unlocked unlocked;
        worker.join();
    }
    if (raised) std::rethrow_exception(raised);
    if (state.failure) std::rethrow_exception(state.failure);
}

void runOrAbandon(std::function<void()> work) {
    const auto state = std::make_shared<Progress>();
    std::thread([state, work = std::move(work)] { runAndTell(*state, work); }).detach();
    double told = -1;
    while (!state->wait(told)) checkSignals();
    if (state->failure) std::rethrow_exception(state->failure);
}

}  // namespace emca::python
