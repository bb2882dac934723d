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

QColor segmentColor(const analysis::Segment& s, const ThemeColors& colors) {
    return s.kind == analysis::SegmentKind::scatter ? colors.path : colors.emitter;
}

/// The more lines lie over each other, the more each must let through.
float densityOpacity(std::size_t paths) {
    return std::clamp(4.5f / std::sqrt(static_cast<float>(std::max<std::size_t>(paths, 1))), 0.1f, 0.85f);
}

}  // namespace

PathLayer::PathLayer(vtkRenderer& strokes)
    : context_(strokes), coarseContext_(strokes), contextNextEvents_(strokes), selectedNextEvents_(strokes), selected_(strokes),
      current_(strokes), marks_(strokes) {}

void PathLayer::setPaths(const PathSet* paths, const PathGeometry* geometry) {
    paths_ = paths;
    geometry_ = geometry;
    selection_ = {};
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

void PathLayer::setSelection(ShownSelection selection) {
    if (selection == selection_) return;
    selection_ = std::move(selection);
    rebuildSelected();
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
                                 segmentColor(s, colors_)});
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

void PathLayer::appendPath(Index path, bool current, std::vector<Stroke>& lines, std::vector<Stroke>& marks) {
    const std::optional<Index> vertex = current ? selection_.vertex : std::nullopt;
    const bool detail = current || selection_.paths.size() <= kFullDetailPaths;
    const float width = kSelectedFactor * options_.lineWidth;
    for (const analysis::Segment& s : geometry_->segmentsOf(path)) {
        const bool incoming = vertex && s.to == *vertex, outgoing = vertex && s.from == *vertex;
        if (vertex && !options_.wholePath && !(incoming && options_.incoming) && !(outgoing && options_.outgoing)) continue;
        const QColor color = incoming ? colors_.currentSegment : segmentColor(s, colors_);
        (incoming ? selectedRoles_.current
         : s.kind == analysis::SegmentKind::scatter ? selectedRoles_.path : selectedRoles_.emitter) = true;
        lines.push_back({s.start, s.end, width, s.gap ? StrokeStyle::dashed : StrokeStyle::line, color});
        if (options_.arrows && detail) lines.push_back({s.start, s.end, 3.2f * width, StrokeStyle::arrow, color});
    }
    if (!detail) return;
    const IndexRange range = paths_->vertices(path);
    for (Index v = range.first; v < range.last; ++v)
        if (v != vertex && !paths_->isEnvironment(v))
            marks.push_back({geometry_->points[v], {}, 2.3f * width, StrokeStyle::dot, colors_.path});
    // What ends on a light says so with its dot as well; in the environment there is no place to mark, only a direction.
    for (const analysis::Segment& s : geometry_->segmentsOf(path))
        if (s.kind == analysis::SegmentKind::toEmitter && s.to != vertex)
            marks.push_back({geometry_->points[s.to], {}, 2.3f * width, StrokeStyle::dot, colors_.emitter});
}

void PathLayer::rebuildSelected() {
    selectedRoles_ = {};
    std::vector<Stroke> nextEvents, others, current, marks;
    if (paths_ && geometry_ && options_.paths != PathChoice::none) {
        const float width = options_.lineWidth;
        for (const Index path : selection_.paths) {
            const bool isCurrent = path == selection_.path;
            appendPath(path, isCurrent, isCurrent ? current : others, marks);
            if (options_.nextEvents >= NextEventChoice::selectedPaths || (isCurrent && options_.nextEvents == NextEventChoice::currentPath && options_.wholePath))
                appendNextEvents(path, std::nullopt, width, nextEvents);
        }
        if (selection_.vertex && (options_.nextEvents == NextEventChoice::currentVertex ||
                                  (options_.nextEvents == NextEventChoice::currentPath && !options_.wholePath)))
            appendNextEvents(paths_->pathOf(*selection_.vertex), selection_.vertex, width, nextEvents);
        if (selection_.vertex) {
            const Vec3f at = geometry_->points[*selection_.vertex];
            marks.push_back({at, {}, 7.f * width, StrokeStyle::dot, colors_.selected});
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
    const bool dimmed = !selection_.paths.empty();
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

void PathLayer::prepareFrame(float pixelScale, float fadeNear, float fadeFar) {
    for (StrokeLayer* layer : {&context_, &coarseContext_, &contextNextEvents_, &selectedNextEvents_, &selected_, &current_, &marks_}) {
        layer->look().pixelScale = pixelScale;
        layer->look().fadeNear = fadeNear;
        layer->look().fadeFar = fadeFar;
    }
}

}  // namespace emca::explorer
