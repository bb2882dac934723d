#include "image_stats.h"

#include <fmt/format.h>

#include <limits>

#include "command.h"
#include "csv.h"
#include "emca/analysis/format.h"
#include "emca/analysis/image_metrics.h"
#include "emca/imageio/imageio.h"
#include "json.h"
#include "table.h"

namespace emca::cli {
namespace {

using analysis::ChannelStatistics;
using analysis::FaultyPixel;
using analysis::formatFull;
using analysis::formatNumber;
using analysis::PixelFault;

constexpr std::size_t kShownFaults = 10;

struct ImageStats {
    std::string file;
    std::uint32_t width = 0, height = 0;
    PixelRect rect;                     ///< what the numbers are about; empty: the whole image
    std::vector<ChannelStatistics> channels;
    std::vector<FaultyPixel> faults;
};

const char* word(PixelFault fault) {
    return fault == PixelFault::nan ? "NaN" : fault == PixelFault::infinite ? "infinite" : "negative";
}

std::string statsText(const ImageStats& stats) {
    std::string text = fmt::format("{}: {} x {} pixels", printable(stats.file), stats.width, stats.height);
    if (const PixelRect r = stats.rect; !r.empty())
        text += fmt::format(", of them {} x {} at {}", r.x1 - r.x0, r.y1 - r.y0, analysis::formatPixel({r.x0, r.y0}));
    text += "\n\n";
    Table table({{"channel", Table::Align::left},
                 {"min"},
                 {"mean"},
                 {"median"},
                 {"max"},
                 {"deviation"},
                 {"variance"},
                 {"NaN"},
                 {"infinite"},
                 {"negative"}});
    for (const auto& [channel, s, negative, median] : stats.channels)
        table.add({channel, formatNumber(s.min), formatNumber(s.mean), formatNumber(median), formatNumber(s.max), formatNumber(s.deviation()),
                   formatNumber(s.variance), std::to_string(s.nan),
                   std::to_string(s.positiveInfinite + s.negativeInfinite), std::to_string(negative)});
    text += table.text();
    if (stats.faults.empty()) return text;
    text += fmt::format("\n{} faulty pixels:", stats.faults.size());
    for (std::size_t i = 0; i < std::min(stats.faults.size(), kShownFaults); ++i)
        text += fmt::format("{} {} {}", i > 0 ? "," : "", analysis::formatPixel(stats.faults[i].pixel),
                            word(stats.faults[i].fault));
    return text + (stats.faults.size() > kShownFaults ? ", …\n" : "\n");
}

Json statsJson(const ImageStats& stats) {
    Json out;
    out["image"] = stats.file;
    out["width"] = stats.width;
    out["height"] = stats.height;
    if (const PixelRect r = stats.rect; !r.empty()) out["rect"] = {r.x0, r.y0, r.x1, r.y1};
    out["channels"] = Json::array();
    for (const auto& [channel, s, negative, median] : stats.channels) {
        Json one;
        one["channel"] = channel;
        one["min"] = toJson(s.min);
        one["max"] = toJson(s.max);
        one["mean"] = toJson(s.mean);
        one["median"] = toJson(median);
        one["variance"] = toJson(s.variance);
        one["finite"] = s.finite;
        one["nan"] = s.nan;
        one["positiveInfinite"] = s.positiveInfinite;
        one["negativeInfinite"] = s.negativeInfinite;
        one["negative"] = negative;
        out["channels"].push_back(std::move(one));
    }
    out["faultyPixels"] = stats.faults.size();
    out["faults"] = Json::array();
    for (std::size_t i = 0; i < std::min(stats.faults.size(), kShownFaults); ++i) {
        Json one;
        one["pixel"] = toJson(stats.faults[i].pixel);
        one["fault"] = word(stats.faults[i].fault);
        out["faults"].push_back(std::move(one));
    }
    return out;
}

std::string statsCsv(const ImageStats& stats) {
    std::string text = csvLine({"channel", "min", "max", "mean", "variance", "finite", "nan", "positiveInfinite",
                                "negativeInfinite", "negative", "median"});
    for (const auto& [channel, s, negative, median] : stats.channels)
        text += csvLine({channel, formatFull(s.min), formatFull(s.max), formatFull(s.mean), formatFull(s.variance),
                         std::to_string(s.finite), std::to_string(s.nan), std::to_string(s.positiveInfinite),
                         std::to_string(s.negativeInfinite), std::to_string(negative), formatFull(median)});
    return text;
}

}  // namespace

int printImageStats(const std::string& file, PixelRect rect, StatsFormat format) {
    const Result<Image> image = imageio::read(file);
    if (!image) return fail(image.error());
    if (rect.x1 > image->width() || rect.y1 > image->height())
        return fail({ErrorCode::pixelOutOfRange,
                     fmt::format("--rect {},{},{},{} reaches beyond the image of {} x {} pixels.", rect.x0, rect.y0,
                                 rect.x1, rect.y1, image->width(), image->height())});
    ImageStats stats{file, image->width(), image->height(), rect, analysis::imageStatistics(*image, rect),
                     analysis::faultyPixels(*image, std::numeric_limits<std::size_t>::max())};
    if (!rect.empty())
        std::erase_if(stats.faults, [&](const FaultyPixel& fault) { return !rect.contains(fault.pixel); });
    fmt::print("{}", format == StatsFormat::json  ? dump(statsJson(stats))
                     : format == StatsFormat::csv ? statsCsv(stats)
                                                  : statsText(stats));
    return Exit::ok;
}

}  // namespace emca::cli
