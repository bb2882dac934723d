#pragma once

#include <string>
#include <vector>

#include "emca/core/match_counts.h"
#include "emca/core/path_set.h"
#include "emca/query/query.h"
#include "emca/recorder/recording.h"
#include "emca/server/renderer.h"

namespace emca {

/// What a query goes over, and what is kept of it.
struct ScanOptions {
    std::vector<Pixel> pixels;               ///< each once, ascending
    RenderSettings settings;                 ///< complete
    std::vector<std::string> columns;        ///< wanted of the matches; empty: all
    KeepMatches keep = KeepMatches::all;
    std::uint32_t keepCount = 0;             ///< with KeepMatches::brightest
    std::size_t budgetBytes = 0;             ///< of the matches that are kept, and of the recordings of all threads
    bool locations = false;
    RecordingObserver* observer = nullptr;
    unsigned threads = 1;
    bool onePass = false;                    ///< all pixels in one batch: each batch would repeat the same work
};

struct ScanResult {
    std::vector<Color> values;               ///< one per pixel
    PathSet paths;                           ///< that matched and were kept
    RecordingStats stats;                    ///< of all recordings together; bytes: the most at one time
    MatchCounts matches;                     ///< per pixel as in the options
    bool complete = true;                    ///< every path's estimate and splats were recorded and kept
};

/// Replays pixels into one recording. `recorded.pixels` are the pixels, each once, ascending; values, paths and stats of the
/// result are filled in. Errors: those of the renderer.
/// \param threads  call the renderer for a few pixels each; more than one only if it is concurrent and if no path of one
///                 pixel reaches another. Values and paths are the same for any number: a recording puts paths into order,
///                 and what does not fit into the budget is recorded again by one thread, so that the first pixels are kept.
Result<ScanResult> replayPixels(Renderer& renderer, RecordingOptions recorded, const RenderSettings& settings, RequestMonitor& monitor,
                                unsigned threads = 1);

/// Replays pixels in batches, evaluates the query on each as soon as it is recorded, and keeps nothing but matches,
/// counts and sums: memory does not grow with pixels or samples, but for what is kept. What is kept does not depend on
/// the threads. Errors: those of the renderer and of the query; cancelled.
Result<ScanResult> scanPaths(Renderer& renderer, const query::Query& query, const ScanOptions& options, RequestMonitor& monitor);

}  // namespace emca
