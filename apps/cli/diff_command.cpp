// `emca diff`: how an image differs from another one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "arguments.h"
#include "commands.h"
#include "emca/analysis/flip.h"
#include "emca/analysis/format.h"
#include "emca/analysis/image_metrics.h"
#include "emca/imageio/imageio.h"
#include "json.h"
#include "table.h"

namespace emca::cli {
namespace {

using analysis::ChannelStatistics;
using analysis::formatNumber;
using analysis::ImageMetric;

struct DiffArguments {
    std::string image, reference, metric = "abs", output, limit;
    bool json = false;
};

struct NamedMetric {
    const char* name;
    ImageMetric metric;
};
constexpr std::array<NamedMetric, 8> kMetrics{{{"error", ImageMetric::error},
                                               {"abs", ImageMetric::absoluteError},
                                               {"sq", ImageMetric::squaredError},
                                               {"rel", ImageMetric::relativeAbsoluteError},
                                               {"relsq", ImageMetric::relativeSquaredError},
                                               {"smape", ImageMetric::symmetricAbsoluteError},
                                               {"ldr-flip", ImageMetric::ldrFlip},
                                               {"hdr-flip", ImageMetric::hdrFlip}}};

/// Whether a file holds radiance rather than what a screen shows, which decides between the two forms of FLIP.
bool holdsRadiance(const std::string& file) {
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".exr" || extension == ".pfm" || extension == ".hdr";
}

std::optional<ImageMetric> parseMetric(const DiffArguments& arguments) {
    if (arguments.metric == "flip")
        return holdsRadiance(arguments.image) && holdsRadiance(arguments.reference) ? ImageMetric::hdrFlip
                                                                                    : ImageMetric::ldrFlip;
    for (const NamedMetric& named : kMetrics)
        if (arguments.metric == named.name) return named.metric;
    return std::nullopt;
}

struct Difference {
    ImageMetric metric;
    Image image;
    std::vector<ChannelStatistics> channels;  // of the metric
    std::size_t incomparable = 0;             // pixels with a channel that is NaN or infinite in the difference
    std::optional<analysis::FlipExposures> exposures;
    std::optional<double> limit;

