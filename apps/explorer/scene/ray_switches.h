#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/path_ids.h"

namespace emca::explorer {

/// What is drawn of one path, whatever is drawn of the others.
struct PathRays {
    bool line = true, nextEvents = true;
    friend bool operator==(const PathRays&, const PathRays&) = default;
};
/// What is drawn at one vertex.
struct VertexRays {
    bool incoming = true, outgoing = true, nextEvents = true;
    friend bool operator==(const VertexRays&, const VertexRays&) = default;
};

/// Switches of single paths and vertices. Those that have some are drawn by them, selected or not; all others by the
/// options of the view. A plain value by identifiers, so that it survives a new trace.
class RaySwitches {
  public:
    bool empty() const { return paths_.empty() && vertices_.empty(); }
    std::optional<PathRays> of(const client::PathId& path) const { return find(paths_, path); }
    std::optional<VertexRays> of(const client::VertexId& vertex) const { return find(vertices_, vertex); }
    void set(const client::PathId& path, PathRays rays) { put(paths_, path, rays); }
    void set(const client::VertexId& vertex, VertexRays rays) { put(vertices_, vertex, rays); }
    void remove(const client::PathId& path) {
        std::erase_if(paths_, [&](const auto& e) { return e.first == path; });
    }
    void remove(const client::VertexId& vertex) {
        std::erase_if(vertices_, [&](const auto& e) { return e.first == vertex; });
    }
    const std::vector<std::pair<client::PathId, PathRays>>& paths() const { return paths_; }
    const std::vector<std::pair<client::VertexId, VertexRays>>& vertices() const { return vertices_; }
    friend bool operator==(const RaySwitches&, const RaySwitches&) = default;

  private:
    template <typename Id, typename Rays>
    static std::optional<Rays> find(const std::vector<std::pair<Id, Rays>>& all, const Id& id) {
        const auto found = std::ranges::find(all, id, &std::pair<Id, Rays>::first);
        return found == all.end() ? std::nullopt : std::optional(found->second);
    }
    template <typename Id, typename Rays>
    static void put(std::vector<std::pair<Id, Rays>>& all, const Id& id, Rays rays) {
        const auto found = std::ranges::find(all, id, &std::pair<Id, Rays>::first);
        if (found == all.end()) all.emplace_back(id, rays);
        else found->second = rays;
    }
    std::vector<std::pair<client::PathId, PathRays>> paths_;
    std::vector<std::pair<client::VertexId, VertexRays>> vertices_;
};

/// The same as positions in the PathSet that is shown, ascending. What is not loaded is not in it.
struct ShownRays {
    std::vector<std::pair<Index, PathRays>> paths;
    std::vector<std::pair<Index, VertexRays>> vertices;

    ShownRays() = default;
    ShownRays(const RaySwitches& switches, const PathSet& set) {
        for (const auto& [id, rays] : switches.paths())
            if (const auto path = findPath(set, id)) paths.emplace_back(*path, rays);
        for (const auto& [id, rays] : switches.vertices())
            if (const auto vertex = findVertex(set, id)) vertices.emplace_back(*vertex, rays);
        std::ranges::sort(paths, {}, &std::pair<Index, PathRays>::first);
        std::ranges::sort(vertices, {}, &std::pair<Index, VertexRays>::first);
    }
    const PathRays* ofPath(Index path) const { return find(paths, path); }
    const VertexRays* ofVertex(Index vertex) const { return find(vertices, vertex); }

  private:
    template <typename Rays>
    static const Rays* find(const std::vector<std::pair<Index, Rays>>& all, Index index) {
        const auto found = std::ranges::lower_bound(all, index, {}, &std::pair<Index, Rays>::first);
        return found != all.end() && found->first == index ? &found->second : nullptr;
    }
};

}  // namespace emca::explorer
