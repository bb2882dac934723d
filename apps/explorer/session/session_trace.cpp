// Traces and their history of SessionController.
#include <QScopedValueRollback>
#include <algorithm>

#include "base/qt_compat.h"
#include "base/grouped.h"
#include "emca/analysis/format.h"
#include "session/session_controller.h"

namespace emca::explorer {
namespace {

/// Files that we wrote say how many samples a pixel got.
std::uint32_t samplesOf(const client::ImageEntry& entry, Pixel pixel) {
    if (entry.samplesPerPixel) return entry.samplesPerPixel;
    const Image& color = entry.image->color;
    const int channel = color.channelIndex("samples");
    if (channel < 0 || !color.contains(pixel)) return 0;
    const float samples = color.at(pixel)[channel];
    return samples >= 1 && samples < 1e9f ? static_cast<std::uint32_t>(samples) : 0;
}

using Traces = std::vector<std::shared_ptr<const client::Trace>>;

/// What of a selection exists in traces.
client::Selection::State restricted(client::Selection::State state, const Traces& traces) {
    const auto gone = [&](const client::PathId& id) {
        return std::ranges::none_of(traces, [&](const auto& t) { return t->paths.findPath(id.pixel, id.sample, id.part).has_value(); });
    };
    const auto missing = [&](const client::VertexId& id) {
        return std::ranges::none_of(traces, [&](const auto& t) {
            const auto path = t->paths.findPath(id.path.pixel, id.path.sample, id.path.part);
            return path && t->paths.findVertex(*path, id.depth, id.subpath);
        });
    };
    std::erase_if(state.paths, gone);
    if (state.currentPath && gone(*state.currentPath)) state.currentPath.reset();
    if (state.vertex && missing(*state.vertex)) state.vertex.reset();
    return state;
}

/// "Pixel (3, 4)", "Region 8x8 at (12, 30)": the begin of a sentence.
QString capitalized(const client::PixelRegion& pixels) {
    QString text = toQString(pixels.text());
    if (!text.isEmpty()) text[0] = text[0].toUpper();
    return text;
}

}  // namespace

QString SessionController::obstacle(const client::PixelRegion& pixels) const {
    const QString what = capitalized(pixels);
    if (!connection_ && dataset_.traces().empty()) return tr("%1 was not traced: no renderer is connected.").arg(what);
    if (!connection_) return tr("%1 was not traced before, and no renderer is connected that could do it now.").arg(what);
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image || !dataset_.info()) return {};
    const Image& image = entry->image->color;
    const client::ServerInfo& info = *dataset_.info();
    if (image.width() != info.width || image.height() != info.height)
        return tr("“%1” is %2 × %3 pixels but the renderer's image is %4 × %5, so %6 was not traced. "
                  "Open an image of the renderer's size, or connect to the renderer that made this one.")
            .arg(toQString(entry->title)).arg(image.width()).arg(image.height()).arg(info.width).arg(info.height)
            .arg(toQString(pixels.text()));
    if (queryFor(pixels).empty() && info.maximumPixelsPerTrace > 0 && pixels.size() > info.maximumPixelsPerTrace)
        return tr("%1 was not traced: it has %2 pixels, and this renderer replays at most %3 at once. Choose a smaller region, or only "
                  "the paths that a filter takes.")
            .arg(what, grouped(pixels.size()), grouped(info.maximumPixelsPerTrace));
    return {};
}

client::TraceOptions SessionController::traceOptions(const client::PixelRegion& pixels) const {
    client::TraceOptions options;
    options.query = queryFor(pixels);
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image) return options;
    // One request has one number of samples. Where an image's pixels have different ones, the verdict tells.
    options.samplesPerPixel = samplesOf(*entry, pixels.pixels().front());
    if (!entry->integrator.empty() || !entry->sampler.empty()) {
        options.integrator = entry->integrator;
        options.sampler = entry->sampler;
        options.seed = entry->seed;
        options.hasSeed = true;
    }
    if (entry->preview) {
        options.against = client::VerdictAgainst::nothing;
    } else if (entry->renderId) {
        options.against = client::VerdictAgainst::renderId;
        options.renderId = entry->renderId;
    } else {
        options.against = client::VerdictAgainst::givenColors;
        for (const Pixel pixel : pixels.pixels()) options.colors.push_back(entry->image->color.color(pixel));
    }
    return options;
}

