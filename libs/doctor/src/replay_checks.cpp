#include <algorithm>
#include <cmath>
#include <map>

#include "checks.h"
#include "emca/analysis/format.h"
#include "emca/core/replay.h"
#include "emca/doctor/image_checks.h"
#include "words.h"

namespace emca::doctor {
namespace {

using analysis::formatNumber;
using analysis::formatPixel;

/// What all checks of replayed pixels need: at least one that answered.
std::optional<Finding> nothingReplayed(const char* check, Patient& patient) {
    const Replays& replays = patient.replays();
    if (!replays.pixels.empty()) return std::nullopt;
    return skipped(check, "No pixel could be replayed.");
}

std::vector<Index> pathsOf(const PathSet& paths, Pixel pixel) {
    std::vector<Index> found;
    for (Index path = 0; path < paths.pathCount(); ++path)
        if (paths.pixel(path) == pixel) found.push_back(path);
    return found;
}

std::string shades(Color rendered, Color replayed) {
    return fmt::format("rendered {}, replayed {}", analysis::formatColor(rendered), analysis::formatColor(replayed));
}

void nameWorst(const Replays& replays, Finding& finding) {
    std::vector<const Replays::One*> worst;
    for (const Replays::One& one : replays.pixels)
        if (one.replay.verdict == Verdict::close || one.replay.verdict == Verdict::different) worst.push_back(&one);
    const auto deviation = [](const Replays::One* one) { return relativeDifference(one->replay.rendered, one->replay.replayed); };
    std::stable_sort(worst.begin(), worst.end(), [&](const auto* a, const auto* b) { return deviation(a) > deviation(b); });
    finding.add("largestDeviation", worst.empty() ? 0.0 : deviation(worst.front()));
    if (worst.size() > 5) worst.resize(5);
    for (const Replays::One* one : worst) finding.pixels.push_back({one->pixel, shades(one->replay.rendered, one->replay.replayed)});
}

}  // namespace

Finding checkReplay(Patient& patient) {
    if (!patient.info()) return skipped("replay", "The renderer's info could not be had.");
    const Replays& replays = patient.replays();
    if (replays.pixels.empty() && replays.error) {
        Finding finding = broken("replay", *replays.error);
        finding.pixels.push_back({replays.failedPixel, "could not be replayed"});
        return finding;
    }
    Finding finding{.check = "replay"};
    std::vector<Replay> all;
    for (const Replays::One& one : replays.pixels) all.push_back(one.replay);
    const ReplayCounts counts = countReplays(all);
    finding.count("pixels", counts.pixels);
    finding.count("exact", counts.exact);
    finding.count("close", counts.close);
    finding.count("different", counts.different);
    finding.count("unknown", counts.unknown);
    finding.count("failures", replays.failures);
    nameWorst(replays, finding);
    finding.sentence = fmt::format("{} of {} exactly, {} spp", counts.exact, counted(counts.pixels, "random pixel is replayed", "random pixels are replayed"), patient.samples());
    if (counts.close + counts.different > 0) {
        const Value* largest = finding.find("largestDeviation");
        finding.sentence += fmt::format("; {} close (1e-4), {} different, by {} at most (relative)", counts.close, counts.different, formatNumber(std::get<double>(*largest)));
    }
    finding.sentence += '.';
    if (counts.different > 0)
        finding.complain(Outcome::failed, "What one would look at is not what was rendered.",
                         "Let renderPixel run the code of renderImage: same seed for each (pixel, sample), same order of sums, same film. The seed must not depend on tile, thread or earlier pixels.");
    else if (counts.close > 0)
        finding.complain(Outcome::warning, "The paths are the same, their sum is rounded otherwise.",
                         "Add a pixel's samples in the order of their indices, in the same type, and divide as the film does; one compiled function for both.");
    if (counts.unknown > 0)
        finding.complain(Outcome::warning, fmt::format("{} could not be compared with the image.", counted(counts.unknown, "pixel")), "Could the image be rendered? See the check image.");
    if (replays.failures > 0) {
        finding.complain(Outcome::failed, fmt::format("{} could not be replayed; the first, {}: {}", counted(replays.failures, "pixel"), formatPixel(replays.failedPixel), replays.error->message), adviceFor(replays.error->code));
        finding.pixels.push_back({replays.failedPixel, "could not be replayed"});
    }
    return finding;
}

Finding checkSums(Patient& patient) {
    if (auto nothing = nothingReplayed("sums", patient)) return *nothing;
    const Replays& replays = patient.replays();
    Finding finding{.check = "sums"};
    std::size_t matches = 0, differ = 0, unknown = 0;
    for (const Replays::One& one : replays.pixels) {
        matches += one.replay.sums == SumCheck::matches;
        unknown += one.replay.sums == SumCheck::unknown;
        if (one.replay.sums != SumCheck::differs) continue;
        if (++differ <= 5) finding.pixels.push_back({one.pixel, fmt::format("replayed {}", analysis::formatColor(one.replay.replayed))});
    }
    finding.count("matches", matches);
    finding.count("differ", differ);
    finding.count("unknown", unknown);
    finding.sentence = fmt::format("Recorded estimates and splats add up to {} of {}.", matches, counted(replays.pixels.size(), "pixel"));
    if (differ > 0)
        finding.complain(Outcome::failed, fmt::format("In {} they do not (beyond 1e-3).", counted(differ, "pixel")),
                         "setFinalEstimate takes the path's whole value as the film gets it, before division by samples per pixel; light that paths add elsewhere goes to addSplat. A pixel is the mean of its own samples: reconstruction filters by importance sampling.");
    if (unknown > 0 && !replays.paths.hasEstimates() && !replays.paths.hasSplats())
        finding.complain(Outcome::warning, "No path has a final estimate.", "Call setFinalEstimate at the end of each path: plots, outliers and queries live on it.");
    else if (unknown > 0 && unknown < replays.pixels.size())
        finding.complain(Outcome::warning, fmt::format("Of {} that is not known.", counted(unknown, "pixel")), "Record a final estimate for each path, also for black ones.");
    else if (unknown > 0)
        finding.complain(Outcome::warning, "That is not known: not everything was recorded.", "");
    return finding;
}

Finding checkPaths(Patient& patient) {
    if (auto nothing = nothingReplayed("paths", patient)) return *nothing;
    return patient.replays().paths.finding();
}

Finding checkValues(Patient& patient) {
    if (auto nothing = nothingReplayed("values", patient)) return *nothing;
    return patient.replays().values.finding();
}

Finding checkSurfaces(Patient& patient) {
    if (auto nothing = nothingReplayed("surfaces", patient)) return *nothing;
    const auto& surfaces = patient.replays().surfaces;
    return surfaces ? surfaces->finding() : skipped("surfaces", "The meshes could not be had.");
}

Finding checkCameraRays(Patient& patient) {
    if (auto nothing = nothingReplayed("camera-rays", patient)) return *nothing;
    const auto& rays = patient.replays().rays;
    return rays ? rays->finding() : skipped("camera-rays", "The camera could not be had.");
}

/// Pixels in one request as pixels one by one.
Finding checkPixelList(Patient& patient) {
    if (auto nothing = nothingReplayed("pixel-list", patient)) return *nothing;
    const Replays& replays = patient.replays();
    std::vector<Pixel> pixels;
    for (const Replays::One& one : replays.pixels)
        if (pixels.size() < 16) pixels.push_back(one.pixel);
    const auto list = patient.connection().tracePixels(pixels, patient.traceOptions(), patient.watch());
    if (!list) return broken("pixel-list", list.error());
    Finding finding{.check = "pixel-list"};
    finding.count("pixels", pixels.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        std::string why;
        const Color once = replays.pixels[i].replay.replayed, inList = list->replays[i].replayed;
        if (compare(once, inList) != Verdict::exact) why = fmt::format("alone {}, in a list {}", analysis::formatColor(once), analysis::formatColor(inList));
        // Where paths may hit any pixel, a list has paths that one pixel alone has not.
        const bool whole = list->stats.droppedByBudget == 0 && !replays.paths.hasSplats() && i < replays.kept.size();
        if (why.empty() && whole) why = differenceOf(replays.kept[i].paths, list->paths.subset(pathsOf(list->paths, pixels[i])));
        if (why.empty()) continue;
        if (++different <= 5) finding.pixels.push_back({pixels[i], why});
    }
    finding.count("different", different);
    finding.sentence = fmt::format("{} of {} the same in a list as alone.", pixels.size() - different, counted(pixels.size(), "pixel is", "pixels are"));
    if (different > 0)
        finding.complain(Outcome::failed, fmt::format("{}: {}.", formatPixel(finding.pixels.front().pixel), finding.pixels.front().why),
                         "Nothing may be left from pixel to pixel: samplers, caches and random numbers begin anew with each.");
    return finding;
}

/// A path as it is among fewer samples.
Finding checkSamples(Patient& patient) {
    if (auto nothing = nothingReplayed("samples", patient)) return *nothing;
    const Replays& replays = patient.replays();
    if (!replays.paths.hasEstimates()) return skipped("samples", "Without final estimates, paths cannot be compared.");
    const std::uint32_t all = patient.samples(), fewer = all % 4 == 0 ? all / 4 : all / 2;  // of 16, both are squares
    if (fewer == 0) return skipped("samples", "One sample per pixel has no part: give more with --spp.");
    std::vector<Pixel> pixels;
    for (const client::Trace& trace : replays.kept) pixels.push_back(trace.pixels.front());
    client::TraceOptions options = patient.traceOptions();
    options.samplesPerPixel = fewer;
    const auto part = patient.connection().tracePixels(pixels, options, patient.watch());
    if (!part) return broken("samples", part.error());
    std::size_t compared = 0, changed = 0;
    Finding finding{.check = "samples"};
    for (const client::Trace& whole : replays.kept) {
        const Pixel pixel = whole.pixels.front();
        bool same = true;
        for (const Index path : pathsOf(part->paths, pixel)) {
            const auto other = whole.paths.findPath(pixel, part->paths.sample(path), part->paths.part(path));
            const auto one = part->paths.estimate(path), two = other ? whole.paths.estimate(*other) : std::nullopt;
            if (!one) continue;
            ++compared;
            if (two && compare(*one, *two) == Verdict::exact) continue;
            ++changed;
            same = false;
        }
        if (!same && finding.pixels.size() < 3) finding.pixels.push_back({pixel, fmt::format("other paths with {} than with {} spp", fewer, all)});
    }
    finding.count("paths", compared);
    finding.count("changed", changed);
    finding.count("spp", all);
    finding.count("fewerSpp", fewer);
    if (compared == 0) return skipped("samples", fmt::format("With {} spp no path has a final estimate.", fewer));
    finding.sentence = changed == 0 ? fmt::format("{} the same with {} as with {} spp.", counted(compared, "path is", "paths are"), fewer, all)
                                    : fmt::format("{} of {} another one with {} than with {} spp.", changed, counted(compared, "path is", "paths are"), fewer, all);
    if (changed > 0)
        finding.complain(Outcome::warning, "More samples do not refine an image, they make another one.",
                         "Seed by (pixel, sample), not by pixel times samples per pixel: then a path keeps its index whatever --spp is. Samplers that stratify by the number of samples cannot, and that is all right.");
    return finding;
}

}  // namespace emca::doctor
