#include <algorithm>
#include <cmath>

#include "checks.h"
#include "emca/analysis/format.h"
#include "emca/doctor/image_checks.h"
#include "emca/probe/light_probe.h"
#include "words.h"

namespace emca::doctor {
namespace {

/// Values that no layer can have: NaN says "no data" in means, and area of no size gives NaN densities; nothing is infinite.
std::size_t badValues(const SurfaceLayerData& layer) {
    const bool nanIsFine = layer.description.kind != LayerKind::sum;
    return static_cast<std::size_t>(std::count_if(layer.values.begin(), layer.values.end(), [&](float f) { return std::isinf(f) || (std::isnan(f) && !nanIsFine); }));
}

void checkField(const SurfaceField& field, Finding& finding) {
    const SurfaceCounts& counts = field.counts;
    finding.count("points", counts.points);
    finding.count("invalid", counts.invalid);
    finding.count("coarse", counts.coarse);
    finding.sentence += fmt::format(" {} on {}, {} of them invalid.", counted(counts.points, "point"), counted(field.faceCount(), "face"), counts.invalid);
    std::size_t empty = 0;
    for (const SurfaceLayerData& layer : field.layers) {
        finding.count("samples " + layer.description.name, layer.samples);
        empty += layer.samples == 0;
        if (layer.samples == 0) finding.sentence += fmt::format(" Nothing was added to \"{}\".", layer.description.name);  // as its event may not happen in a scene
        if (const std::size_t bad = badValues(layer); bad > 0 || !std::isfinite(layer.total))
            finding.complain(Outcome::failed, fmt::format("\"{}\" has {} that are infinite or NaN.", layer.description.name, counted(bad, "value")), "Look at the values that are added.");
    }
    finding.count("emptyLayers", empty);
    if (empty == field.layers.size()) finding.complain(Outcome::warning, "No layer has any value.", "Ask surface.find(name) for each layer's handle, locate() once per point and add() per layer, before renderImageWithLayers returns.");
    const std::uint64_t all = counts.points + counts.invalid;
    if (counts.invalid > 0 && counts.invalid * 100 > all)
        finding.complain(counts.invalid * 2 > all ? Outcome::failed : Outcome::warning, fmt::format("{} of {} points are on no face, or have values that are not finite.", counts.invalid, all),
                         "Mesh and face must be those of meshes(), as for setIntersectionSurface; positions in world space.");
}

}  // namespace

Finding checkLayers(Patient& patient) {
    if (!patient.info() || patient.info()->layers.empty()) return skipped("layers", "The renderer has no surface layers.");
    if (!patient.image()) return skipped("layers", "No image could be rendered.");
    client::RenderOptions options = patient.renderOptions();
    for (const LayerDescription& layer : patient.info()->layers) options.layers.push_back(layer.name);
    const auto render = patient.connection().render(options, patient.watch(0, 0.8));
    if (!render) return broken("layers", render.error());
    const auto field = patient.connection().surface(render->id, {}, patient.watch(0.8, 1));
    if (!field) return broken("layers", field.error());
    Finding finding{.check = "layers"};
    const ImageDifference difference = compareImages(patient.image()->image.color, render->image.color);
    finding.count("layers", options.layers.size());
    finding.count("differentPixels", difference.different);
    finding.add("seconds", render->seconds);
    finding.sentence = fmt::format("An image with all {} took {}{}.", counted(options.layers.size(), "layer"), analysis::formatDuration(render->seconds), difference.equal() ? " and has the same bits as without" : "");
    if (!difference.equal())
        finding.complain(patient.says("deterministic") ? Outcome::failed : Outcome::warning,
                         fmt::format("{} other than without layers, by {} at most (relative), in {}.", counted(difference.different, "pixel is", "pixels are"), analysis::formatNumber(difference.largest), analysis::formatPixel(difference.worst)),
                         "Collecting may draw no random number and change no order of sums: renderImageWithLayers is renderImage with one cursor per thread.");
    checkField(*field, finding);
    return finding;
}

Finding checkLightProbe(Patient& patient) {
    if (!patient.info()) return skipped("light-probe", "The renderer's info could not be had.");
    const auto& tools = patient.info()->tools;
    if (std::find(tools.begin(), tools.end(), probe::kLightProbeTool) == tools.end()) return skipped("light-probe", "The renderer has no light probe.");
    probe::LightProbeRequest request;
    request.width = 16;
    request.height = 8;
    request.samplesPerPixel = 4;
    const Result<Camera>& camera = patient.camera();
    if (camera) request.position = camera->position;  // nothing is nearer than what the camera sees
    const auto ask = [&]() -> Result<probe::LightProbe> {
        const auto bytes = patient.connection().askTool(probe::kLightProbeTool, probe::encode(request), patient.watch());
        if (!bytes) return bytes.error();
        return probe::decodeProbe(*bytes);
    };
    const auto begin = Clock::now();
    const auto first = ask();
    if (!first) return broken("light-probe", first.error());
    const double seconds = secondsSince(begin);
    const auto second = ask();
    if (!second) return broken("light-probe", second.error());
    Finding finding{.check = "light-probe"};
    const Image& image = first->image;
    const float* const end = image.data() + image.size();
    const bool same = image.size() == second->image.size() && std::equal(image.data(), end, second->image.data(), [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); });
    finding.add("seconds", seconds);
    finding.sentence = fmt::format("A probe of {} x {} directions at the camera took {}.", image.width(), image.height(), analysis::formatDuration(seconds));
    if (image.width() != request.width || image.height() != request.height) finding.complain(Outcome::failed, fmt::format("{} x {} were asked for.", request.width, request.height), "Answer with the size of the request.");
    if (std::any_of(image.data(), end, [](float f) { return !std::isfinite(f); })) finding.complain(Outcome::warning, "It has values that are not finite.", "Look at the radiance that comes back from rays of the probe.");
    if (std::any_of(image.data(), end, [](float f) { return f < 0; })) finding.complain(Outcome::warning, "It has negative values.", "Radiance and its error are not negative.");
    if (std::all_of(image.data(), end, [](float f) { return f == 0; })) finding.complain(Outcome::warning, "It is black.", "Does the camera stand inside of something? Else look at where its rays begin.");
    if (!same && patient.says("deterministic")) finding.complain(Outcome::failed, "The same request gives other bits.", "Seed by direction, sample and the request's seed, whatever the thread.");
    return finding;
}

}  // namespace emca::doctor
