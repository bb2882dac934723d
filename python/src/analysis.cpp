// What views compute, as numbers: the same functions as in the explorer and on the command line.
#include <string>

#include "arrays.h"
#include "bindings.h"
#include "emca/analysis/firefly.h"
#include "emca/analysis/flip.h"
#include "emca/analysis/image_metrics.h"
#include "emca/analysis/outliers.h"
#include "emca/analysis/statistics.h"
#include "errors.h"
#include "images.h"
#include "unlocked.h"

namespace emca::python {
namespace {

using namespace analysis;

PathQuantity toQuantity(const std::string& name) {
    constexpr const char* kNames[] = {"sample", "luminance", "red", "green", "blue", "depth", "vertex count"};
    for (std::size_t i = 0; i < std::size(kNames); ++i)
        if (name == kNames[i]) return static_cast<PathQuantity>(i);
    throw py::value_error("there is no quantity \"" + name +
                          "\": choose sample, luminance, red, green, blue, depth or vertex count");
}

py::dict toDict(OutlierReport report) {
    py::list steps;
    for (const EsdStep& step : report.steps)
        steps.append(py::make_tuple(step.index, step.value, step.mean, step.deviation, step.statistic, step.critical));
    py::dict out;
    out["maximum_reached"] = report.maximumReached();
    out["indices"] = moved(std::move(report.outliers), Number::uint32);
    out["considered"] = report.considered;
    out["not_finite"] = report.notFinite;
    out["without_value"] = report.withoutValue;
    out["mean"] = report.mean;
    out["deviation"] = report.deviation;
    out["lower"] = report.lower;
    out["upper"] = report.upper;
    out["steps"] = steps;
    return out;
}

OutlierOptions outlierOptions(bool esd, double deviations, bool upperOnly, std::size_t maximum, double significance) {
    return {.method = esd ? OutlierMethod::generalizedEsd : OutlierMethod::meanDeviation,
            .deviations = deviations,
            .upperOnly = upperOnly,
            .maximum = maximum,
            .significance = significance};
}

OutlierOptions outlierOptions(const std::string& quantity, bool esd, double deviations, bool upperOnly,
                              std::size_t maximum, double significance) {
    OutlierOptions options = outlierOptions(esd, deviations, upperOnly, maximum, significance);
    options.quantity = toQuantity(quantity);
    return options;
}

py::dict pathOutliers(const PathSet& paths, const std::string& quantity, bool esd, double deviations, bool upperOnly,
                      std::size_t maximum, double significance) {
    const OutlierOptions options = outlierOptions(quantity, esd, deviations, upperOnly, maximum, significance);
    return toDict(unwrap(unlocked([&] { return detectOutliers(paths, options); })));
}

py::list pathOutliersPerPixel(const PathSet& paths, const std::string& quantity, bool esd, double deviations, bool upperOnly,
                              std::size_t maximum, double significance) {
    const OutlierOptions options = outlierOptions(quantity, esd, deviations, upperOnly, maximum, significance);
    py::list out;
    for (PixelOutliers& one : unwrap(unlocked([&] { return detectOutliersPerPixel(paths, options); })))
        out.append(py::make_tuple(py::make_tuple(one.pixel.x, one.pixel.y), toDict(std::move(one.report))));
    return out;
}

py::dict valueOutliers(py::handle given, bool esd, double deviations, bool upperOnly, std::size_t maximum,
                       double significance) {
    const OutlierOptions options = outlierOptions(esd, deviations, upperOnly, maximum, significance);
    const std::vector<double> values = toDoubles(given);
    return toDict(unwrap(unlocked([&] { return detectOutliers(values, options); })));
}

py::dict toDict(const Summary& summary) {
    py::dict out;
    out["count"] = summary.count;
    out["finite"] = summary.finite;
    out["nan"] = summary.nan;
    out["positive_infinite"] = summary.positiveInfinite;
    out["negative_infinite"] = summary.negativeInfinite;
    out["min"] = summary.min;
    out["max"] = summary.max;
    out["mean"] = summary.mean;
    out["variance"] = summary.variance;
    out["deviation"] = summary.deviation();
    out["standard_error"] = summary.standardError();
    return out;
}

/// (counts, edges, below, above, NaN, positive infinite, negative infinite)
py::tuple makeHistogram(py::handle given, std::size_t bins, py::handle range, bool log) {
    const std::vector<double> values = toDoubles(given);
    ValueRange chosen = fullRange(values, {.log = log, .margin = 0}).range;
    if (!range.is_none()) {
        const std::vector<double> ends = toDoubles(range);
        if (ends.size() != 2) throw py::value_error("a range has two ends");
        chosen = {ends[0], ends[1], log};
    }
    Histogram made =
        histogram(std::span<const double>(values), chosen, bins > 0 ? bins : suggestedBins(values, chosen));
    std::vector<double> edges(made.binCount() + 1);
    for (std::size_t i = 0; i < edges.size(); ++i) edges[i] = made.lower(i);
    return py::make_tuple(moved(std::move(made.counts), Number::uint64), moved(std::move(edges), Number::float64),
                          made.below, made.above, made.nan, made.positiveInfinite, made.negativeInfinite);
}

py::object toOwnedArray(Image image) {
    const auto owner = std::make_shared<const Image>(std::move(image));
    return toArray(*owner, owner);
}

py::object difference(py::handle image, py::handle reference, const std::string& metric) {
    const auto chosen = imageMetricByName(metric);
    if (!chosen) throw py::value_error("there is no metric \"" + metric + "\"; emca.image_metrics.METRICS lists them");
    return toOwnedArray(unwrap(differenceImage(toImage(image), toImage(reference), *chosen)));
}

/// (error image, (start, stop, count) of the exposures)
py::tuple flipImages(py::handle given, py::handle givenReference, bool high, py::handle pixelsPerDegree,
                     py::handle exposures) {
    FlipOptions options;
    options.range = high ? FlipRange::high : FlipRange::low;
    if (!pixelsPerDegree.is_none()) options.pixelsPerDegree = pixelsPerDegree.cast<double>();
    if (!exposures.is_none()) {
        const auto three = py::reinterpret_borrow<py::sequence>(exposures);
        if (three.size() != 3) throw py::value_error("exposures are (start, stop, count)");
        options.exposures =
            FlipExposures{three[0].cast<double>(), three[1].cast<double>(), three[2].cast<std::uint32_t>()};
    }
    const Image image = toImage(given), reference = toImage(givenReference);
    FlipResult result = unwrap(unlocked([&] { return flip(image, reference, options); }));
    return py::make_tuple(toOwnedArray(std::move(result.error)),
                          py::make_tuple(result.exposures.start, result.exposures.stop, result.exposures.count));
}

PixelRect toRect(py::handle rect) {
    if (rect.is_none()) return {};
    const std::vector<std::uint32_t> ends = toIndices(rect);
    if (ends.size() != 4) throw py::value_error("a rectangle is (x0, y0, x1, y1)");
    return {ends[0], ends[1], ends[2], ends[3]};
}

py::list imageNumbers(py::handle image, py::handle rect) {
    py::list out;
    for (const ChannelStatistics& channel : imageStatistics(toImage(image), toRect(rect))) {
        py::dict item = toDict(channel.summary);
        item["channel"] = toText(channel.channel);
        item["negative"] = channel.negative;
        out.append(item);
    }
    return out;
}

py::list faults(py::handle image, std::size_t maximum) {
    constexpr const char* kNames[] = {"nan", "infinite", "negative"};
    py::list out;
    for (const FaultyPixel& found : faultyPixels(toImage(image), maximum))
        out.append(py::make_tuple(found.pixel.x, found.pixel.y, kNames[static_cast<std::size_t>(found.fault)]));
    return out;
}

py::list fireflies(py::handle image, int radius, float ratio, std::size_t maximum) {
    FireflyOptions options;
    options.radius = radius;
    options.ratio = ratio;
    options.maximum = maximum;
    py::list out;
    for (const Firefly& found : findFireflies(toImage(image), options))
        out.append(py::make_tuple(found.pixel.x, found.pixel.y, found.luminance, found.neighbours, found.ratio));
    return out;
}

}  // namespace

void bindAnalysis(py::module_& module) {
    module.def("path_outliers", &pathOutliers);
    module.def("path_outliers_per_pixel", &pathOutliersPerPixel);
    module.def("value_outliers", &valueOutliers);
    module.def("summarize",
               [](py::handle values) { return toDict(summarize(std::span<const double>(toDoubles(values)))); });
    module.def("histogram", &makeHistogram);
    module.def("difference", &difference);
    module.def("flip", &flipImages);
    module.def("image_statistics", &imageNumbers);
    module.def("faulty_pixels", &faults);
    module.def("fireflies", &fireflies);
    py::list metrics;
    for (std::size_t i = 0; i < kImageMetricCount; ++i) metrics.append(name(static_cast<ImageMetric>(i)));
    module.attr("metric_names") = py::tuple(metrics);
}

}  // namespace emca::python
