#pragma once

#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <mutex>
#include <thread>

namespace emca::imageio {

/// Threads for OpenEXR's compression of `bytes` of pixels or file. Its pool belongs to the process and has no thread
/// until somebody wants one; a pool that the host program has chosen stays as it is.
inline int exrThreads(std::uintmax_t bytes) {
    constexpr std::uintmax_t kWorthAThread = 1u << 20;
    if (bytes < kWorthAThread) return 0;
    static std::once_flag once;
    std::call_once(once, [] {
        if (Imf::globalThreadCount() == 0)
            Imf::setGlobalThreadCount(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
    });
    return Imf::globalThreadCount();
}

}  // namespace emca::imageio