    double mean() const { return analysis::meanOf(image); }
    /// What a limit is compared with: the mean of the channel that differs most.
    double largestMean() const {
        double largest = 0;
        for (const ChannelStatistics& channel : channels) largest = std::max(largest, std::abs(channel.summary.mean));
        return largest;
    }
    bool fails() const { return limit && (largestMean() > *limit || incomparable > 0); }
};

Result<Difference> compare(const DiffArguments& arguments, ImageMetric metric) {
    const Result<Image> image = imageio::read(arguments.image);
    if (!image) return image.error();
    const Result<Image> reference = imageio::read(arguments.reference);
    if (!reference) return reference.error();
    auto difference = analysis::differenceImage(*image, *reference, metric);
    if (!difference) return difference.error();
    Difference out{metric, std::move(difference).value(), {}};
    out.channels = analysis::imageStatistics(out.image);
    if (out.channels.back().channel == "luminance" && out.channels.size() > out.image.channelCount())
        out.channels.pop_back();
    if (metric == ImageMetric::hdrFlip) out.exposures = analysis::automaticExposures(*reference);
    const std::uint32_t channels = out.image.channelCount();
    for (std::size_t i = 0; i < out.image.size(); i += channels)
        out.incomparable += std::any_of(out.image.data() + i, out.image.data() + i + channels,
                                        [](float v) { return !std::isfinite(v); });
    return out;
}

std::string diffText(const DiffArguments& arguments, const Difference& difference) {
    std::string text = fmt::format("{} of {} against {}, {} x {} pixels", analysis::name(difference.metric),
                                   printable(arguments.image), printable(arguments.reference), difference.image.width(),
                                   difference.image.height());
    if (difference.exposures)
        text += fmt::format(", {} exposures from {:+.2f} to {:+.2f} stops", difference.exposures->count,
                            difference.exposures->start, difference.exposures->stop);
    Table table({{"channel", Table::Align::left}, {"mean"}, {"min"}, {"max"}, {"deviation"}});
    for (const ChannelStatistics& c : difference.channels)
        table.add({c.channel, formatNumber(c.summary.mean), formatNumber(c.summary.min), formatNumber(c.summary.max),
                   formatNumber(c.summary.deviation())});
    text += "\n\n" + table.text();
    if (difference.incomparable > 0)
        text += fmt::format("\n{} pixels cannot be compared: NaN or infinite in one image only.\n",
                            difference.incomparable);
    if (difference.limit)
        text += fmt::format(
            "\n{}: {} is {} the limit of {}{}\n", difference.fails() ? "failed" : "ok",
            formatNumber(difference.largestMean()), difference.largestMean() > *difference.limit ? "above" : "within",
            formatNumber(*difference.limit), difference.incomparable > 0 ? ", but not all pixels can be compared" : "");
    return text;
}

Json diffJson(const DiffArguments& arguments, const Difference& difference) {
    Json out;
    out["image"] = arguments.image;
    out["reference"] = arguments.reference;
    out["metric"] = analysis::name(difference.metric);
    out["width"] = difference.image.width();
    out["height"] = difference.image.height();
    out["mean"] = toJson(difference.mean());
    out["channels"] = Json::array();
    for (const ChannelStatistics& c : difference.channels) {
        Json one;
        one["channel"] = c.channel;
        one["mean"] = toJson(c.summary.mean);
        one["min"] = toJson(c.summary.min);
        one["max"] = toJson(c.summary.max);
        one["variance"] = toJson(c.summary.variance);
        out["channels"].push_back(std::move(one));
    }
    out["incomparable"] = difference.incomparable;
    if (difference.exposures) {
        out["exposures"]["start"] = toJson(difference.exposures->start);
        out["exposures"]["stop"] = toJson(difference.exposures->stop);
        out["exposures"]["count"] = difference.exposures->count;
    }
    if (difference.limit) {
        out["limit"] = toJson(*difference.limit);
        out["fails"] = difference.fails();
    }
    out["output"] = arguments.output.empty() ? Json(nullptr) : Json(arguments.output);
    return out;
}

int runDiff(const DiffArguments& arguments) {
    const std::optional<ImageMetric> metric = parseMetric(arguments);
    if (!metric)
        return failUsage(
            fmt::format("--metric is \"{}\"; it must be error, abs, sq, rel, relsq, smape, flip, ldr-flip or hdr-flip.",
                        arguments.metric));
    std::optional<double> limit;
    if (!arguments.limit.empty()) {
        const auto parsed = parseReal("--fail-above", arguments.limit, 0, 1e300);
        if (!parsed) return failUsage(parsed.error().message);
        limit = *parsed;
    }
    if (!arguments.output.empty())
        if (const auto writable = imageio::checkWritable(arguments.output); !writable) return fail(writable.error());
    Result<Difference> difference = compare(arguments, *metric);
    if (!difference) return fail(difference.error());
    difference->limit = limit;
    if (!arguments.output.empty())
        if (const auto written = imageio::write(arguments.output, difference->image); !written)
            return fail(written.error());
    fmt::print("{}", arguments.json ? dump(diffJson(arguments, *difference)) : diffText(arguments, *difference));
    return difference->fails() ? Exit::assertionFalse : Exit::ok;
}

}  // namespace

void addDiffCommand(CLI::App& app, Run& run) {
    const auto arguments = std::make_shared<DiffArguments>();
    CLI::App* command = app.add_subcommand("diff", "How an image differs from a reference, per pixel and on average");
    command->add_option("image", arguments->image, "the image to judge")->required()->type_name("A");
    command->add_option("reference", arguments->reference, "what it should be")->required()->type_name("B");
    command
        ->add_option("--metric", arguments->metric,
                     "error, abs (default), sq, rel, relsq, smape, flip, ldr-flip or hdr-flip")
        ->type_name("METRIC");
    command->add_option("-o,--output", arguments->output, "write the difference of each pixel")->type_name("OUT.exr");
    command
        ->add_option("--fail-above", arguments->limit,
                     "end with 1 if the mean of a channel is above, or a pixel cannot be compared")
        ->type_name("X");
    command->add_flag("--json", arguments->json, "for scripts");
    command->footer(
        "Examples:\n  emca diff new.exr old.exr --metric flip -o flip.exr\n  emca diff new.exr old.exr --metric relsq "
        "--fail-above 0.01");
    command->callback([arguments, &run] { run = [arguments] { return runDiff(*arguments); }; });
}

}  // namespace emca::cli
