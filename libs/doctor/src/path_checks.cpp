#include "emca/doctor/path_checks.h"

#include <bit>
#include <set>
#include <vector>

#include "emca/analysis/format.h"
#include "emca/core/replay.h"
#include "words.h"

namespace emca::doctor {
namespace {

/// Whether the depths of a path's camera subpath go up by one, from the camera (0) or the first hit (1).
bool hasGap(const PathSet& paths, IndexRange vertices) {
    std::int32_t previous = -1;
    bool first = true;
    for (Index v = vertices.first; v < vertices.last; ++v) {
        if (paths.subpath(v) != Subpath::camera) continue;
        const std::int32_t depth = paths.depthIndex(v);
        if (first ? depth > 1 : depth != previous + 1) return true;
        previous = depth;
        first = false;
    }
    return false;
}

}  // namespace

void PathCheck::add(const PathSet& paths, Pixel pixel, std::uint64_t expected, const RecordingStats& stats) {
    ++pixels_;
    paths_ += paths.pathCount();
    vertices_ += paths.vertexCount();
    splats_ += paths.columns().splats.size();
    dropped_.droppedWithoutPath += stats.droppedWithoutPath;
    dropped_.droppedWithoutVertex += stats.droppedWithoutVertex;
    dropped_.droppedByBudget += stats.droppedByBudget;
    std::set<std::int64_t> samples;
    for (Index path = 0; path < paths.pathCount(); ++path) {
        if (paths.pixel(path) == pixel) samples.insert(paths.sample(path));
        estimates_ += paths.estimate(path).has_value();
        const IndexRange vertices = paths.vertices(path);
        pathsWithoutVertices_ += vertices.empty();
        if (hasGap(paths, vertices) && gaps_++ == 0) gapExample_ = pathName(paths, path);
    }
    for (Index v = 0; v < paths.vertexCount(); ++v) verticesWithoutPosition_ += !paths.position(v);
    if (expected == 0 || !paths.columns().splats.empty() || samples.size() == expected || stats.droppedByBudget > 0) return;
    ++(samples.size() < expected ? fewer_ : more_);
    const std::string what = fmt::format("{} for {}", counted(samples.size(), "path"), counted(expected, "sample"));
    if (countExample_.empty()) countExample_ = fmt::format("pixel {} has {}", analysis::formatPixel(pixel), what);
    if (suspects_.size() < 5) suspects_.push_back({pixel, what});
}

Finding PathCheck::finding() const {
    Finding finding{.check = "paths", .pixels = splats_ == 0 ? suspects_ : std::vector<SuspectPixel>()};
    finding.sentence = fmt::format("{} with {} in {}.", counted(paths_, "path"), counted(vertices_, "vertex", "vertices"), counted(pixels_, "pixel"));
    finding.count("paths", paths_);
    finding.count("vertices", vertices_);
    finding.count("splats", splats_);
    finding.count("pathsWithoutVertices", pathsWithoutVertices_);
    finding.count("verticesWithoutPosition", verticesWithoutPosition_);
    finding.count("pathsWithGaps", gaps_);
    finding.count("pixelsWithTooFewPaths", splats_ == 0 ? fewer_ : 0);
    finding.count("pixelsWithTooManyPaths", splats_ == 0 ? more_ : 0);
    finding.count("droppedWithoutPath", dropped_.droppedWithoutPath);
    finding.count("droppedWithoutVertex", dropped_.droppedWithoutVertex);
    finding.count("droppedByBudget", dropped_.droppedByBudget);
    if (paths_ == 0) {
        // A light tracer's pixel may well have none.
        finding.complain(Outcome::failed, "No path was recorded.", "Call setPathIndex for each sample in renderPixel, in the thread that the server calls or inside a RecordScope of its own.");
        return finding;
    }
    if (splats_ == 0 && fewer_ + more_ > 0)
        finding.complain(Outcome::failed, fmt::format("{} of {} have not one path for each sample: {}.", fewer_ + more_, counted(pixels_, "pixel"), countExample_),
                         "Call setPathIndex with the sample's index, once for each sample, also for those that leave the scene at once; each index is one path.");
    if (vertices_ == 0)
        finding.complain(Outcome::warning, "No path has a vertex: there is nothing to draw.", "Call setDepthIndex and setIntersectionPos at each intersection.");
    if (gaps_ > 0)
        finding.complain(Outcome::warning, fmt::format("{} depth indices with gaps, first {}.", counted(gaps_, "path has", "paths have"), gapExample_),
                         "Count depths one by one: 1 is the first intersection (0, if used, the camera).");
    if (dropped_.droppedWithoutPath + dropped_.droppedWithoutVertex > 0)
        finding.complain(Outcome::warning, fmt::format("{} came before setPathIndex and {} before setDepthIndex, and were dropped.", counted(dropped_.droppedWithoutPath, "value"), dropped_.droppedWithoutVertex),
                         "Begin a path before its values, and a vertex before its own.");
    if (dropped_.droppedByBudget > 0)
        finding.complain(Outcome::warning, fmt::format("{} did not fit into the server's budget.", counted(dropped_.droppedByBudget, "value")), "Check with fewer samples: --spp.");
    return finding;
}

std::string differenceOf(const PathSet& a, const PathSet& b) {
    if (a.pathCount() != b.pathCount()) return fmt::format("{} instead of {}", counted(b.pathCount(), "path"), a.pathCount());
    for (Index path = 0; path < a.pathCount(); ++path) {
        if (a.pixel(path) != b.pixel(path) || a.sample(path) != b.sample(path) || a.part(path) != b.part(path)) return "other paths: " + pathName(b, path);
        const auto one = a.estimate(path), other = b.estimate(path);
        if (one.has_value() != other.has_value() || (one && compare(*one, *other) != Verdict::exact)) return "another final estimate: " + pathName(b, path);
        if (a.vertices(path).size() != b.vertices(path).size()) return "another number of vertices: " + pathName(b, path);
    }
    return "";
}

}  // namespace emca::doctor
