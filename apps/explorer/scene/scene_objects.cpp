#include "scene_objects.h"

#include <algorithm>
#include <cmath>

#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

template <typename... F>
struct Overloaded : F... { using F::operator()...; };
template <typename... F>
Overloaded(F...) -> Overloaded<F...>;

Error broken(const SceneObject& object, const std::string& rule) {
    return {ErrorCode::invalidArgument, "The scene object '" + object.name + "' was refused: " + rule + "."};
}

/// Cells of a grid, without overflow: more than kMaximumElements counts as one more.
std::size_t cellCount(const VoxelGrid& grid) {
    std::size_t n = 1;
    for (const std::uint32_t s : grid.size) {
        if (s == 0) return 0;
        if (n > SceneObject::kMaximumElements / s) return SceneObject::kMaximumElements + 1;
        n *= s;
    }
    return n;
}

std::optional<std::string> brokenShape(const TriangleSet& t) {
    for (const Triangle& triangle : t.triangles)
        for (const std::uint32_t v : triangle)
            if (v >= t.positions.size())
                return "a triangle has the index " + std::to_string(v) + ", there are " + std::to_string(t.positions.size()) + " positions";
    return std::nullopt;
}

std::optional<std::string> brokenShape(const VoxelGrid& grid) {
    for (const float edge : {grid.cell.x, grid.cell.y, grid.cell.z})
        if (!(edge > 0) || !std::isfinite(edge)) return "the edges of a cell have to be positive, one is " + analysis::formatNumber(double(edge));
    if (!isFinite(grid.origin)) return "the grid's origin has to be finite";
    return std::nullopt;
}

template <typename Shape>
std::optional<std::string> brokenShape(const Shape&) { return std::nullopt; }

}  // namespace

std::size_t SceneObject::elementCount() const {
    return std::visit(Overloaded{[](const BoxSet& s) { return s.boxes.size(); }, [](const ArrowSet& s) { return s.arrows.size(); },
                                 [](const PointSet& s) { return s.points.size(); }, [](const VoxelGrid& s) { return cellCount(s); },
                                 [](const TriangleSet& s) { return s.triangles.size(); }},
                      shape);
}

Result<void> check(const SceneObject& object) {
    if (object.name.empty()) return broken(object, "it needs a name");
    const std::size_t n = object.elementCount();
    if (n > SceneObject::kMaximumElements)
        return broken(object, "it has more than " + std::to_string(SceneObject::kMaximumElements) + " elements");
    const auto fits = [&](std::size_t count, bool needed) { return count == n || (count == 0 && !needed); };
    const bool isGrid = std::holds_alternative<VoxelGrid>(object.shape);
    for (const auto& [count, what, needed] : {std::tuple(object.colors.colors.size(), "colours", false),
                                              std::tuple(object.colors.values.size(), "values", isGrid),
                                              std::tuple(object.labels.size(), "labels", false)})
        if (!fits(count, needed))
            return broken(object, "it has " + std::to_string(n) + " elements and " + std::to_string(count) + " " + what);
    if (const auto rule = std::visit([](const auto& shape) { return brokenShape(shape); }, object.shape)) return broken(object, *rule);
    return {};
}

BoundingBox boundsOf(const SceneObject& object) {
    BoundingBox box;
    const auto add = [&](Vec3f p) {
        if (isFinite(p)) box.extend(p);
    };
    std::visit(Overloaded{
                   [&](const BoxSet& s) {
                       for (const ObjectBox& b : s.boxes)
                           for (int i = 0; i < 8; ++i)
                               add(b.centre + b.x * (i & 1 ? 1.f : -1.f) + b.y * (i & 2 ? 1.f : -1.f) + b.z * (i & 4 ? 1.f : -1.f));
                   },
                   [&](const ArrowSet& s) {
                       for (const ObjectArrow& a : s.arrows) add(a.from), add(a.to);
                   },
                   [&](const PointSet& s) {
                       for (const Vec3f& p : s.points) add(p);
                   },
                   [&](const VoxelGrid& s) {
                       if (cellCount(s) == 0) return;
                       add(s.origin);
                       add(s.origin + Vec3f{s.cell.x * float(s.size[0]), s.cell.y * float(s.size[1]), s.cell.z * float(s.size[2])});
                   },
                   [&](const TriangleSet& s) {
                       for (const Vec3f& p : s.positions) add(p);
                   }},
               object.shape);
    return box;
}

