#include "path_layer.h"

#include <algorithm>
#include <cmath>

namespace emca::explorer {
namespace {

constexpr float kSelectedFactor = 1.75f;  ///< width of selected paths against others
constexpr std::size_t kEyeRays = 12;      ///< all paths of a pixel begin alike: of those segments, so many are drawn
constexpr std::size_t kCoarsePaths = 192; ///< drawn while the camera moves, where all are too slow
constexpr std::size_t kFullDetailPaths = 32;  ///< more selected paths than this get no arrows and no dots

QColor withAlpha(QColor color, double alpha) {
    color.setAlphaF(alpha);
    return color;
}

/// The more lines lie over each other, the more each must let through.
float densityOpacity(std::size_t paths) {
    return std::clamp(4.5f / std::sqrt(static_cast<float>(std::max<std::size_t>(paths, 1))), 0.1f, 0.85f);
}

}  // namespace

PathLayer::PathLayer(vtkRenderer& context, vtkRenderer& strokes, const PathColoring& coloring)
    : coloring_(coloring), context_(context), coarseContext_(context), contextNextEvents_(context), selectedNextEvents_(strokes), selected_(strokes),
      current_(strokes), marks_(strokes) {}

void PathLayer::setPaths(const PathSet* paths, const PathGeometry* geometry) {
    paths_ = paths;
    geometry_ = geometry;
    selection_ = {};
    rays_ = {};
    rebuildContext();
    rebuildSelected();
}

void PathLayer::apply(const SceneOptions& options, const ThemeColors& colors) {
    const bool recolored = !begun_ || colors.path != colors_.path || colors.emitter != colors_.emitter;
    const bool context = recolored || options.lineWidth != options_.lineWidth || options.paths != options_.paths ||
                         options.maximumPaths != options_.maximumPaths || options.nextEvents != options_.nextEvents;
    begun_ = true;
    options_ = options;
    colors_ = colors;
    if (context) rebuildContext();
    rebuildSelected();
}

bool PathLayer::setSelection(ShownSelection selection) {
    if (selection == selection_) return false;
    const bool before = dimmed_;
    selection_ = std::move(selection);
    rebuildSelected();
    return dimmed_ != before;
}

void PathLayer::setRays(ShownRays rays) {
    rays_ = std::move(rays);
    rebuildSelected();
}

void PathLayer::recolor() {
    rebuildContext();
    rebuildSelected();
}

QColor PathLayer::colorOf(const analysis::Segment& s) const {
    return coloring_.color(s.to, s.kind == analysis::SegmentKind::scatter ? colors_.path : colors_.emitter);
}

bool PathLayer::isDrawn(Index path) const { return std::ranges::binary_search(drawn_, path); }

void PathLayer::rebuildContext() {
    drawn_.clear();
    contextRoles_ = {};
    std::vector<Stroke> lines, someLines, nextEvents;
    if (paths_ && geometry_ && options_.paths == PathChoice::all) {
        drawn_ = evenlyChosen(geometry_->pathCount(), options_.maximumPaths);
        lines.reserve(geometry_->segments.size());
        const std::size_t coarseStep = std::max<std::size_t>(1, drawn_.size() / kCoarsePaths);
        const std::size_t eyeStep = std::max<std::size_t>(1, drawn_.size() / kEyeRays);
        for (std::size_t i = 0; i < drawn_.size(); ++i) {
            const Index path = drawn_[i];
            for (const analysis::Segment& s : geometry_->segmentsOf(path)) {
                if (s.from == analysis::kNoIndex && i % eyeStep != 0 && s.kind == analysis::SegmentKind::scatter) continue;
                lines.push_back({s.start, s.end, options_.lineWidth, s.gap ? StrokeStyle::dashed : StrokeStyle::line,
                                 colorOf(s)});
                (s.kind == analysis::SegmentKind::scatter ? contextRoles_.path : contextRoles_.emitter) = true;
                if (i % coarseStep == 0) someLines.push_back(lines.back());
            }
            if (options_.nextEvents == NextEventChoice::allPaths)
                appendNextEvents(path, std::nullopt, 0.75f * options_.lineWidth, nextEvents);
        }
    }
    for (const Stroke& s : nextEvents)
        (s.color == colors_.nextEventVisible ? contextRoles_.visible : contextRoles_.occluded) = true;
    context_.setStrokes(lines);
    coarseContext_.setStrokes(someLines);
    contextNextEvents_.setStrokes(nextEvents);
    updateDimming();
}

void PathLayer::appendNextEvents(Index path, std::optional<Index> onlyVertex, float width, std::vector<Stroke>& lines) {
    for (const analysis::NextEventSegment& s : geometry_->nextEventsOf(path)) {
        if (onlyVertex && s.vertex != *onlyVertex) continue;
        lines.push_back({s.start, s.end, width, s.visible ? StrokeStyle::line : StrokeStyle::dashed,
                         s.visible ? colors_.nextEventVisible : colors_.nextEventOccluded});
        lines.push_back({s.end, s.end, 2.2f * width, StrokeStyle::dot, lines.back().color});
    }
}

bool PathLayer::isLineShown(const analysis::Segment& s, Index path) const {
    // Switches of its ends come first, then those of the path, then what holds for all.
    const VertexRays* into = rays_.ofVertex(s.to);
    const VertexRays* outOf = s.from == analysis::kNoIndex ? nullptr : rays_.ofVertex(s.from);
    if (into || outOf) return (into && into->incoming) || (outOf && outOf->outgoing);
    if (const PathRays* own = rays_.ofPath(path)) return own->line;
    if (!std::ranges::binary_search(selection_.paths, path)) return false;
    if (path != selection_.path || !selection_.vertex || options_.wholePath) return true;
    return (s.to == *selection_.vertex && options_.incoming) || (s.from == *selection_.vertex && options_.outgoing);
}

void PathLayer::appendPath(Index path, bool current, std::vector<Stroke>& lines, std::vector<Stroke>& marks) {
    const std::optional<Index> vertex = current ? selection_.vertex : std::nullopt;
    const bool detail = current || selection_.paths.size() <= kFullDetailPaths;
    const float width = kSelectedFactor * options_.lineWidth;
    for (const analysis::Segment& s : geometry_->segmentsOf(path)) {
        if (!isLineShown(s, path)) continue;
        const bool incoming = vertex && s.to == *vertex;
        const QColor color = incoming ? colors_.currentSegment : colorOf(s);
        (incoming ? selectedRoles_.current
         : s.kind == analysis::SegmentKind::scatter ? selectedRoles_.path : selectedRoles_.emitter) = true;
        lines.push_back({s.start, s.end, width, s.gap ? StrokeStyle::dashed : StrokeStyle::line, color});
        if (options_.arrows && detail) lines.push_back({s.start, s.end, 3.2f * width, StrokeStyle::arrow, color});
    }
    if (const PathRays* own = rays_.ofPath(path); own && !own->line) return;
    if (!detail) return;
    const IndexRange range = paths_->vertices(path);
    for (Index v = range.first; v < range.last; ++v)
        if (v != vertex && !paths_->isEnvironment(v))
            marks.push_back({geometry_->points[v], {}, 2.3f * width, StrokeStyle::dot, coloring_.color(v, colors_.path)});
    // What ends on a light says so with its dot as well; in the environment there is no place to mark, only a direction.
    for (const analysis::Segment& s : geometry_->segmentsOf(path))
        if (s.kind == analysis::SegmentKind::toEmitter && s.to != vertex && !coloring_.isOn())
            marks.push_back({geometry_->points[s.to], {}, 2.3f * width, StrokeStyle::dot, colors_.emitter});
}

/// What is selected, and what has switches of its own.
std::vector<Index> PathLayer::brightPaths() const {
    if (rays_.paths.empty() && rays_.vertices.empty()) return selection_.paths;
    std::vector<Index> paths = selection_.paths;
    for (const auto& [path, rays] : rays_.paths) paths.push_back(path);
    for (const auto& [vertex, rays] : rays_.vertices) paths.push_back(paths_->pathOf(vertex));
    std::ranges::sort(paths);
    paths.erase(std::ranges::unique(paths).begin(), paths.end());
    return paths;
}

void PathLayer::appendChosenNextEvents(Index path, std::vector<Stroke>& lines) {
    const bool isCurrent = path == selection_.path, isSelected = std::ranges::binary_search(selection_.paths, path);
    const NextEventChoice choice = options_.nextEvents;
    bool whole = isSelected && (choice >= NextEventChoice::selectedPaths || (isCurrent && choice == NextEventChoice::currentPath && options_.wholePath));
    if (const PathRays* own = rays_.ofPath(path)) whole = own->nextEvents;
    const bool atVertex = isCurrent && !rays_.ofPath(path) &&
                          (choice == NextEventChoice::currentVertex || (choice == NextEventChoice::currentPath && !options_.wholePath));
    const float width = options_.lineWidth;
    if (rays_.vertices.empty()) {
        if (whole) appendNextEvents(path, std::nullopt, width, lines);
        else if (atVertex && selection_.vertex) appendNextEvents(path, selection_.vertex, width, lines);
        return;
    }
    for (Index v = paths_->vertices(path).first; v < paths_->vertices(path).last; ++v) {
        const VertexRays* own = rays_.ofVertex(v);
        if (own ? own->nextEvents : whole || (atVertex && v == selection_.vertex)) appendNextEvents(path, v, width, lines);
    }
}

void PathLayer::rebuildSelected() {
    selectedRoles_ = {};
    std::vector<Stroke> nextEvents, others, current, marks;
    if (paths_ && geometry_ && options_.paths != PathChoice::none) {
        for (const Index path : brightPaths()) {
            const bool isCurrent = path == selection_.path;
            appendPath(path, isCurrent, isCurrent ? current : others, marks);
            appendChosenNextEvents(path, nextEvents);
        }
        if (selection_.vertex) {
            const Vec3f at = geometry_->points[*selection_.vertex];
            marks.push_back({at, {}, 7.f * options_.lineWidth, StrokeStyle::dot, colors_.selected});
            selectedRoles_.selected = true;
        }
    }
    for (const Stroke& s : nextEvents)
        (s.color == colors_.nextEventVisible ? selectedRoles_.visible : selectedRoles_.occluded) = true;
    selectedNextEvents_.setStrokes(nextEvents);
    selected_.setStrokes(others);
    current_.setStrokes(current);
    marks_.setStrokes(marks);
    updateDimming();
}

void PathLayer::updateDimming() {
    const bool dimmed = dimmed_ = !selection_.paths.empty();
    const float density = densityOpacity(drawn_.size()) * options_.pathOpacity;
    const float someDensity = densityOpacity(std::min(drawn_.size(), kCoarsePaths)) * options_.pathOpacity;
    coarseContext_.look().opacity = dimmed ? 0.15f * someDensity + 0.02f : someDensity;
    coarseContext_.setVisible(coarse_);
    context_.setVisible(!coarse_);
    contextNextEvents_.setVisible(!coarse_);
    context_.look().opacity = dimmed ? 0.15f * density + 0.02f : density;
    contextNextEvents_.look().opacity = dimmed ? 0.15f * density : 0.6f * density;
    // With one current path among several selected ones, that one leads.
    selected_.look().opacity = selection_.path && selection_.paths.size() > 1 ? 0.5f : 1.f;

    const QColor halo = withAlpha(colors_.halo, 0.85);
    for (StrokeLayer* layer : {&selectedNextEvents_, &selected_, &current_, &marks_}) {
        layer->look().halo = 1.3f;
        layer->look().haloColor = halo;
        layer->look().writesDepth = true;
    }
    for (StrokeLayer* layer : {&context_, &coarseContext_, &contextNextEvents_, &selectedNextEvents_, &selected_, &current_}) {
        const bool quiet = layer == &context_ || layer == &coarseContext_ || layer == &contextNextEvents_;
        layer->look().fade = quiet ? 0.7f : 0.45f;
        layer->look().fadeColor = colors_.sceneBottom;
    }
    // Dots lie on surfaces, half of each inside: bring them forward.
    // Through translucent surfaces they are seen whatever line crosses them.
    current_.look().pull = 0.005f;   // over next-event rays to the same light
    selectedNextEvents_.look().pull = 0.002f;   // their ends lie on lights
    marks_.look().pull = 0.02f;
    marks_.look().onTop = options_.surfaceOpacity < 0.995f;
}

ShownRoles PathLayer::roles() const {
    const ShownRoles &a = contextRoles_, &b = selectedRoles_;
    return {a.path || b.path,       b.current,                a.emitter || b.emitter,
            a.visible || b.visible, a.occluded || b.occluded, b.selected};
}

void PathLayer::setCoarse(bool coarse) {
    coarse_ = coarse;
    updateDimming();
}

void PathLayer::prepareFrame(float pixelScale, float fadeNear, float fadeFar, const ClipPlane& clip) {
    for (StrokeLayer* layer : {&context_, &coarseContext_, &contextNextEvents_, &selectedNextEvents_, &selected_, &current_, &marks_}) {
        layer->look().pixelScale = pixelScale;
        setClip(layer->look(), clip);
        layer->look().fadeNear = fadeNear;
        layer->look().fadeFar = fadeFar;
    }
}

}  // namespace emca::explorer
