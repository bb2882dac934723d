#include "emca/adapter/ending_signal.h"

#include <pthread.h>

#include <cstdlib>
#include <utility>

namespace emca::adapter {

EndingSignal::EndingSignal() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    thread_ = std::thread([this] { wait(); });
}

EndingSignal::~EndingSignal() {
    {
        const std::lock_guard lock(mutex_);
        finished_ = true;
    }
    pthread_kill(thread_.native_handle(), SIGTERM);  // wakes the thread if it still waits
    thread_.join();
}

void EndingSignal::setAction(std::function<void()> action) {
    const std::lock_guard lock(mutex_);
    action_ = std::move(action);
}

void EndingSignal::wait() {
    int signal = 0;
    sigwait(&signals_, &signal);
    const std::lock_guard lock(mutex_);
    if (finished_) return;
    if (!action_) std::_Exit(128 + signal);  // as a shell reports a program that the signal ended
    action_();
}

}  // namespace emca::adapter