std::uint64_t SessionController::pathsOf(const client::PixelRegion& pixels) const {
    const client::ImageEntry* entry = dataset_.currentImage();
    std::uint64_t samples = entry && entry->image && !pixels.empty() ? samplesOf(*entry, pixels.pixels().front()) : 0;
    if (samples == 0 && dataset_.info()) samples = dataset_.info()->samplesPerPixel;
    return pixels.size() * std::max<std::uint64_t>(samples, 1);
}

/// \param quietly  nobody clicked: an obstacle is no failure, and what is shown may stay
void SessionController::ensureTraced(bool quietly) {
    const client::PixelRegion pixels = selection_.pixels();
    heldBack_ = 0;
    if (pixels.empty()) {
        cancelTrace();
        // Of pixels that were given up nothing is shown.
        if (!quietly) present({}, false);
        return;
    }
    const client::ImageEntry* entry = dataset_.currentImage();
    if (entry && entry->preview && quietly) return;
    if (auto known = knownTrace(pixels)) {
        cancelTrace();
        present({std::move(known)}, false);
        return;
    }
    // Of a session, or of a renderer that went away: better an answer of another image than none.
    if (!connection_ && showStored(pixels, quietly)) return;
    if (quietly && !obstacle(pixels).isEmpty()) return;
    if (const std::uint64_t paths = pathsOf(pixels); connection_ && pixels.size() > 1 && queryFor(pixels).empty() && paths > kUnaskedPaths) {
        cancelTrace();
        heldBack_ = paths;
        present({}, false);
        emit activityChanged();
        return;
    }
    trace(pixels);
}

std::shared_ptr<const client::Trace> SessionController::knownTrace(const client::PixelRegion& pixels) const {
    const client::ImageEntry* entry = dataset_.currentImage();
    const RenderedImage* image = entry ? entry->image.get() : nullptr;
    const std::string query = queryFor(pixels);
    const auto found = std::ranges::find_if(known_, [&](const Known& k) { return k.image == image && k.query == query && k.pixels == pixels; });
    return found == known_.end() ? nullptr : found->trace.lock();
}

/// The reply that fits best: of the image in view, else the one that is shown, else the newest.
/// \param exactly  of these pixels alone
std::shared_ptr<const client::Trace> SessionController::storedTrace(const client::PixelRegion& pixels, bool exactly) const {
    const client::ImageEntry* entry = dataset_.currentImage();
    std::shared_ptr<const client::Trace> best;
    int bestRank = 0;
    for (const auto& trace : dataset_.traces()) {
        if (exactly ? trace->pixels.size() != pixels.size() : pixels.size() != 1) continue;
        if (exactly && pixels.size() > 1 && client::PixelRegion(trace->pixels) != pixels) continue;
        if (pixels.size() == 1 && std::ranges::find(trace->pixels, pixels.pixels().front()) == trace->pixels.end()) continue;
        const bool ofImage = entry && entry->renderId != 0 && trace->renderId == entry->renderId;
        const bool shown = std::ranges::find(dataset_.current(), trace) != dataset_.current().end();
        const int rank = 1 + 4 * ofImage + 2 * shown + (trace->pixels.size() == 1);
        if (rank <= bestRank) continue;
        best = trace;
        bestRank = rank;
    }
    return best;
}

