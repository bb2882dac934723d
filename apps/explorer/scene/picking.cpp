#include "picking.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace emca::explorer {
namespace {

struct ScreenSegment { ScreenPoint from, to; };

/// The part in front of the eye, nothing if there is none.
std::optional<ScreenSegment> projectSegment(const Projection& projection, Vec3f from, Vec3f to) {
    if (!isFinite(from) || !isFinite(to)) return std::nullopt;
    auto a = projection.project(from), b = projection.project(to);
    if (!a && !b) return std::nullopt;
    if (!a || !b) {
        // One end is behind the eye: halve towards the other until it is in front, which is exact enough for picking.
        const Vec3f visible = a ? from : to;
        Vec3f hidden = a ? to : from;
        std::optional<ScreenPoint> clipped;
        for (int i = 0; i < 40 && !clipped; ++i) {
            hidden = (visible + hidden) * 0.5f;
            clipped = projection.project(hidden);
        }
        if (!clipped) return std::nullopt;
        (a ? b : a) = clipped;
    }
    return ScreenSegment{*a, *b};
}

}  // namespace

ScreenRect ScreenRect::normalized() const {
    return {std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1)};
}

std::optional<std::uint32_t> pickPoint(const Projection& projection, std::span<const Vec3f> points, double x, double y,
                                       double radius, const PickFilter& filter) {
    std::optional<std::uint32_t> best;
    std::pair<double, double> bestKey;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto s = projection.project(points[i]);
        if (!s || s->depth <= 0) continue;
        const double d2 = (s->x - x) * (s->x - x) + (s->y - y) * (s->y - y);
        if (d2 > radius * radius) continue;
        const std::pair key(s->depth, d2);
        if ((!best || key < bestKey) && (!filter || filter(i))) {
            best = i;
            bestKey = key;
        }
    }
    return best;
}

std::optional<std::uint32_t> pickSegment(const Projection& projection, std::span<const PickSegment> segments, double x,
                                         double y, double radius) {
    std::optional<std::uint32_t> best;
    double bestDepth = 0;
    for (const PickSegment& segment : segments) {
        const auto seen = projectSegment(projection, segment.from, segment.to);
        if (!seen) continue;
        const ScreenPoint &a = seen->from, &b = seen->to;
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double l2 = dx * dx + dy * dy;
        const double t = l2 > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / l2, 0.0, 1.0) : 0;
        const double ex = a.x + t * dx - x, ey = a.y + t * dy - y;
        if (ex * ex + ey * ey > radius * radius) continue;
        // Screen interpolation is linear in 1/depth for a perspective view; both ends are in front of it.
        const double depth = a.depth > 0 && b.depth > 0 ? 1 / ((1 - t) / a.depth + t / b.depth)
                                                          : (1 - t) * a.depth + t * b.depth;
        if (!best || depth < bestDepth) {
            best = segment.id;
            bestDepth = depth;
        }
    }
    return best;
}

std::vector<std::uint32_t> pointsInside(const Projection& projection, std::span<const Vec3f> points, ScreenRect rect,
                                        const PickFilter& filter) {
    rect = rect.normalized();
    std::vector<std::uint32_t> inside;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto s = projection.project(points[i]);
        if (s && s->depth > 0 && rect.contains(s->x, s->y) && (!filter || filter(i))) inside.push_back(i);
    }
    return inside;
}

bool crosses(const Projection& projection, Vec3f from, Vec3f to, ScreenRect rect) {
    const auto seen = projectSegment(projection, from, to);
    if (!seen) return false;
    rect = rect.normalized();
    // Clip the parameter interval by the four sides (Liang and Barsky 1984).
    double t0 = 0, t1 = 1;
    const double dx = seen->to.x - seen->from.x, dy = seen->to.y - seen->from.y;
    const auto clip = [&](double p, double q) {
        if (p == 0) return q >= 0;
        const double t = q / p;
        (p < 0 ? t0 : t1) = p < 0 ? std::max(t0, t) : std::min(t1, t);
        return t0 <= t1;
    };
    return clip(-dx, seen->from.x - rect.x0) && clip(dx, rect.x1 - seen->from.x) && clip(-dy, seen->from.y - rect.y0) &&
           clip(dy, rect.y1 - seen->from.y);
}

}  // namespace emca::explorer
