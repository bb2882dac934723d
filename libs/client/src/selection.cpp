#include "emca/client/selection.h"

#include <algorithm>

#include "notify.h"

namespace emca::client {

namespace {

bool contains(const std::vector<PathId>& sorted, const PathId& path) {
    return std::binary_search(sorted.begin(), sorted.end(), path);
}

void sortAndUnify(std::vector<PathId>& paths) {
    std::sort(paths.begin(), paths.end());
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
}

/// The current path after `paths` changed: kept if among them, else the only one, else none.
void chooseCurrent(Selection::State& state) {
    if (state.currentPath && contains(state.paths, *state.currentPath)) return;
    state.currentPath.reset();
    if (state.paths.size() == 1) state.currentPath = state.paths.front();
}

void dropStrayVertex(Selection::State& state) {
    if (state.vertex && (!state.currentPath || state.vertex->path != *state.currentPath)) state.vertex.reset();
}

void choosePixels(Selection::State& state) {
    if (state.region.empty()) return;
    if (state.region.size() == 1) {
        state.pixel = state.region.pixels().front();
        state.region = {};
    } else {
        state.pixel.reset();
    }
}

}  // namespace

bool Selection::isSelected(const PathId& path) const { return contains(state_.paths, path); }

void Selection::setPixel(std::optional<Pixel> pixel) {
    State next = state_;
    next.pixel = pixel;
    next.region = {};
    assign(std::move(next));
}

void Selection::setRegion(PixelRegion region) {
    State next = state_;
    next.pixel.reset();
    next.region = std::move(region);
    choosePixels(next);
    assign(std::move(next));
}

void Selection::togglePixel(Pixel pixel) { setRegion(pixels().toggled(pixel)); }

PixelRegion Selection::pixels() const {
    return state_.pixel ? PixelRegion(std::vector<Pixel>{*state_.pixel}) : state_.region;
}

void Selection::setPaths(std::vector<PathId> paths) {
    State next = state_;
    next.paths = std::move(paths);
    sortAndUnify(next.paths);
    chooseCurrent(next);
    assign(std::move(next));
}

void Selection::togglePath(const PathId& path) {
    State next = state_;
    const auto it = std::lower_bound(next.paths.begin(), next.paths.end(), path);
    if (it != next.paths.end() && *it == path) {
        next.paths.erase(it);
    } else {
        next.paths.insert(it, path);
    }
    chooseCurrent(next);
    assign(std::move(next));
}

void Selection::setCurrentPath(const PathId& path) {
    State next = state_;
    const auto it = std::lower_bound(next.paths.begin(), next.paths.end(), path);
    if (it == next.paths.end() || *it != path) next.paths.insert(it, path);
    next.currentPath = path;
    assign(std::move(next));
}

void Selection::setVertex(const VertexId& vertex) {
    State next = state_;
    const auto it = std::lower_bound(next.paths.begin(), next.paths.end(), vertex.path);
    if (it == next.paths.end() || *it != vertex.path) next.paths.insert(it, vertex.path);
    next.currentPath = vertex.path;
    next.vertex = vertex;
    assign(std::move(next));
}

void Selection::clearVertex() {
    State next = state_;
    next.vertex.reset();
    assign(std::move(next));
}

void Selection::clearPaths() { setPaths({}); }

void Selection::set(State state) {
    choosePixels(state);
    sortAndUnify(state.paths);
    if (state.currentPath && !contains(state.paths, *state.currentPath)) state.currentPath.reset();
    assign(std::move(state));
}

void Selection::setHovered(std::optional<VertexId> vertex) {
    if (hovered_ == vertex) return;
    hovered_ = vertex;
    changed(SelectionPart::hover);
}

void Selection::assign(State state) {
    dropStrayVertex(state);
    std::uint32_t parts = 0;
    if (state.pixel != state_.pixel) parts |= SelectionPart::pixel;
    if (state.region != state_.region) parts |= SelectionPart::region;
    if (state.paths != state_.paths) parts |= SelectionPart::paths;
    if (state.currentPath != state_.currentPath) parts |= SelectionPart::currentPath;
    if (state.vertex != state_.vertex) parts |= SelectionPart::vertex;
    if (parts == 0) return;
    state_ = std::move(state);
    changed(parts);
}

void Selection::changed(std::uint32_t parts) {
    pending_ |= parts;
    notifyListeners(listeners_, pending_, notifying_);
}

Selection::ListenerId Selection::listen(Listener listener) {
    listeners_.emplace_back(nextListener_, std::move(listener));
    return nextListener_++;
}

void Selection::unlisten(ListenerId id) {
    std::erase_if(listeners_, [id](const auto& entry) { return entry.first == id; });
}

}  // namespace emca::client
