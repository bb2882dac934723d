#include "thread_registration.h"

#include <mitsuba/core/thread.h>
#include <mitsuba/core/tls.h>

namespace emca::mitsuba06 {

namespace {

/// Mitsuba keeps data of each thread; for threads that it did not start, nobody else would free them.
struct ThreadData {
    bool registered = false;
    ~ThreadData() {
        if (registered) mts::detail::destroyLocalTLS();
    }
};

thread_local ThreadData threadData;

bool isKnown() {
    try {
        return mts::Thread::getThread() != nullptr;
    } catch (const std::exception&) {
        return false;  // Mitsuba says so by throwing
    }
}

}  // namespace

ThreadRegistration::ThreadRegistration()
    : logger_(mts::Thread::getThread()->getLogger()), files_(mts::Thread::getThread()->getFileResolver()) {}

void ThreadRegistration::registerThisThread() const {
    if (threadData.registered || isKnown()) return;
    mts::Thread* const thread = mts::Thread::registerUnmanagedThread("emca");
    thread->setLogger(logger_.get());
    thread->setFileResolver(files_.get());
    threadData.registered = true;
}

}  // namespace emca::mitsuba06