analysis::ValueRange rangeOf(const ObjectColors& colors) {
    if (colors.range) return colors.range->repaired();
    analysis::ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), false};
    for (const float v : colors.values) {
        if (!std::isfinite(v)) continue;
        range.min = std::min(range.min, double(v));
        range.max = std::max(range.max, double(v));
    }
    return range.min <= range.max ? range.repaired() : analysis::ValueRange();
}

std::vector<analysis::Color8> colorsOf(const SceneObject& object) {
    const ObjectColors& c = object.colors;
    if (!c.colors.empty()) return c.colors;
    std::vector<analysis::Color8> result(object.elementCount(), c.color);
    if (c.values.empty()) return result;
    const analysis::ColorMap& map = analysis::ColorMap::get(c.map);
    const analysis::ValueRange range = rangeOf(c);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = map.map(double(c.values[i]), range);
    return result;
}

std::string labelOf(const SceneObject& object, std::size_t element) {
    std::string text = element < object.labels.size() ? object.labels[element] : std::string();
    if (text.empty()) text = object.name + " " + std::to_string(element);
    if (element < object.colors.values.size()) {
        text += ": " + analysis::formatNumber(double(object.colors.values[element]));
        if (!object.colors.unit.empty()) text += " " + object.colors.unit;
    }
    return text;
}

Result<void> SceneObjects::set(const ObjectId& id, SceneObject object, bool visibleAtFirst) {
    if (auto checked = check(object); !checked) return checked;
    auto shared = std::make_shared<const SceneObject>(std::move(object));
    const auto place = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
    if (place != entries_.end() && place->id == id) {
        place->object = std::move(shared);
    } else {
        const auto kept = std::ranges::find(switches_, id, &std::pair<ObjectId, bool>::first);
        entries_.insert(place, {id, std::move(shared), kept == switches_.end() ? visibleAtFirst : kept->second});
    }
    changed(objects);
    return {};
}

void SceneObjects::remove(const ObjectId& id) {
    if (std::erase_if(entries_, [&](const Entry& e) { return e.id == id; }) > 0) changed(objects);
}

void SceneObjects::removeAll(const std::string& owner) {
    if (std::erase_if(entries_, [&](const Entry& e) { return e.id.owner == owner; }) > 0) changed(objects);
}

void SceneObjects::setVisible(const ObjectId& id, bool visible) {
    const auto kept = std::ranges::find(switches_, id, &std::pair<ObjectId, bool>::first);
    if (kept == switches_.end()) switches_.emplace_back(id, visible);
    else kept->second = visible;
    const auto place = std::ranges::find(entries_, id, &Entry::id);
    if (place == entries_.end() || place->visible == visible) return;
    place->visible = visible;
    changed(visibility);
}

const SceneObjects::Entry* SceneObjects::find(const ObjectId& id) const {
    const auto place = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
    return place != entries_.end() && place->id == id ? &*place : nullptr;
}

void SceneObjects::pick(const ObjectId& id, std::size_t element) {
    if (!find(id)) return;
    const auto listeners = pickListeners_;   // they may come and go while they are called
    for (const auto& [listenerId, listener] : listeners)
        if (std::ranges::find(pickListeners_, listenerId, &std::pair<ListenerId, PickListener>::first) != pickListeners_.end())
            listener(id, element);
}

SceneObjects::ListenerId SceneObjects::listen(Listener listener) {
    listeners_.emplace_back(nextListener_, std::move(listener));
    return nextListener_++;
}

SceneObjects::ListenerId SceneObjects::listenPicks(PickListener listener) {
    pickListeners_.emplace_back(nextListener_, std::move(listener));
    return nextListener_++;
}

void SceneObjects::unlisten(ListenerId id) {
    std::erase_if(listeners_, [&](const auto& l) { return l.first == id; });
    std::erase_if(pickListeners_, [&](const auto& l) { return l.first == id; });
}

void SceneObjects::changed(std::uint32_t changes) {
    pending_ |= changes;
    if (transactions_ > 0) return;
    const std::uint32_t told = std::exchange(pending_, 0u);
    const auto listeners = listeners_;
    for (const auto& [id, listener] : listeners)
        if (std::ranges::find(listeners_, id, &std::pair<ListenerId, Listener>::first) != listeners_.end()) listener(told);
}

SceneObjects::Transaction::~Transaction() {
    if (--objects_.transactions_ == 0 && objects_.pending_ != 0) objects_.changed(0);
}

}  // namespace emca::explorer
