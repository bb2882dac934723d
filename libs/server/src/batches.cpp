#include "batches.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace emca {

namespace {

/// Passes on what concerns the whole request.
class BatchMonitor final : public RequestMonitor {
  public:
    BatchMonitor(RequestMonitor& request, const std::atomic<bool>& failed) : request_(request), failed_(failed) {}
    bool cancelled() const override { return failed_ || request_.cancelled(); }
    void progress(double) override {}
    void preview(PixelRect, const std::vector<Color>&) override {}
    void beginPixel(Pixel pixel) override { request_.beginPixel(pixel); }
    void endPixel(Pixel pixel) override { request_.endPixel(pixel); }

  private:
    RequestMonitor& request_;
    const std::atomic<bool>& failed_;
};

class Run {
  public:
    Run(const Batches& batches, RequestMonitor& monitor) : batches_(batches), monitor_(monitor) {}

    Result<void> all() {
        std::vector<std::thread> others;
        const std::size_t threads = std::min<std::size_t>(std::max(1u, batches_.threads), batches_.count);
        for (std::size_t i = 1; i < threads; ++i) others.emplace_back([this] { some(); });
        some();
        for (std::thread& thread : others) thread.join();
        if (thrown_) std::rethrow_exception(thrown_);
        if (error_) return *error_;
        return {};
    }

  private:
    void some() noexcept {
        try {
            BatchMonitor monitor(monitor_, failed_);
            while (!monitor.cancelled()) {
                const std::size_t batch = next_++;
                if (batch >= batches_.count) return;
                if (auto done = batches_.work(batch, monitor); !done) return fail(done.error());
                const std::lock_guard lock(mutex_);
                monitor_.progress(static_cast<double>(++done_) / static_cast<double>(batches_.count));
            }
            if (!failed_) fail({ErrorCode::cancelled, "The trace was cancelled."});
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!thrown_) thrown_ = std::current_exception();
            failed_ = true;
        }
    }

    /// Batches that end because another one failed come later than that one.
    void fail(Error error) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::move(error);
        failed_ = true;
    }

    const Batches& batches_;
    RequestMonitor& monitor_;
    std::atomic<std::size_t> next_{0};
    std::atomic<bool> failed_{false};
    std::mutex mutex_;  // guards the rest
    std::size_t done_ = 0;
    std::optional<Error> error_;
    std::exception_ptr thrown_;
};

}  // namespace

Result<void> runBatches(const Batches& batches, RequestMonitor& monitor) { return Run(batches, monitor).all(); }

}  // namespace emca
