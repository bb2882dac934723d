// Replays pixels: what is traced, with which settings, against which image.
#include <algorithm>
#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "emca/recorder/recording.h"
#include "monitor.h"
#include "path_scan.h"
#include "service.h"
#include "verdict.h"

namespace emca {

namespace {

/// What the replay is compared with.
struct Reference {
    std::shared_ptr<const KeptImage> image;   ///< null if none
    protocol::Settings settings;              ///< complete; what is replayed
};

/// A trace takes what its client leaves open from the image that it is about, so that it replays just that image.
Reference referenceOf(const protocol::TraceRequest& request, const ImageStore& images, const protocol::Settings& scene) {
    Reference reference;
    if (request.against == protocol::Against::latestMatching) reference.image = images.latestMatching(request.settings);
    if (request.against == protocol::Against::renderId) reference.image = images.find(request.renderId);
    reference.settings = filled(request.settings, reference.image ? reference.image->settings : scene);
    // Asked with other settings than the image's: it would differ for that reason alone.
    if (reference.image && reference.image->settings != reference.settings) reference.image.reset();
    return reference;
}

/// Tells the tools what the recording threads do.
class ToolObserver final : public RecordingObserver {
  public:
    explicit ToolObserver(std::vector<std::shared_ptr<ServerTool>> tools) : tools_(std::move(tools)) {}
    void beginPath(Pixel pixel, std::int64_t sample) override { for (const auto& tool : tools_) tool->beginPath(pixel, sample); }
    void endPath(Pixel pixel, std::int64_t sample) override { for (const auto& tool : tools_) tool->endPath(pixel, sample); }
    void beginVertex(std::int32_t depth) override { for (const auto& tool : tools_) tool->beginVertex(depth); }
    void endVertex(std::int32_t depth) override { for (const auto& tool : tools_) tool->endVertex(depth); }

