#include "interrupt.h"

#include <csignal>

namespace emca::cli {
namespace {

// All that a signal handler may touch: a lock-free flag that outlives every call of the handler.
std::atomic<std::atomic<bool>*> current{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::atomic<bool>*>::is_always_lock_free);

extern "C" void emcaCliInterrupted(int signal) {
    if (std::atomic<bool>* flag = current.load()) flag->store(true);
    std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() : flag_(std::make_shared<std::atomic<bool>>(false)) {
    current = flag_.get();
    std::signal(SIGINT, emcaCliInterrupted);
    std::signal(SIGTERM, emcaCliInterrupted);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    current = nullptr;
}

}  // namespace emca::cli
