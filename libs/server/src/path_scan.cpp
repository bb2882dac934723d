#include "path_scan.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "match_keeper.h"

namespace emca {

namespace {

/// Paths of one recording: enough that its making costs nothing, few enough that they stay in a cache.
constexpr std::uint32_t kPathsPerBatch = 512;
/// No query takes longer on so few paths, unless somebody means harm.
constexpr std::chrono::seconds kLongestEvaluation{30};

/// Passes on what concerns the whole request, and swallows what a batch says of its own progress.
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

class Scan {
  public:
    Scan(Renderer& renderer, const query::Query& query, const ScanOptions& options, RequestMonitor& monitor)
        : renderer_(renderer), query_(query), options_(options), monitor_(monitor),
          keeper_(options.keep, options.keepCount, options.budgetBytes / 2), columns_(recordedColumns()) {
        const std::uint32_t samples = std::max(1u, options.settings.samplesPerPixel);
        batchSize_ = options.onePass ? options.pixels.size() : std::max(1u, kPathsPerBatch / samples);
        batchCount_ = (options.pixels.size() + batchSize_ - 1) / batchSize_;
        result_.values.resize(options.pixels.size());
        matched_.resize(options.pixels.size());
        sums_.resize(options.pixels.size());
    }

    Result<ScanResult> run() {
        const auto wanted = static_cast<std::size_t>(std::max(1u, options_.threads));
        threads_ = std::max<std::size_t>(1, std::min(wanted, batchCount_));
        std::vector<std::thread> others;
        for (std::size_t i = 1; i < threads_; ++i) others.emplace_back([this] { work(); });
        work();
        for (std::thread& thread : others) thread.join();
        if (thrown_) std::rethrow_exception(thrown_);
        if (error_) return *error_;
        result_.paths = keeper_.finish();
        result_.matches.omitted = result_.matches.matched - result_.paths.pathCount();
        result_.matches.missing.assign(missing_.begin(), missing_.end());
        result_.matches.matchedOfPixel = std::move(matched_);
        result_.matches.sumOfPixel = std::move(sums_);
        result_.complete = result_.matches.matched == result_.matches.paths && result_.matches.omitted == 0;
        return std::move(result_);
    }

  private:
    std::vector<std::string> recordedColumns() const {
        if (options_.keep != KeepMatches::none && options_.columns.empty()) return {};
        std::set<std::string> columns(query_.columns().begin(), query_.columns().end());
        columns.insert("estimate");  // sums and brightness
        if (options_.keep != KeepMatches::none) columns.insert(options_.columns.begin(), options_.columns.end());
        return {columns.begin(), columns.end()};
    }

    void work() noexcept {
        try {
            while (!failed_ && !monitor_.cancelled()) {
                const std::size_t batch = nextBatch_++;
                if (batch >= batchCount_) return;
                if (auto done = replay(batch); !done) return fail(done.error());
            }
            if (monitor_.cancelled()) fail({ErrorCode::cancelled, "The scan was cancelled."});
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!thrown_) thrown_ = std::current_exception();
            failed_ = true;
        }
    }

    void fail(Error error) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::move(error);
        failed_ = true;
    }

    Result<void> replay(std::size_t batch) {
        const std::size_t first = batch * batchSize_, last = std::min(first + batchSize_, options_.pixels.size());
        const std::vector<Pixel> pixels(options_.pixels.begin() + static_cast<std::ptrdiff_t>(first),
                                        options_.pixels.begin() + static_cast<std::ptrdiff_t>(last));
        RecordingOptions recorded;
        recorded.pixels = pixels;
        recorded.columns = columns_;
        recorded.budgetBytes = options_.budgetBytes / 2 / threads_;
        recorded.locations = options_.locations;
        recorded.observer = options_.observer;
        BatchMonitor monitor(monitor_, failed_);
        const auto replayed = replayPixels(renderer_, std::move(recorded), options_.settings, monitor);
        if (!replayed) return replayed.error();
        std::copy(replayed->values.begin(), replayed->values.end(), result_.values.begin() + static_cast<std::ptrdiff_t>(first));
        return evaluate(batch, first, pixels, replayed->paths, replayed->stats);
    }

