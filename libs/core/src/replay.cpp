#include "emca/core/replay.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace emca {
namespace {

bool sameBits(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool nearby(float a, float b) {
    if (sameBits(a, b) || a == b) return true;
    if (!std::isfinite(a) || !std::isfinite(b)) return false;
    return std::abs(double(a) - double(b)) <= 1e-4 * std::max(std::abs(double(a)), std::abs(double(b)));
}

}  // namespace

Verdict compare(Color rendered, Color replayed) {
    if (sameBits(rendered.r, replayed.r) && sameBits(rendered.g, replayed.g) && sameBits(rendered.b, replayed.b))
        return Verdict::exact;
    if (nearby(rendered.r, replayed.r) && nearby(rendered.g, replayed.g) && nearby(rendered.b, replayed.b))
        return Verdict::close;
    return Verdict::different;
}

ReplayCounts countReplays(std::span<const Replay> replays) {
    ReplayCounts counts;
    counts.pixels = replays.size();
    for (const Replay& replay : replays) {
        switch (replay.verdict) {
            case Verdict::exact: ++counts.exact; break;
            case Verdict::close: ++counts.close; break;
            case Verdict::different: ++counts.different; break;
            case Verdict::unknown: ++counts.unknown; break;
        }
        counts.sumsDiffer += replay.sums == SumCheck::differs;
    }
    return counts;
}

Verdict ReplayCounts::worst() const {
    if (different > 0) return Verdict::different;
    if (close > 0) return Verdict::close;
    return exact > 0 ? Verdict::exact : Verdict::unknown;
}

}  // namespace emca
