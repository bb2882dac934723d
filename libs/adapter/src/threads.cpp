#include "threads.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace emca::adapter {

Result<void> onThreads(unsigned threads, const std::function<Result<void>(const std::atomic<bool>& stop)>& work) {
    std::atomic<bool> stop = false;
    std::mutex mutex;
    Result<void> first;
    std::exception_ptr thrown;
    const auto body = [&] {
        try {
            if (auto done = work(stop); !done && !stop.exchange(true)) {
                const std::lock_guard lock(mutex);
                first = done;
            }
        } catch (...) {
            if (stop.exchange(true)) return;
            const std::lock_guard lock(mutex);
            thrown = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> all;
        const unsigned count = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
        for (unsigned i = 0; i < count; ++i) all.emplace_back(body);
    }
    if (thrown) std::rethrow_exception(thrown);
    return first;
}

}  // namespace emca::adapter
