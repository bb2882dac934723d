#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "emca/client/pixel_region.h"
#include "emca/core/event.h"
#include "emca/core/pixel.h"

namespace emca::client {

/// Names a path whatever else is loaded.
struct PathId {
    Pixel pixel;
    std::int64_t sample = 0;
    std::int32_t part = 0;
    friend bool operator==(const PathId&, const PathId&) = default;
    friend std::strong_ordering operator<=>(const PathId&, const PathId&) = default;
};

struct VertexId {
    PathId path;
    std::int32_t depth = 0;
    Subpath subpath = Subpath::camera;
    friend bool operator==(const VertexId&, const VertexId&) = default;
};

/// Parts of a Selection, as bits.
struct SelectionPart { enum : std::uint32_t { pixel = 1, paths = 2, currentPath = 4, vertex = 8, hover = 16, region = 32 }; };

/// What a person looks at: identifiers only, so that it survives a new trace of the same pixel. The one model beside
/// Dataset that all views read and write. Not thread-safe: it belongs to the thread that shows it.
///
/// Rules: there is a pixel or a region of two pixels or more, never both; `paths` is sorted and without duplicates, of one or several pixels; the current path is one of `paths` or
/// none; the current vertex lies on the current path or there is none.
class Selection {
  public:
    struct State {
        std::optional<Pixel> pixel;             ///< the one last clicked
        std::vector<PathId> paths;              ///< selected paths
        std::optional<PathId> currentPath;
        std::optional<VertexId> vertex;
        PixelRegion region;                     ///< pixels looked at together; a single one is `pixel`
        friend bool operator==(const State&, const State&) = default;
    };
    using Listener = std::function<void(std::uint32_t parts)>;
    using ListenerId = std::uint64_t;

    const State& state() const { return state_; }
    bool isSelected(const PathId& path) const;
    const std::optional<VertexId>& hovered() const { return hovered_; }  ///< under the cursor, in any view

    /// Any of these tells each listener at most once, and not at all if nothing changed.
    void setPixel(std::optional<Pixel> pixel);       ///< ends a region
    void setRegion(PixelRegion region);              ///< ends `pixel`; of one pixel: setPixel, of none: nothing is looked at
    /// Adds the pixel to what is looked at, or takes it away: one pixel and another are a region of two.
    void togglePixel(Pixel pixel);
    /// The region, or the pixel as a region of one.
    PixelRegion pixels() const;
    void setPaths(std::vector<PathId> paths);        ///< current path: kept if among them, else the only one, else none
    void togglePath(const PathId& path);
    void setCurrentPath(const PathId& path);         ///< adds it to `paths` if it is not among them
    void setVertex(const VertexId& vertex);          ///< its path becomes current
    void clearVertex();
    void clearPaths();
    /// Made to obey the rules: a region of one pixel becomes `pixel`, a larger one takes its place; a current path that is not among `paths` is dropped, so is a vertex off the current path.
    void set(State state);
    void setHovered(std::optional<VertexId> vertex);

    /// Listeners may add and remove listeners (themselves too) and change the selection while they are called; such a
    /// change is told to all of them after the running round.
    ListenerId listen(Listener listener);
    void unlisten(ListenerId id);

  private:
    void assign(State state);
    void changed(std::uint32_t parts);
    State state_;
    std::optional<VertexId> hovered_;
    std::vector<std::pair<ListenerId, Listener>> listeners_;
    ListenerId nextListener_ = 1;
    std::uint32_t pending_ = 0;
    bool notifying_ = false;
};

}  // namespace emca::client