/// Without a renderer. A region that was never traced as such is put together of its pixels that were.
bool SessionController::showStored(const client::PixelRegion& pixels, bool quietly) {
    Traces found;
    std::uint64_t missing = 0;
    if (auto whole = storedTrace(pixels, pixels.size() > 1)) {
        found.push_back(std::move(whole));
    } else if (pixels.size() > 1) {
        const auto wanted = [&](const client::Trace& t) { return std::ranges::all_of(t.pixels, [&](Pixel p) { return pixels.contains(p); }); };
        std::vector<Pixel> covered;
        for (const auto& trace : dataset_.traces()) {
            if (!wanted(*trace)) continue;
            found.push_back(trace);
            covered.insert(covered.end(), trace->pixels.begin(), trace->pixels.end());
        }
        missing = pixels.size() - client::PixelRegion(std::move(covered)).size();
    }
    if (found.empty()) return false;
    cancelTrace();
    std::ranges::reverse(found);   // the newest wins where two hold the same path
    present(std::move(found), false);
    if (missing > 0 && !quietly)
        emit failed(FailedTask::trace, tr("%1 of %2 pixels were traced before and are shown; no renderer is connected that could trace the others.")
                                           .arg(grouped(pixels.size() - missing), grouped(pixels.size())));
    return true;
}

void SessionController::traceAgain() {
    if (const client::PixelRegion pixels = selection_.pixels(); !pixels.empty()) trace(pixels);
}

void SessionController::setRegionQuery(const std::string& query) {
    if (query == regionQuery_) return;
    regionQuery_ = query;
    if (selection_.state().region.empty() || showing_) return;
    ensureTraced(true);
}

void SessionController::trace(const client::PixelRegion& pixels) {
    cancelTrace();
    heldBack_ = 0;
    if (const QString why = obstacle(pixels); !why.isEmpty()) {
        emit failed(FailedTask::trace, why);
        return;
    }
    auto activity = std::make_shared<Activity>();
    trace_ = activity;
    tracing_ = pixels;
    const client::ImageEntry* entry = dataset_.currentImage();
    begin();
    workers_.run(
        [connection = connection_, pixels, options = traceOptions(pixels), activity] {
            const client::RequestObserver observer = Activity::observer(activity);
            if (pixels.isRectangle()) return connection->traceRect(pixels.bounds(), options, observer);
            return connection->tracePixels({pixels.pixels().begin(), pixels.pixels().end()}, options, observer);
        },
        [this, activity, image = entry ? entry->image : nullptr, pixels, query = queryFor(pixels)](Result<client::Trace> result) {
            if (activity == trace_) traced(activity, {pixels, image.get(), query, {}}, std::move(result));
        });
}

void SessionController::cancelTrace() {
    if (!trace_) return;
    *trace_->cancel = true;
    trace_.reset();
    tracing_ = {};
    emit activityChanged();
}

void SessionController::traced(std::shared_ptr<Activity> activity, Known asked, Result<client::Trace> result) {
    trace_.reset();
    tracing_ = {};
    if (!result) {
        const ErrorCode code = result.error().code;
        if (code != ErrorCode::cancelled && code != ErrorCode::connectionLost) fail(FailedTask::trace, result.error());
        emit activityChanged();
        return;
    }
    auto trace = std::make_shared<const client::Trace>(std::move(*result));
    lastRequest_ = tr("%1 in %2, renderer %3")
                       .arg(toQString(asked.pixels.text()), toQString(analysis::formatDuration(double(activity->clock.nsecsElapsed()) * 1e-9)),
                            toQString(analysis::formatDuration(trace->renderSeconds)));
    std::erase_if(known_, [&](const Known& k) {
        return k.trace.expired() || (k.image == asked.image && k.query == asked.query && k.pixels == asked.pixels);
    });
    asked.trace = trace;
    known_.push_front(std::move(asked));
    if (known_.size() > client::Dataset::kHistory) known_.pop_back();
    present({std::move(trace)}, true);
    emit traceFinished();
    emit activityChanged();
}

void SessionController::present(Traces traces, bool fresh) {
    selection_.set(restricted(selection_.state(), traces));
    if (fresh) dataset_.addTrace(std::move(traces.front()));
    else dataset_.setCurrent(std::move(traces));
}

void SessionController::showTrace(std::shared_ptr<const client::Trace> trace) {
    if (!trace || trace->pixels.empty()) return;
    cancelTrace();
    heldBack_ = 0;
    {
        // Selecting the pixels asks for the reply that belongs to the image in view; the person asked for this one.
        const QScopedValueRollback<bool> quiet(showing_, true);
        selection_.setRegion(client::PixelRegion(trace->pixels));
    }
    present({std::move(trace)}, false);
    emit activityChanged();
}

}  // namespace emca::explorer
