// Which ways from the camera to a light a recorded path stands for.
#include <algorithm>
#include <functional>

#include "light_path.h"

namespace emca::query::detail {

LightPathMatcher::LightPathMatcher(const LightPathExpression& expression, const PathSet& paths)
    : expression_(expression), paths_(paths), hasContributions_(!paths.columns().contributions.empty()), width_(expression.symbolCount()) {
    const auto& strings = paths.columns().strings;
    const auto& labels = expression.labels();
    if (!labels.empty()) labelClasses_.resize(strings.size());
    for (std::size_t i = 0; i < labelClasses_.size(); ++i) {
        const auto found = std::find(labels.begin(), labels.end(), strings[i]);
        if (found != labels.end()) labelClasses_[i] = static_cast<std::uint8_t>(found - labels.begin() + 1);
    }
    symbols_.resize(symbolPlace(static_cast<Event>(kEventCount), Lobe{}, 0));
    for (std::uint8_t event = 0; event < kEventCount; ++event)
        for (std::uint8_t lobe = 0; lobe < kLobeCount; ++lobe)
            for (std::size_t label = 0; label <= labels.size(); ++label) {
                const auto e = static_cast<Event>(event);
                const auto l = static_cast<Lobe>(lobe);
                symbols_[symbolPlace(e, l, label)] = expression.symbol(e, l, label);
            }
    LightPathExpression::Ways ways = expression.takeWays();
    nodes_ = std::move(ways.nodes);
    next_ = std::move(ways.next);
    if (nodes_.empty()) forget();
}

std::size_t LightPathMatcher::symbolPlace(Event event, Lobe lobe, std::size_t label) const {
    return (static_cast<std::size_t>(event) * kLobeCount + static_cast<std::size_t>(lobe)) * (expression_.labels().size() + 1) + label;
}

bool LightPathMatcher::emits(Index vertex) const {
    const auto emission = paths_.emission(vertex);
    return emission && !isBlack(*emission);
}

bool LightPathMatcher::isHit(Index vertex, LightEnd said) const {
    return said == LightEnd::hit || (said == LightEnd::automatic && (paths_.isEnvironment(vertex) || emits(vertex)));
}

char LightPathMatcher::endAt(Index vertex) const {
    return eventOf(vertex) == Event::background || paths_.isEnvironment(vertex) ? LightPathExpression::kEnvironment : LightPathExpression::kSurface;
}

Event LightPathMatcher::eventOf(Index vertex) const {
    const auto& c = paths_.columns();
    return c.events.empty() || (c.vertexFlags[vertex] & VertexFlag::hasEvent) == 0 ? Event::none : static_cast<Event>(c.events[vertex]);
}

/// Puts a vertex and its symbol at a place of the walk. False for the camera, or the point on the light, itself.
bool LightPathMatcher::enter(Index v, std::size_t place) {
    const auto& c = paths_.columns();
    const Event event = eventOf(v);
    const bool ends = event == Event::none || event == Event::emission || event == Event::background;
    if (c.depths[v] == 0 && ends) return false;
    vertices_[place] = v;
    const bool labelled = !labelClasses_.empty() && !c.labels.empty() && c.labels[v] < labelClasses_.size();
    const std::size_t label = labelled ? labelClasses_[c.labels[v]] : 0;
    const char symbol = symbols_[symbolPlace(event, static_cast<Lobe>(c.lobes.empty() ? 0 : c.lobes[v]), label)];
    if (symbol == '\0') unrecorded_ = std::min(unrecorded_, place);
    walk_[place] = symbol;
    return true;
}

void LightPathMatcher::readWalk(Index path) {
    const IndexRange range = paths_.vertices(path);
    vertices_.resize(range.size());
    walk_.resize(range.size());
    std::size_t kept = 0;
    unrecorded_ = walk_.size();
    fromLight_ = true;
    for (Index v = range.first; v < range.last; ++v)
        if (paths_.subpath(v) == Subpath::camera) {
            fromLight_ = false;
            kept += enter(v, kept);
        }
    if (fromLight_)  // seen from the camera, a light path begins with its last vertex
        for (Index v = range.last; v-- > range.first;) kept += enter(v, kept);
    vertices_.resize(kept);
    walk_.resize(kept);
    recorded_ = std::min(unrecorded_, kept);
    reached_.assign(1, 0);
    if (next_.size() > kMaximumEntries) forget();
}

void LightPathMatcher::forget() {
    nodes_.assign(1, {});
    next_.assign(width_, 0);
    reached_.assign(1, 0);
}

/// The node after one symbol more.
std::uint32_t LightPathMatcher::follow(std::uint32_t node, char symbol) {
    const std::size_t entry = node * width_ + static_cast<unsigned char>(symbol);
    if (next_[entry] == 0) {  // nothing leads back to the root
        next_[entry] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        next_.resize(nodes_.size() * width_, 0);
    }
    return next_[entry];
}

/// The way from the camera over symbols [first, last) of the walk to an end.
Truth LightPathMatcher::wayMatches(std::size_t first, std::size_t last, char end) {
    const std::string_view way = std::string_view(walk_).substr(first, last - first);
    if (way.size() > kMaximumWay || (first == 0 ? last > recorded_ : way.find('\0') != way.npos)) return kUnknown;
    std::uint32_t node = 0;
    if (first == 0) {  // longer and longer prefixes of one walk: a step each
        while (reached_.size() <= last) reached_.push_back(follow(reached_.back(), walk_[reached_.size() - 1]));
        node = reached_[last];
    } else {
        if (next_.size() > kMaximumEntries) forget();
        for (const char symbol : way) node = follow(node, symbol);
    }
    std::uint8_t& known = nodes_[node].matches[static_cast<std::size_t>(end - LightPathExpression::kLight)];
    if (known == kUnknown) {
        text_.assign(1, LightPathExpression::kCamera);
        text_ += way;
        text_ += end;
        known = expression_.matches(text_) ? kTrue : kFalse;
    }
    return static_cast<Truth>(known);
}

Truth LightPathMatcher::matches(Index path) {
    readWalk(path);
    return hasContributions_ ? contributionsMatch(path) : walkMatches();
}

/// A contribution of the vertex at place `i` of the walk. Of a light path, what lies between this vertex and the light
/// comes after it: the vertex itself was connected to the camera.
Truth LightPathMatcher::wayOf(std::size_t i, bool hit) {
    if (fromLight_) return wayMatches(i, walk_.size(), LightPathExpression::kLight);
    return hit ? wayMatches(0, i, endAt(vertices_[i])) : wayMatches(0, i + 1, LightPathExpression::kLight);
}

Truth LightPathMatcher::contributionsMatch(Index path) {
    Truth result = kFalse;
    const IndexRange range = paths_.vertices(path);
    const SharedArray<Index>& owners = paths_.columns().contributionOwners;
    if (at_ > 0 && owners[at_ - 1] >= range.first) at_ = 0;  // paths are asked in order, nearly always
    if (at_ < owners.size() && owners[at_] < range.first)
        at_ = static_cast<std::size_t>(std::lower_bound(owners.begin() + at_, owners.end(), range.first) - owners.begin());
    for (; at_ < owners.size() && owners[at_] < range.last; ++at_) {
        const Index v = owners[at_];
        const std::size_t place = placeOf(v);
        Truth one = kUnknown;  // a connection of two subpaths: what lies between is not recorded
        if (place < vertices_.size()) one = wayOf(place, isHit(v, paths_.contribution(static_cast<Index>(at_)).end));
        else if (fromLight_ && paths_.depthIndex(v) == 0) one = wayMatches(0, 0, LightPathExpression::kLight);
        if (one == kTrue) return kTrue;
        if (one == kUnknown) result = kUnknown;
    }
    return result;
}

/// Where a vertex is in the walk; its size if it is not.
std::size_t LightPathMatcher::placeOf(Index vertex) const {
    const auto found = fromLight_ ? std::lower_bound(vertices_.begin(), vertices_.end(), vertex, std::greater<>())
                                  : std::lower_bound(vertices_.begin(), vertices_.end(), vertex);
    return found != vertices_.end() && *found == vertex ? static_cast<std::size_t>(found - vertices_.begin()) : vertices_.size();
}

Truth LightPathMatcher::walkMatches() {
    Truth result = kFalse;
    const auto consider = [&](Truth one) {
        if (one == kTrue || (one == kUnknown && result == kFalse)) result = one;
        return one == kTrue;
    };
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const Index v = vertices_[i];
        const Event event = eventOf(v);
        const bool ends = event == Event::emission || event == Event::background || paths_.isEnvironment(v) || emits(v);
        if (!fromLight_ && ends && consider(wayOf(i, true))) return kTrue;
    }
    // A light path that tells of no connection to the camera: all of it.
    if (fromLight_ && !vertices_.empty()) consider(wayOf(0, false));
    return result;
}

}  // namespace emca::query::detail
