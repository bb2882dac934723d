#include <cmath>

#include "emca/doctor/path_checks.h"
#include "words.h"

namespace emca::doctor {
namespace {

/// What is finite as a double may not be so as a float, and that is nobody's fault.
float asFloat(double value) { return std::isfinite(value) ? 0.f : static_cast<float>(value); }

std::size_t floatsOf(ValueType type) {
    switch (type) {
        case ValueType::float1: return 1;
        case ValueType::float2: return 2;
        case ValueType::float3: case ValueType::color: return 3;
        case ValueType::colorA: return 4;
        default: return 0;
    }
}

}  // namespace

std::string pathName(const PathSet& paths, Index path) {
    const Pixel pixel = paths.pixel(path);
    const std::string part = paths.part(path) == 0 ? "" : fmt::format(" part {}", paths.part(path));
    return fmt::format("pixel ({}, {}), path {}{}", pixel.x, pixel.y, paths.sample(path), part);
}

std::string placeName(const PathSet& paths, Index vertex) {
    return fmt::format("{}, {}depth {}", pathName(paths, paths.pathOf(vertex)), paths.subpath(vertex) == Subpath::light ? "light " : "", paths.depthIndex(vertex));
}

void ValueCheck::take(const std::string& quantity, bool place, std::span<const float> values, const PathSet& paths, Index owner, bool ofPath) {
    ++values_;
    bool nan = false, infinite = false;
    for (const float f : values) {
        nan = nan || std::isnan(f);
        infinite = infinite || std::isinf(f);
    }
    if (!nan && !infinite) return;
    Counts& counts = counts_[quantity];
    if (counts.nan + counts.infinite == 0) {
        counts.place = place;
        counts.example = ofPath ? pathName(paths, owner) : placeName(paths, owner);
        counts.pixel = paths.pixel(ofPath ? owner : paths.pathOf(owner));
    }
    ++(nan ? counts.nan : counts.infinite);
}

void ValueCheck::takeColumn(const PathSet& paths, const Column& column) {
    const bool ofPath = column.scope == Scope::path;
    const std::size_t floats = floatsOf(column.type);
    for (Index i = 0; i < column.count; ++i) {
        if (floats > 0) {
            take(column.name, false, column.values<float>().subspan(i * floats, floats), paths, column.owner(i), ofPath);
        } else if (column.type == ValueType::spectrum) {
            const std::uint32_t first = column.spectrumOffsets[i];
            take(column.name, false, column.values<float>().subspan(first, column.spectrumOffsets[i + 1] - first), paths, column.owner(i), ofPath);
        } else if (column.type == ValueType::double1 || column.type == ValueType::double2 || column.type == ValueType::double3) {
            const std::size_t n = byteSize(column.type) / sizeof(double);
            float copy[3] = {};
            for (std::size_t c = 0; c < n; ++c) copy[c] = asFloat(column.values<double>()[i * n + c]);
            take(column.name, false, {copy, n}, paths, column.owner(i), ofPath);
        }
    }
}

void ValueCheck::add(const PathSet& paths) {
    const auto color = [&](const char* quantity, Color c, Index owner, bool ofPath) { take(quantity, false, std::span(&c.r, 3), paths, owner, ofPath); };
    const auto position = [&](const char* quantity, Vec3f p, Index owner, bool ofPath) { take(quantity, true, std::span(&p.x, 3), paths, owner, ofPath); };
    const PathColumns& columns = paths.columns();
    for (Index path = 0; path < paths.pathCount(); ++path) {
        if (const auto origin = paths.origin(path)) position("origin", *origin, path, true);
        if (const auto estimate = paths.estimate(path)) color("final estimate", *estimate, path, true);
    }
    for (Index v = 0; v < paths.vertexCount(); ++v) {
        if (const auto p = paths.position(v)) position("position", *p, v, false);
        if (const auto estimate = paths.vertexEstimate(v)) color("intersection estimate", *estimate, v, false);
        if (const auto emission = paths.emission(v)) color("emission", *emission, v, false);
    }
    for (std::size_t i = 0; i < columns.nextEvents.size(); ++i) position("next-event position", columns.nextEvents[i].position, columns.nextEventOwners[i], false);
    for (std::size_t i = 0; i < columns.contributions.size(); ++i) {
        color("contribution", columns.contributions[i].value, columns.contributionOwners[i], false);
        const float weight = columns.contributions[i].misWeight;  // NaN means that the renderer did not say
        if (!std::isnan(weight)) take("MIS weight", false, std::span(&weight, 1), paths, columns.contributionOwners[i], false);
    }
    for (std::size_t i = 0; i < columns.splats.size(); ++i) color("splat", columns.splats[i].value, columns.splatOwners[i], true);
    for (const Column& column : paths.userColumns()) takeColumn(paths, column);
}

Finding ValueCheck::finding() const {
    Finding finding{.check = "values"};
    finding.count("values", values_);
    if (values_ == 0) {
        finding.complain(Outcome::warning, "Nothing was recorded.", "Call emca::recorder() in the loop that renders: setPathIndex, setDepthIndex, setIntersectionPos, setFinalEstimate.");
        return finding;
    }
    finding.sentence = counts_.empty() ? fmt::format("All of {} are finite.", counted(values_, "recorded value")) : fmt::format("Of {}:", counted(values_, "recorded value"));
    for (const auto& [quantity, counts] : counts_) {
        finding.count("nan " + quantity, counts.nan);
        finding.count("infinite " + quantity, counts.infinite);
        std::string what = quantity + ": ";
        if (counts.nan > 0) what += fmt::format("{} NaN", counts.nan);
        if (counts.infinite > 0) what += fmt::format("{}{} infinite", counts.nan > 0 ? ", " : "", counts.infinite);
        finding.complain(counts.place ? Outcome::failed : Outcome::warning, fmt::format("{} (first: {}).", what, counts.example),
                         counts.place ? "Positions that are not finite cannot be drawn: record a position only where there is one, and setIntersectionPosEnvmap for what left the scene."
                                      : "Is that what the renderer computed? Then EMCA has found it something to fix; `emca pixel` shows the path.");
        if (finding.pixels.size() < 5) finding.pixels.push_back({counts.pixel, quantity + " is not finite"});
    }
    return finding;
}

}  // namespace emca::doctor
