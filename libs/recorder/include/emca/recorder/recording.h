#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emca/core/path_set.h"
#include "emca/core/pixel.h"
#include "emca/core/result.h"

namespace emca {

namespace detail {
class Cursor;
struct BindingAccess;  // of other languages: libs/c
}
class PathHandle;

/// Told of what the recording threads begin and end, in the thread that does; see ServerTool.
class RecordingObserver {
  public:
    virtual ~RecordingObserver() = default;
    virtual void beginPath(Pixel, std::int64_t /*sample*/) {}
    virtual void endPath(Pixel, std::int64_t /*sample*/) {}
    virtual void beginVertex(std::int32_t /*depth*/) {}
    virtual void endVertex(std::int32_t /*depth*/) {}
};

struct RecordingOptions {
    /// The pixels asked for. A path is kept only if it belongs to one of them or adds a splat to one; empty: keep all.
    std::vector<Pixel> pixels;
    /// Names of the columns wanted: user keys and the core names "origin", "estimate", "position", "nee",
    /// "intersection estimate", "emission", "surface", "event", "contribution", "splat". A renderer's own data of such a
    /// name is data["position"]. Empty: all.
    std::vector<std::string> columns;
    std::size_t budgetBytes = 256u << 20;  ///< beyond, values are dropped and counted
    bool locations = false;                ///< remember the source line of every user value
    RecordingObserver* observer = nullptr; ///< must outlive the recording
};

/// The shared sink of one request. Threads record into it through RecordScope or explicit handles, any thread any path,
/// without locks; finish() puts all together in the order (pixel, sample, part, depth).
class Recording {
  public:
    explicit Recording(RecordingOptions options = {});
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    const RecordingOptions& options() const;
    /// Explicit handle to a path, a plain value: for wavefront renderers, from any thread, without a RecordScope.
    PathHandle path(Pixel pixel, std::int64_t sample, std::int32_t part = 0);

    /// Everything recorded. Call once, after all scopes are closed and all handles are done.
    /// Errors: tooLarge (more than 2^31 paths or vertices).
    Result<PathSet> finish();
    /// What was left out; complete after finish().
    RecordingStats stats() const;

  private:
    friend class RecordScope;
    friend class PathHandle;
    friend class VertexHandle;
    detail::Cursor* acquire();             ///< a cursor that no other thread uses
    void release(detail::Cursor* cursor);
    detail::Cursor& ofThisThread();        ///< for handles

    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// While it lives, emca::recorder() of this thread adds to the recording. Scopes nest; the inner one counts. Must be
/// destroyed in its own thread, before finish().
class RecordScope {
  public:
    /// Paths belong to `pixel` until setPixel says otherwise.
    RecordScope(Recording& recording, Pixel pixel);
    /// Paths belong to no pixel (light paths) until setPixel says otherwise: only splats keep them.
    explicit RecordScope(Recording& recording);
    ~RecordScope();
    RecordScope(const RecordScope&) = delete;
    RecordScope& operator=(const RecordScope&) = delete;

  private:
    Recording& recording_;
    detail::Cursor* cursor_;
    detail::Cursor* previous_;
};

}  // namespace emca
