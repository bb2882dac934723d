#include <algorithm>

#include "checks.h"
#include "emca/analysis/format.h"
#include "median.h"
#include "words.h"

namespace emca::doctor {
namespace {

using analysis::formatDuration;

/// Replays with every value recorded and with final estimates alone, in turns, so that a busy machine spoils both alike.
struct ReplayTimes {
    std::vector<double> everything, estimates;
    std::optional<Error> error;

    void measure(Patient& patient, const std::vector<Pixel>& pixels) {
        client::TraceOptions all = patient.traceOptions(), few = all;
        few.columns = {"estimate"};
        const auto begin = Clock::now();
        for (int turn = 0; turn < 7 && (turn < 3 || secondsSince(begin) < 5); ++turn)
            for (const bool full : {turn % 2 == 0, turn % 2 != 0}) {
                const auto trace = patient.connection().tracePixels(pixels, full ? all : few, patient.watch(turn / 7.0, (turn + 1) / 7.0));
                if (!trace) return void(error = trace.error());
                (full ? everything : estimates).push_back(trace->renderSeconds);
            }
    }
};

}  // namespace

Finding checkOverhead(Patient& patient) {
    const Replays& replays = patient.replays();
    if (replays.pixels.empty() || !patient.image()) return skipped("overhead", "No pixel could be replayed.");
    while (patient.imageSeconds.size() < 3 && patient.imageSeconds.front() < 10) {
        const auto render = patient.connection().render(patient.renderOptions(), patient.watch());
        if (!render) return broken("overhead", render.error());
        patient.imageSeconds.push_back(render->seconds);
    }
    std::vector<Pixel> pixels;
    for (const Replays::One& one : replays.pixels)
        if (pixels.size() < 16) pixels.push_back(one.pixel);
    ReplayTimes times;
    times.measure(patient, pixels);
    if (times.error) return broken("overhead", *times.error);

    const double image = medianOf(patient.imageSeconds), imagePixels = double(patient.info()->width) * patient.info()->height;
    const double perSample = 1 / double(patient.samples());
    const double rendering = image / imagePixels * perSample;
    const double recording = medianOf(times.everything) / double(pixels.size()) * perSample, estimates = medianOf(times.estimates) / double(pixels.size()) * perSample;
    Finding finding{.check = "overhead"};
    finding.add("imageSeconds", image);
    finding.count("images", patient.imageSeconds.size());
    finding.add("imageSecondsPerSample", rendering);
    finding.add("replaySecondsPerSample", recording);
    finding.add("replayEstimatesSecondsPerSample", estimates);
    finding.add("recordingFactor", recording / std::max(estimates, 1e-12));
    finding.count("pixels", pixels.size());
    finding.sentence = fmt::format("The image takes {} (median of {}), {} a sample on all its threads; a replayed pixel {} a sample with everything recorded, {} with final estimates alone (x {}).", formatDuration(image),
                                   patient.imageSeconds.size(), formatDuration(rendering), formatDuration(recording), formatDuration(estimates), analysis::formatNumber(recording / std::max(estimates, 1e-12)));
    const double pixel = recording * patient.samples();
    if (pixel > image && pixel > 0.02 && imagePixels >= 256 && !replays.paths.hasSplats())
        finding.complain(Outcome::warning, fmt::format("One pixel takes {}, longer than the whole image.", formatDuration(pixel)), "Does renderPixel render more than the pixel, or load the scene again?");
    else if (recording > 20 * estimates && recording * imagePixels > 20 * image / perSample)
        finding.complain(Outcome::warning, "Recording costs much more than rendering.", "Record costly values by a callable, and keys as constants; is a string built for each value?");
    return finding;
}

}  // namespace emca::doctor