    Result<void> evaluate(std::size_t batch, std::size_t first, const std::vector<Pixel>& pixels, const PathSet& paths,
                          const RecordingStats& stats) {
        query::EvaluationLimits limits;
        const auto deadline = std::chrono::steady_clock::now() + kLongestEvaluation;
        bool late = false;
        limits.cancelled = [&] {
            late = std::chrono::steady_clock::now() > deadline;
            return late || failed_ || monitor_.cancelled();
        };
        auto matches = query_.select(paths, limits);
        if (late) return Error{ErrorCode::tooLarge, "The query takes more than 30 seconds for a few pixels: use a simpler one, or fewer samples."};
        if (!matches) return matches.error();
        // Each pixel is in one batch, so that threads write to different places.
        std::size_t place = first;
        for (const Index path : matches->paths) {
            place = static_cast<std::size_t>(std::lower_bound(pixels.begin() + static_cast<std::ptrdiff_t>(place - first), pixels.end(), paths.pixel(path)) - pixels.begin()) + first;
            if (place >= first + pixels.size()) break;
            ++matched_[place];
            sums_[place] += paths.estimate(path).value_or(Color(0.f));
        }
        const std::lock_guard lock(mutex_);
        result_.matches.paths += paths.pathCount();
        result_.matches.matched += matches->paths.size();
        result_.matches.unknown += matches->unknown;
        note(matches->missing);
        add(stats);
        keeper_.add(batch, paths, matches->paths);
        monitor_.progress(static_cast<double>(++doneBatches_) / static_cast<double>(batchCount_));
        return {};
    }

    /// A name is missing if no batch has it.
    void note(const std::vector<std::string>& missing) {
        const std::set<std::string> here(missing.begin(), missing.end());
        if (doneBatches_ == 0) missing_ = here;
        else std::erase_if(missing_, [&](const std::string& name) { return !here.contains(name); });
    }

    void add(const RecordingStats& stats) {
        result_.stats.droppedWithoutPath += stats.droppedWithoutPath;
        result_.stats.droppedWithoutVertex += stats.droppedWithoutVertex;
        result_.stats.droppedByBudget += stats.droppedByBudget;
        result_.stats.pathsNotKept += stats.pathsNotKept;
        result_.stats.bytes = std::max(result_.stats.bytes, stats.bytes * threads_);
    }

    Renderer& renderer_;
    const query::Query& query_;
    const ScanOptions& options_;
    RequestMonitor& monitor_;
    std::size_t batchSize_ = 1, batchCount_ = 0, threads_ = 1;
    std::atomic<std::size_t> nextBatch_{0};
    std::atomic<bool> failed_{false};
    std::vector<std::uint32_t> matched_;
    std::vector<Color> sums_;

    std::mutex mutex_;  // guards the rest
    std::size_t doneBatches_ = 0;
    MatchKeeper keeper_;
    std::set<std::string> missing_;
    ScanResult result_;
    std::optional<Error> error_;
    std::exception_ptr thrown_;
    const std::vector<std::string> columns_;
};

}  // namespace

Result<ScanResult> replayPixels(Renderer& renderer, RecordingOptions recorded, const RenderSettings& settings, RequestMonitor& monitor) {
    Recording recording(std::move(recorded));
    const std::vector<Pixel>& pixels = recording.options().pixels;
    auto values = [&] {
        const RecordScope scope(recording);
        return renderer.renderPixels(pixels, settings, recording, monitor);
    }();
    if (!values) return values.error();
    if (values->size() != pixels.size()) {
        return Error{ErrorCode::rendererFailed, "The renderer returned " + std::to_string(values->size()) + " values for " +
                                                    std::to_string(pixels.size()) + " pixels."};
    }
    auto paths = recording.finish();
    if (!paths) return paths.error();
    ScanResult result;
    result.values = std::move(values).value();
    result.paths = std::move(paths).value();
    result.stats = recording.stats();
    return result;
}

Result<ScanResult> scanPaths(Renderer& renderer, const query::Query& query, const ScanOptions& options, RequestMonitor& monitor) {
    return Scan(renderer, query, options, monitor).run();
}

}  // namespace emca