  private:
    std::vector<std::shared_ptr<ServerTool>> tools_;
};

bool recordsSums(const std::vector<std::string>& columns) {
    const auto has = [&](const char* name) { return std::find(columns.begin(), columns.end(), name) != columns.end(); };
    return columns.empty() || (has("estimate") && has("splat"));
}

std::string text(Pixel pixel) { return "(" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + ")"; }

}  // namespace

Result<std::vector<Pixel>> Service::pixelsOf(const protocol::TraceRequest& request) const {
    const std::uint64_t count = request.pixels.empty() ? request.rect.count() : request.pixels.size();
    if (count == 0) return Error{ErrorCode::invalidArgument, "No pixel was asked for: the list and the rectangle are empty."};
    // With a query the reply does not grow with the pixels.
    const std::uint64_t most = request.query.empty() ? options_.maximumPixelsPerTrace
                                                     : std::max<std::uint64_t>(options_.maximumPixelsPerTrace, std::uint64_t(info_.width) * info_.height);
    if (count > most) {
        return Error{ErrorCode::tooLarge, std::to_string(count) + " pixels were asked for at once, but this server allows at most " +
                                              std::to_string(options_.maximumPixelsPerTrace) + "."};
    }
    const auto outside = [&](Pixel pixel) {
        return Error{ErrorCode::pixelOutOfRange, "Pixel " + text(pixel) + " was asked for, but the image has " +
                                                     std::to_string(info_.width) + " x " + std::to_string(info_.height) + " pixels."};
    };
    if (!request.pixels.empty()) {
        for (const Pixel pixel : request.pixels) {
            if (pixel.x >= info_.width || pixel.y >= info_.height) return outside(pixel);
        }
        return request.pixels;
    }
    const PixelRect rect = request.rect;
    if (rect.x1 > info_.width || rect.y1 > info_.height) return outside({rect.x1 - 1, rect.y1 - 1});
    std::vector<Pixel> pixels;
    pixels.reserve(count);
    for (std::uint32_t y = rect.y0; y < rect.y1; ++y) {
        for (std::uint32_t x = rect.x0; x < rect.x1; ++x) pixels.push_back({x, y});
    }
    return pixels;
}

/// Replays all pixels into one recording.
Result<ScanResult> Service::replay(const std::shared_ptr<Request>& request, const ScanOptions& options) {
    RecordingOptions recorded;
    recorded.pixels = options.pixels;
    recorded.columns = options.columns;
    recorded.budgetBytes = options.budgetBytes;
    recorded.locations = options.locations;
    recorded.observer = options.observer;
    JobMonitor monitor(request, false, observers());
    return replayPixels(renderer_, std::move(recorded), options.settings, monitor, options.onePass ? 1 : options.threads);
}

/// Replays the pixels batch by batch, and keeps what the query finds.
Result<ScanResult> Service::scan(const std::shared_ptr<Request>& request, const std::string& text, const ScanOptions& options) {
    const auto query = query::Query::parse(text);
    if (!query) return query.error();
    JobMonitor monitor(request, false, observers());
    return scanPaths(renderer_, *query, options, monitor);
}

Service::Answer Service::answer(const std::shared_ptr<Request>& request, const protocol::TraceRequest& asked) {
    auto pixels = pixelsOf(asked);
    if (!pixels) return pixels.error();
    if (asked.against == protocol::Against::givenColors && asked.colors.size() != pixels->size()) {
        return Error{ErrorCode::invalidArgument, std::to_string(asked.colors.size()) + " colours were given to compare " +
                                                     std::to_string(pixels->size()) + " pixels with: give one for each."};
    }
    const Reference reference = referenceOf(asked, images_, sceneSettings());
    if (auto samples = checkSamples(reference.settings.samplesPerPixel); !samples) return samples.error();

    ToolObserver observer(observers());
    ScanOptions options;
    // A pixel that is asked for twice is replayed once: its paths would otherwise be recorded on top of each other.
    options.pixels = *pixels;
    std::sort(options.pixels.begin(), options.pixels.end());
    options.pixels.erase(std::unique(options.pixels.begin(), options.pixels.end()), options.pixels.end());
    options.settings = toRenderer(reference.settings);
    options.columns = asked.columns;
    options.keep = asked.keep;
    options.keepCount = asked.keepCount;
    options.budgetBytes = asked.budget == 0 ? options_.defaultBudget
                                            : std::min<std::uint64_t>(asked.budget, options_.maximumBudget);
    options.locations = asked.locations;
    options.onePass = info_.pathsReachAnyPixel;
    // Tools are told of one pixel at a time.
    if (!observers().empty()) options.observer = &observer;
    else if (info_.concurrent) options.threads = info_.threads ? info_.threads : std::max(1u, std::thread::hardware_concurrency());

    const auto begin = std::chrono::steady_clock::now();
    auto done = asked.query.empty() ? replay(request, options) : scan(request, asked.query, options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (!done) return done.error();
    if (request->cancelled) return Error{ErrorCode::cancelled, "The trace was cancelled."};

    protocol::TraceResult result;
    result.settings = reference.settings;
    result.renderId = reference.image ? reference.image->id : 0;
    result.stats = done->stats;
    result.renderSeconds = seconds.count();
    result.paths = std::move(done->paths);
    const std::vector<Pixel>& unique = options.pixels;
    const bool complete = recordsSums(asked.columns) && result.stats.droppedByBudget == 0 && done->complete;
    const auto sums = checkSums(result.paths, unique, reference.settings.samplesPerPixel, done->values, complete);
    std::vector<std::uint32_t> matched;
    std::vector<Color> matchedSums;
    for (std::size_t i = 0; i < pixels->size(); ++i) {
        const Pixel pixel = (*pixels)[i];
        const auto place = static_cast<std::size_t>(std::lower_bound(unique.begin(), unique.end(), pixel) - unique.begin());
        Replay replay;
        replay.replayed = done->values[place];
        replay.sums = sums[place];
        if (reference.image || asked.against == protocol::Against::givenColors) {
            replay.rendered = reference.image ? reference.image->image.color.color(pixel) : asked.colors[i];
            replay.verdict = compare(replay.rendered, replay.replayed);
        }
        result.replays.push_back(replay);
        if (asked.query.empty()) continue;
        matched.push_back(done->matches.matchedOfPixel[place]);
        matchedSums.push_back(done->matches.sumOfPixel[place]);
    }
    if (!asked.query.empty()) {
        done->matches.matchedOfPixel = std::move(matched);
        done->matches.sumOfPixel = std::move(matchedSums);
        result.matches = std::move(done->matches);
    }
    result.pixels = std::move(pixels).value();
    return last(std::move(result));
}

}  // namespace emca
