#include "emca/doctor/image_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "emca/analysis/format.h"
#include "emca/analysis/image_metrics.h"
#include "emca/core/replay.h"
#include "words.h"

namespace emca::doctor {
namespace {

double relative(float a, float b) {
    if (std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || a == b || (std::isnan(a) && std::isnan(b))) return 0;
    if (!std::isfinite(a) || !std::isfinite(b)) return std::numeric_limits<double>::infinity();
    return std::abs(double(a) - double(b)) / std::max(std::abs(double(a)), std::abs(double(b)));
}

}  // namespace

double relativeDifference(Color a, Color b) { return std::max({relative(a.r, b.r), relative(a.g, b.g), relative(a.b, b.b)}); }

ImageDifference compareImages(const Image& a, const Image& b) {
    ImageDifference difference;
    difference.sameSize = a.width() == b.width() && a.height() == b.height() && a.channelCount() == b.channelCount();
    if (!difference.sameSize) return difference;
    difference.pixels = std::size_t(a.width()) * a.height();
    for (std::uint32_t y = 0; y < a.height(); ++y)
        for (std::uint32_t x = 0; x < a.width(); ++x) {
            const Color one = a.color({x, y}), other = b.color({x, y});
            if (compare(one, other) == Verdict::exact) continue;
            const double relative = relativeDifference(one, other);
            if (difference.different++ == 0 || relative > difference.largest) {
                difference.largest = relative;
                difference.worst = {x, y};
            }
        }
    return difference;
}

Finding checkImage(const Image& image) {
    Finding finding{.check = "image"};
    const auto faulty = analysis::faultyPixels(image, image.size());
    std::size_t counts[3] = {};
    for (const analysis::FaultyPixel& f : faulty) ++counts[static_cast<std::size_t>(f.fault)];
    finding.count("nan", counts[0]);
    finding.count("infinite", counts[1]);
    finding.count("negative", counts[2]);
    if (counts[0] + counts[1] > 0) {
        static constexpr const char* kWords[] = {"NaN", "infinite", "negative"};
        for (const analysis::FaultyPixel& f : faulty)
            if (f.fault != analysis::PixelFault::negative && finding.pixels.size() < 3) finding.pixels.push_back({f.pixel, kWords[static_cast<std::size_t>(f.fault)]});
        finding.complain(Outcome::warning, fmt::format("{} NaN, {} infinite, the first is {}.", counted(counts[0], "pixel is", "pixels are"), counts[1], analysis::formatPixel(finding.pixels.front().pixel)),
                         "Replay it: the path that did it is what EMCA is for.");
    }
    const float* const end = image.data() + image.size();
    if (std::all_of(image.data(), end, [](float f) { return f == 0; }))
        finding.complain(Outcome::warning, "Every pixel is black.", "Let the scene have a light, or look at whether the film is read before it is written.");
    return finding;
}

void checkRepeated(Finding& finding, const ImageDifference& difference, bool deterministic) {
    finding.count("pixels", difference.pixels);
    finding.count("differentPixels", difference.different);
    finding.add("largestDifference", difference.largest);
    if (difference.equal()) return;
    if (!difference.sameSize) {
        finding.complain(Outcome::failed, "A second image with the same settings has another size.", "The size that info() names must stay true.");
        return;
    }
    finding.pixels.insert(finding.pixels.begin(), {difference.worst, "differs between two renders"});
    finding.complain(deterministic ? Outcome::failed : Outcome::warning,
                     fmt::format("{} of {} differ between two renders with the same settings, by {} at most (relative), in {}{}.", difference.different, counted(difference.pixels, "pixel"),
                                 analysis::formatNumber(difference.largest), analysis::formatPixel(difference.worst), deterministic ? "" : "; the renderer says so itself"),
                     "Seed each sample by its pixel and index (SeedMap), never by thread, tile or time, and add up a pixel's samples in the order of their indices. Until then a replayed pixel is another one.");
}

}  // namespace emca::doctor
