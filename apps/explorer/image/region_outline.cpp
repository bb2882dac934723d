#include "image/region_outline.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace emca::explorer {
namespace {

using Interval = std::pair<std::uint32_t, std::uint32_t>;   ///< columns from first to before second

/// Parts that lie in one of the two rows alone: the edges between them. Both ascend and do not touch.
void appendDifference(std::span<const Interval> above, std::span<const Interval> below, std::vector<Interval>& out) {
    std::vector<std::uint32_t> ends;   // each end changes whether a row holds the column; two at one place cancel
    for (const auto& row : {above, below})
        for (const auto& [first, last] : row) ends.insert(ends.end(), {first, last});
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size();) {
        if (ends[i] == ends[i + 1]) {
            i += 2;
            continue;
        }
        const std::uint32_t first = ends[i];
        std::size_t next = i + 1;
        // The stretch goes on where one row's run ends as the other's begins.
        while (next + 2 < ends.size() && ends[next] == ends[next + 1]) next += 2;
        out.emplace_back(first, ends[next]);
        i = next + 1;
    }
}

}  // namespace

std::vector<QLineF> regionOutline(std::span<const Pixel> pixels) {
    std::vector<QLineF> lines;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;   // (column, row) of vertical edges
    std::vector<Interval> above, row, edges;
    const auto horizontal = [&](std::uint32_t y) {
        edges.clear();
        appendDifference(above, row, edges);
        for (const auto& [first, last] : edges) lines.push_back(QLineF(first, y, last, y));
    };
    std::uint32_t y = 0;
    for (std::size_t i = 0; i < pixels.size();) {
        if (!above.empty() && pixels[i].y != y + 1) {
            row.clear();
            horizontal(y + 1);
            above.clear();
        }
        y = pixels[i].y;
        row.clear();
        for (; i < pixels.size() && pixels[i].y == y; ++i) {
            if (!row.empty() && row.back().second == pixels[i].x) ++row.back().second;
            else row.emplace_back(pixels[i].x, pixels[i].x + 1);
        }
        for (const auto& [first, last] : row) sides.insert(sides.end(), {{first, y}, {last, y}});
        horizontal(y);
        std::swap(above, row);
    }
    row.clear();
    horizontal(y + 1);
    std::sort(sides.begin(), sides.end());
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t next = i + 1;
        while (next < sides.size() && sides[next].first == sides[i].first && sides[next].second == sides[next - 1].second + 1) ++next;
        lines.push_back(QLineF(sides[i].first, sides[i].second, sides[i].first, sides[next - 1].second + 1));
        i = next;
    }
    return lines;
}

}  // namespace emca::explorer
