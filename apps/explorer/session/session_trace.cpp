// Traces and their history of SessionController.
#include <algorithm>

#include "base/qt_compat.h"
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

/// What of a selection exists in a trace.
client::Selection::State restricted(client::Selection::State state, const PathSet& paths) {
    const auto gone = [&](const client::PathId& id) { return !paths.findPath(id.pixel, id.sample, id.part); };
    state.paths.erase(std::remove_if(state.paths.begin(), state.paths.end(), gone), state.paths.end());
    if (state.currentPath && gone(*state.currentPath)) state.currentPath.reset();
    if (state.vertex) {
        const auto path = paths.findPath(state.vertex->path.pixel, state.vertex->path.sample, state.vertex->path.part);
        if (!path || !paths.findVertex(*path, state.vertex->depth, state.vertex->subpath)) state.vertex.reset();
    }
    return state;
}

}  // namespace

QString SessionController::obstacle(Pixel pixel) const {
    const QString at = toQString(analysis::formatPixel(pixel));
    if (!connection_ && dataset_.traces().empty()) return tr("Pixel %1 was not traced: no renderer is connected.").arg(at);
    if (!connection_) return tr("Pixel %1 was not traced before, and no renderer is connected that could do it now.").arg(at);
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image || !dataset_.info()) return {};
    const Image& image = entry->image->color;
    const client::ServerInfo& info = *dataset_.info();
    if (image.width() == info.width && image.height() == info.height) return {};
    return tr("“%1” is %2 × %3 pixels but the renderer's image is %4 × %5, so pixel %6 was not traced. "
              "Open an image of the renderer's size, or connect to the renderer that made this one.")
        .arg(toQString(entry->title)).arg(image.width()).arg(image.height()).arg(info.width).arg(info.height).arg(at);
}

client::TraceOptions SessionController::traceOptions(Pixel pixel) const {
    client::TraceOptions options;
    const client::ImageEntry* entry = dataset_.currentImage();
    if (!entry || !entry->image) return options;
    options.samplesPerPixel = samplesOf(*entry, pixel);
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
        options.colors = {entry->image->color.color(pixel)};
    }
    return options;
}

/// \param quietly  nobody clicked: an obstacle is no failure, and what is shown may stay
void SessionController::ensureTraced(bool quietly) {
    const auto pixel = selection_.state().pixel;
    if (!pixel) {
        cancelTrace();
        return;
    }
    const client::ImageEntry* entry = dataset_.currentImage();
    const RenderedImage* image = entry ? entry->image.get() : nullptr;
    if (entry && entry->preview && quietly) return;
    const auto found = std::find_if(known_.begin(), known_.end(),
                                    [&](const Known& k) { return k.pixel == *pixel && k.image == image; });
    if (found != known_.end()) {
        cancelTrace();
        present(found->trace, false);
        return;
    }
    if (!connection_) {
        // Of a session, or of a renderer that went away: better an answer of another image than none.
        if (auto stored = storedTrace(*pixel)) {
            cancelTrace();
            present(std::move(stored), false);
            return;
        }
    }
    if (quietly && !obstacle(*pixel).isEmpty()) return;
    trace(*pixel);
}

/// The reply that fits best: of the image in view, else the one that is shown, else the newest.
std::shared_ptr<const client::Trace> SessionController::storedTrace(Pixel pixel) const {
    const client::ImageEntry* entry = dataset_.currentImage();
    std::shared_ptr<const client::Trace> best;
    int bestRank = 0;
    for (const auto& trace : dataset_.traces()) {
        if (std::ranges::find(trace->pixels, pixel) == trace->pixels.end()) continue;
        const bool ofImage = entry && entry->renderId != 0 && trace->renderId == entry->renderId;
        const bool shown = std::ranges::find(dataset_.current(), trace) != dataset_.current().end();
        const int rank = 1 + 4 * ofImage + 2 * shown + (trace->pixels.size() == 1);
        if (rank <= bestRank) continue;
        best = trace;
        bestRank = rank;
    }
    return best;
}

void SessionController::traceAgain() {
    if (const auto pixel = selection_.state().pixel) trace(*pixel);
}

void SessionController::trace(Pixel pixel) {
    cancelTrace();
    if (const QString why = obstacle(pixel); !why.isEmpty()) {
        emit failed(FailedTask::trace, why);
        return;
    }
    auto activity = std::make_shared<Activity>();
    trace_ = activity;
    tracing_ = pixel;
    const client::ImageEntry* entry = dataset_.currentImage();
    begin();
    workers_.run(
        [connection = connection_, pixel, options = traceOptions(pixel), activity] {
            return connection->tracePixel(pixel, options, Activity::observer(activity));
        },
        [this, activity, image = entry ? entry->image : nullptr](Result<client::Trace> result) {
            if (activity == trace_) traced(activity, image, std::move(result));
        });
}

void SessionController::cancelTrace() {
    if (!trace_) return;
    *trace_->cancel = true;
    trace_.reset();
    tracing_.reset();
    emit activityChanged();
}

void SessionController::traced(std::shared_ptr<Activity> activity, std::shared_ptr<const RenderedImage> image,
                               Result<client::Trace> result) {
    trace_.reset();
    tracing_.reset();
    if (!result) {
        const ErrorCode code = result.error().code;
        if (code != ErrorCode::cancelled && code != ErrorCode::connectionLost) fail(FailedTask::trace, result.error());
        emit activityChanged();
        return;
    }
    auto trace = std::make_shared<const client::Trace>(std::move(*result));
    lastRequest_ = tr("pixel %1 in %2, renderer %3")
                       .arg(trace->pixels.empty() ? QString() : toQString(analysis::formatPixel(trace->pixels.front())),
                            toQString(analysis::formatDuration(double(activity->clock.nsecsElapsed()) * 1e-9)),
                            toQString(analysis::formatDuration(trace->renderSeconds)));
    if (!trace->pixels.empty()) {
        const Pixel pixel = trace->pixels.front();
        known_.erase(std::remove_if(known_.begin(), known_.end(),
                                    [&](const Known& k) { return k.pixel == pixel && k.image == image.get(); }),
                     known_.end());
        known_.push_front({pixel, image.get(), trace});
        if (known_.size() > client::Dataset::kHistory) known_.pop_back();
    }
    present(std::move(trace), true);
    emit traceFinished();
    emit activityChanged();
}

void SessionController::present(std::shared_ptr<const client::Trace> trace, bool fresh) {
    selection_.set(restricted(selection_.state(), trace->paths));
    if (fresh) {
        dataset_.addTrace(std::move(trace));
    } else if (dataset_.current().size() != 1 || dataset_.current().front() != trace) {
        dataset_.setCurrent({std::move(trace)});
    }
}

void SessionController::showTrace(std::shared_ptr<const client::Trace> trace) {
    if (!trace || trace->pixels.empty()) return;
    cancelTrace();
    const Pixel pixel = trace->pixels.front();
    // Selecting the pixel asks for the reply that belongs to the image in view; the person asked for this one.
    const bool known = selection_.state().pixel == pixel;
    if (!known) selection_.setPixel(pixel);
    cancelTrace();
    present(std::move(trace), false);
}

}  // namespace emca::explorer
