#include "program/tour_story.h"

#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "emca/analysis/format.h"
#include "emca/analysis/path_quantities.h"

namespace emca::explorer {
namespace {

QString number(double value) { return toQString(analysis::formatNumber(value)); }

double largest(const Value& value) {
    double most = std::nan("");
    for (int i = 0; i < componentCount(typeOf(value)); ++i) most = std::fmax(most, component(value, static_cast<std::size_t>(i)));
    return most;
}

/// The renderer's throughput at a vertex, if it records one.
std::optional<double> throughput(const PathSet& paths, Index vertex) {
    for (const Column* column : paths.find(Scope::vertex, "throughput"))
        if (const auto value = paths.last(*column, vertex)) return largest(*value);
    return std::nullopt;
}

/// Whether the direction from a vertex was one of many: no mirror, no straight passage.
bool choseDirection(const PathSet& paths, Index vertex) {
    const auto scattering = paths.scattering(vertex);
    return !scattering || (scattering->lobe != Lobe::specular && scattering->lobe != Lobe::straight && scattering->event != Event::pass);
}

/// The contribution that dominates the path and the vertex that decided on it: for light that the walk hit, the last one
/// before it whose direction was a choice; for sampled light, the one that was connected with it.
bool findByContribution(const PathSet& paths, Suspect& suspect) {
    const IndexRange range = paths.vertices(suspect.path);
    float most = 0;
    for (Index v = range.first; v < range.last; ++v) {
        const IndexRange contributions = paths.contributions(v);
        for (Index i = contributions.first; i < contributions.last; ++i) {
            const float value = luminance(paths.contribution(i).value);
            if (value <= most) continue;
            most = value;
            suspect.light = Suspect::Light{i, v};
            suspect.vertex = v;
        }
    }
    if (!suspect.light) return false;
    if (paths.contribution(suspect.light->contribution).end != LightEnd::connected && *suspect.vertex > range.first) {
        Index v = *suspect.vertex - 1;
        while (v > range.first && !choseDirection(paths, v)) --v;
        suspect.vertex = v;
    }
    suspect.before = throughput(paths, *suspect.vertex);
    if (*suspect.vertex + 1 < range.last) suspect.after = throughput(paths, *suspect.vertex + 1);
    return true;
}

/// Without recorded contributions: the vertex after which the path carries so much more than before.
void findVertex(const PathSet& paths, Suspect& suspect) {
    const IndexRange range = paths.vertices(suspect.path);
    if (findByContribution(paths, suspect)) return;
    double jump = 0;
    std::optional<double> before;
    for (Index v = range.first; v < range.last; ++v) {
        const auto here = throughput(paths, v);
        if (here && before && *before > 0 && *here / *before > jump) {
            // The throughput that arrives here was multiplied by the scattering at the vertex before.
            jump = *here / *before;
            suspect.vertex = v - 1;
            suspect.before = before;
            suspect.after = here;
        }
        if (here) before = here;
    }
    if (!suspect.vertex && !range.empty()) suspect.vertex = range.last - 1;
}

QString eventWords(const PathSet& paths, Index vertex) {
    const auto scattering = paths.scattering(vertex);
    if (!scattering) return {};
    QStringList words;
    if (!scattering->label.empty()) words += QStringLiteral("“%1”").arg(toQString(scattering->label));
    if (scattering->lobe != Lobe::none) words += toQString(name(scattering->lobe));
    words += toQString(name(scattering->event));
    return words.join(' ');
}

QString dataLine(const PathSet& paths, Index vertex) {
    QStringList parts;
    for (const Column& column : paths.userColumns()) {
        if (column.scope != Scope::vertex || parts.size() >= 10) continue;
        if (const auto value = paths.last(column, vertex))
            parts += QStringLiteral("%1 %2").arg(toQString(column.name), toQString(analysis::formatValue(*value)));
    }
    return parts.join(QStringLiteral("; "));
}

}  // namespace

std::optional<Suspect> findSuspect(const PathSet& paths) {
    analysis::OutlierOptions options;
    options.upperOnly = true;
    auto report = analysis::detectOutliers(paths, options);
    if (!report) return std::nullopt;
    Suspect suspect;
    double most = -1, sum = 0;
    for (Index path = 0; path < paths.pathCount(); ++path) {
        const auto value = analysis::pathValue(paths, path, analysis::PathQuantity::luminance);
        if (!value) continue;
        // A NaN or infinite path is the first suspect whatever the others carry.
        const double rank = std::isfinite(*value) ? *value : HUGE_VAL;
        if (std::isfinite(*value)) sum += *value;
        if (rank <= most) continue;
        most = rank;
        suspect.path = path;
        suspect.luminance = *value;
    }
    if (most < 0) return std::nullopt;
    suspect.share = sum > 0 ? suspect.luminance / sum : 0;
    suspect.report = std::move(*report);
    findVertex(paths, suspect);
    return suspect;
}

std::optional<StrikingPixel> strikingPixel(const Image& image) {
    if (image.empty()) return std::nullopt;
    if (const auto found = analysis::findFireflies(image); !found.empty()) return StrikingPixel{found.front().pixel, found.front()};
    StrikingPixel brightest{{0, 0}, std::nullopt};
    float most = -1;
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            if (const float l = luminance(image.color({x, y})); l > most) {
                most = l;
                brightest.pixel = {x, y};
            }
    return brightest;
}

namespace {

QString pixelWords(const client::ImageEntry* entry, Pixel pixel) {
    if (!entry || !entry->image || !entry->image->color.contains(pixel)) return {};
    const Color value = entry->image->color.color(pixel);
    QString text = QStringLiteral("**The pixel.** %1 has the value %2, a luminance of %3 W/(sr m²)")
                       .arg(toQString(analysis::formatPixel(pixel)), toQString(analysis::formatColor(value)), number(double(luminance(value))));
    for (const analysis::Firefly& firefly : analysis::findFireflies(entry->image->color))
        if (firefly.pixel == pixel)
            text += QStringLiteral(", while the median of its neighbours is %1").arg(number(double(firefly.neighbours)));
    return text + QStringLiteral(".\n\n");
}

QString replayWords(const client::Trace& trace) {
    const Replay replay = trace.replays.empty() ? Replay{} : trace.replays.front();
    return QStringLiteral("**The replay.** The renderer traced this pixel again and recorded %1 paths with %2 vertices in %3 (renderer: %4). "
                          "Against the image the replay is *%5*.\n\n")
        .arg(trace.paths.pathCount()).arg(trace.paths.vertexCount())
        .arg(toQString(analysis::formatDuration(trace.totalSeconds)), toQString(analysis::formatDuration(trace.renderSeconds)), toQString(name(replay.verdict)));
}

QString outlierWords(const PathSet& paths, const Suspect& suspect) {
    return QStringLiteral("**The outliers.** The paths' luminance has the mean %1 and the standard deviation %2; %3 of %4 paths lie above "
                          "mean + 3 σ = %5. The strongest is sample %6 with %7: %8 % of the light of the whole pixel.\n\n")
        .arg(number(suspect.report.mean), number(suspect.report.deviation)).arg(suspect.report.outliers.size()).arg(paths.pathCount())
        .arg(number(suspect.report.upper)).arg(paths.sample(suspect.path)).arg(number(suspect.luminance), number(100 * suspect.share));
}

QString vertexWords(const PathSet& paths, const Suspect& suspect) {
    if (!suspect.vertex) return {};
    QString text = QStringLiteral("**The vertex.** At depth %1 of %2").arg(paths.depthIndex(*suspect.vertex)).arg(paths.depth(suspect.path));
    if (const QString event = eventWords(paths, *suspect.vertex); !event.isEmpty()) text += QStringLiteral(" (%1)").arg(event);
    if (suspect.light) {
        const Contribution& light = paths.contribution(suspect.light->contribution);
        text += QStringLiteral(" the path chose the direction of its light: %1 W/(sr m²) by “%2”%3, added at depth %4")
                    .arg(toQString(analysis::formatColor(light.value)), toQString(paths.text(light.technique)),
                         std::isnan(light.misWeight) ? QString() : QStringLiteral(" with the MIS weight %1").arg(number(double(light.misWeight))))
                    .arg(paths.depthIndex(suspect.light->vertex));
    } else if (suspect.before && suspect.after) {
        text += QStringLiteral(" the throughput goes from %1 to %2, a factor of %3")
                    .arg(number(*suspect.before), number(*suspect.after), number(*suspect.after / *suspect.before));
    } else {
        text += QStringLiteral(" the path ends");
    }
    text += QStringLiteral(".");
    if (const QString data = dataLine(paths, *suspect.vertex); !data.isEmpty()) text += QStringLiteral(" The renderer recorded there: %1.").arg(data);
    return text + QStringLiteral("\n\n");
}

}  // namespace

QString tourStory(const client::Dataset& dataset, Pixel pixel, const Suspect& suspect,
                  const std::vector<std::pair<QString, QString>>& pictures) {
    const PathSet& paths = dataset.paths();
    const client::Trace& trace = *dataset.current().front();
    QString text = QStringLiteral("# A tour: from a wrong pixel to the vertex that made it\n\n");
    if (dataset.info())
        text += QStringLiteral("Renderer %1, scene %2, %3 × %4 pixels, %5 samples per pixel.\n\n")
                    .arg(toQString(dataset.info()->renderer), toQString(dataset.info()->scene))
                    .arg(dataset.info()->width).arg(dataset.info()->height).arg(trace.samplesPerPixel);
    text += pixelWords(dataset.currentImage(), pixel) + replayWords(trace) + outlierWords(paths, suspect) + vertexWords(paths, suspect);
    for (const auto& [file, caption] : pictures) text += QStringLiteral("![%1](%2)\n\n*%1*\n\n").arg(caption, file);
    return text;
}

}  // namespace emca::explorer
