#include "path_scan.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <set>

#include "batches.h"
#include "match_keeper.h"

namespace emca {

namespace {

/// Paths of a batch: enough that making a recording costs nothing, few enough that they stay in a cache.
constexpr std::uint32_t kPathsPerBatch = 512;
/// No query takes longer on so few paths, unless somebody means harm.
constexpr std::chrono::seconds kLongestEvaluation{30};

Error wrongCount(std::size_t values, std::size_t pixels) {
    return {ErrorCode::rendererFailed, "The renderer returned " + std::to_string(values) + " values for " + std::to_string(pixels) + " pixels."};
}

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
        const auto scanned = runBatches({batchCount_, options_.threads, [this](std::size_t batch, RequestMonitor& monitor) { return replay(batch, monitor); }}, monitor_);
        if (!scanned) return scanned.error();
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

    Result<void> replay(std::size_t batch, RequestMonitor& monitor) {
        const std::size_t first = batch * batchSize_, last = std::min(first + batchSize_, options_.pixels.size());
        const std::vector<Pixel> pixels(options_.pixels.begin() + static_cast<std::ptrdiff_t>(first),
                                        options_.pixels.begin() + static_cast<std::ptrdiff_t>(last));
        RecordingOptions recorded;
        recorded.pixels = pixels;
        recorded.columns = columns_;
        recorded.budgetBytes = options_.budgetBytes / 2 / threads_;
        recorded.locations = options_.locations;
        recorded.observer = options_.observer;
        const auto replayed = replayPixels(renderer_, std::move(recorded), options_.settings, monitor);
        if (!replayed) return replayed.error();
        std::copy(replayed->values.begin(), replayed->values.end(), result_.values.begin() + static_cast<std::ptrdiff_t>(first));
        return evaluate(batch, first, pixels, *replayed, monitor);
    }

    Result<void> evaluate(std::size_t batch, std::size_t first, const std::vector<Pixel>& pixels, const ScanResult& replayed,
                          RequestMonitor& monitor) {
        const PathSet& paths = replayed.paths;
        query::EvaluationLimits limits;
        const auto deadline = std::chrono::steady_clock::now() + kLongestEvaluation;
        bool late = false;
        limits.cancelled = [&] {
            late = std::chrono::steady_clock::now() > deadline;
            return late || monitor.cancelled();
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
        add(replayed.stats);
        keeper_.add(batch, paths, matches->paths);
        ++doneBatches_;
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
    std::vector<std::uint32_t> matched_;
    std::vector<Color> sums_;

    std::mutex mutex_;  // guards the rest
    std::size_t doneBatches_ = 0;
    MatchKeeper keeper_;
    std::set<std::string> missing_;
    ScanResult result_;
    const std::vector<std::string> columns_;
};

}  // namespace

namespace {

/// Nothing if what was recorded did not fit: then it depends on the order of threads what is missing.
Result<std::optional<ScanResult>> tryOnThreads(Renderer& renderer, RecordingOptions recorded, const RenderSettings& settings, RequestMonitor& monitor,
                                               unsigned threads) {
    Recording recording(std::move(recorded));
    const std::vector<Pixel>& pixels = recording.options().pixels;
    ScanResult result;
    result.values.resize(pixels.size());
    const std::size_t batchSize = std::max(1u, kPathsPerBatch / std::max(1u, settings.samplesPerPixel));
    const auto replay = [&](std::size_t batch, RequestMonitor& part) -> Result<void> {
        const std::size_t first = batch * batchSize, last = std::min(first + batchSize, pixels.size());
        const std::vector<Pixel> some(pixels.begin() + static_cast<std::ptrdiff_t>(first), pixels.begin() + static_cast<std::ptrdiff_t>(last));
        const RecordScope scope(recording);
        const auto values = renderer.renderPixels(some, settings, recording, part);
        if (!values) return values.error();
        if (values->size() != some.size()) return wrongCount(values->size(), some.size());
        std::copy(values->begin(), values->end(), result.values.begin() + static_cast<std::ptrdiff_t>(first));
        return {};
    };
    if (auto done = runBatches({(pixels.size() + batchSize - 1) / batchSize, threads, replay}, monitor); !done) return done.error();
    auto paths = recording.finish();
    if (!paths) return paths.error();
    result.stats = recording.stats();
    if (result.stats.droppedByBudget > 0) return std::optional<ScanResult>();
    result.paths = std::move(paths).value();
    return std::optional(std::move(result));
}

}  // namespace

Result<ScanResult> replayPixels(Renderer& renderer, RecordingOptions recorded, const RenderSettings& settings, RequestMonitor& monitor,
                                unsigned threads) {
    if (threads > 1 && recorded.pixels.size() > 1) {
        auto done = tryOnThreads(renderer, recorded, settings, monitor, threads);
        if (!done) return done.error();
        if (*done) return std::move(**done);
    }
    Recording recording(std::move(recorded));
    const std::vector<Pixel>& pixels = recording.options().pixels;
    auto values = [&] {
        const RecordScope scope(recording);
        return renderer.renderPixels(pixels, settings, recording, monitor);
    }();
    if (!values) return values.error();
    if (values->size() != pixels.size()) return wrongCount(values->size(), pixels.size());
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
