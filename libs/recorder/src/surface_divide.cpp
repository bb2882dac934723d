// When a triangle divides into four.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "emca/core/surface_tree.h"
#include "surface_store.h"

namespace emca::detail {

/// Divides the triangle of a node, which contains the point of the record, unless that is not to be.
void SurfaceStore::divide(SurfaceShard& shard, SurfaceNode* node, const std::uint32_t* record) {
    node->points |= SurfaceNode::kFinal;
    const std::uint32_t face = record[0];
    std::uint32_t path = record[1], level = 0;
    SurfaceRef* slot = slotOf(face);
    assert(slot->kind() != SurfaceRef::table);  // triangles divide at once or have tables
    for (; slot->kind() == SurfaceRef::inner; path = below(path), ++level) slot = slot->children() + firstChild(path);
    const std::uint32_t which = firstChild(path);
    level += slot->kind() == SurfaceRef::leaves;
    assert(slot->end(which, nodeBytes_) == node);
    if (mayDivide(face, level) && !divide(shard, *slot, which)) bump(shard.refused, 1);
}

/// False beyond the budget.
bool SurfaceStore::divide(SurfaceShard& shard, SurfaceRef& ref, std::uint32_t which) {
    SurfaceNode* node = ref.end(which, nodeBytes_);
    SurfaceRef* four = nullptr;
    if (ref.kind() == SurfaceRef::leaves) {  // its three siblings stay as they are
        four = reinterpret_cast<SurfaceRef*>(allocate(shard.memory, 4 * sizeof(SurfaceRef)));
        if (four == nullptr) return false;
        for (std::uint32_t i = 0; i < 4; ++i) four[i] = {ref.end(i, nodeBytes_), SurfaceRef::leaf};
    }
    SurfaceNode* nodes = allocateNodes(shard.memory, 4, sizeof(SurfaceNode*));
    if (nodes == nullptr) return false;
    *SurfaceRef::parentOf(nodes, nodeBytes_) = node;
    const SurfaceRef divided(nodes, SurfaceRef::leaves);
    if (four == nullptr) {
        ref = divided;
    } else {
        four[which] = divided;
        ref = SurfaceRef(four, SurfaceRef::inner);
    }
    return true;
}

bool SurfaceStore::mayDivide(std::uint32_t face, std::uint32_t level) const {
    if (level >= options_.maximumLevel) return false;
    const std::uint32_t mesh = meshOf(face);
    const double whole = area(mesh, static_cast<std::uint32_t>(face - faceStarts_[mesh]));
    const double childArea = std::ldexp(whole, -2 * static_cast<int>(level + 1));
    return childArea > 0 && childArea >= minimumArea_;
}

/// Of all faces that have one, with the face.
template <typename Visit>
void SurfaceStore::forEachRoot(Visit visit) {
    for (std::uint64_t page = 0; storesFaces_ && page << pageBits_ < faceCount_; ++page) {
        if (pages_[page] == nullptr) continue;
        const std::uint64_t end = std::min((page + 1) << pageBits_, faceCount_);
        for (std::uint64_t face = page << pageBits_; face < end; ++face)
            if (SurfaceRef* slot = slotOf(static_cast<std::uint32_t>(face)); *slot) visit(*slot, static_cast<std::uint32_t>(face));
    }
}

void SurfaceStore::divideAll(double part) {
    flush();
    pointsToDivide_ = SurfaceNode::kFinal;
    const double growth = part > 0 ? 1 / part : 1;
    forEachRoot([&](SurfaceRef& root, std::uint32_t face) {
        if (root.kind() == SurfaceRef::table) freeTables_[root.levels()].push_back(root.entries());
        root = root.tree();
        divideBelow(root, face, 0, 0, growth);
    });
    // Last, so that tables stand side by side, and in the place of old ones.
    forEachRoot([&](SurfaceRef& root, std::uint32_t) { makeTable(root); });
}

namespace {

constexpr std::uint32_t kFewestTableLevels = 2;

/// References at which the way down ends.
std::uint64_t countEnds(SurfaceRef ref) {
    if (ref.ends()) return 1;
    std::uint64_t ends = 0;
    for (std::uint32_t i = 0; i < 4; ++i) ends += countEnds(ref.children()[i]);
    return ends;
}

void fillTable(SurfaceRef ref, std::size_t nodeBytes, std::span<SurfaceRef> entries) {
    if (entries.size() == 1 || ref.kind() == SurfaceRef::leaf) return std::fill(entries.begin(), entries.end(), ref);
    const std::size_t quarter = entries.size() / 4;
    for (std::uint32_t i = 0; i < 4; ++i) fillTable(ref.child(i, nodeBytes), nodeBytes, entries.subspan(i * quarter, quarter));
}

}  // namespace

/// Of what is divided often enough, if there is room: at most two entries for each end of a way.
void SurfaceStore::makeTable(SurfaceRef& ref) {
    const std::uint64_t most = 2 * countEnds(ref);
    std::uint32_t levels = 0;
    while (levels < kMostTableLevels && std::uint64_t(4) << 2 * levels <= most) ++levels;
    if (levels < kFewestTableLevels) return;
    SurfaceRef* entries = newTable(levels);
    if (entries == nullptr) return;
    entries[-1] = ref;
    fillTable(ref, nodeBytes_, {entries, std::size_t(1) << 2 * levels});
    ref = SurfaceRef::tableOf(entries, levels);
}

/// Entries behind the reference that they stand for, and what aligns them; null beyond the budget.
SurfaceRef* SurfaceStore::newTable(std::uint32_t levels) {
    std::vector<SurfaceRef*>& old = freeTables_[levels];
    if (!old.empty()) {
        SurfaceRef* entries = old.back();
        old.pop_back();
        return entries;
    }
    const std::size_t bytes = ((std::size_t(1) << 2 * levels) + 1) * sizeof(SurfaceRef) + 64;
    std::byte* memory = allocate(tables_, bytes);
    if (memory == nullptr) return nullptr;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory) + sizeof(SurfaceRef);
    return reinterpret_cast<SurfaceRef*>((begin + 63) / 64 * 64);
}

/// \param inherited  points that came before the triangle was divided off, were they spread evenly
void SurfaceStore::divideBelow(SurfaceRef& ref, std::uint32_t face, std::uint32_t level, double inherited,
                               double growth) {
    SurfaceShard& shard = shards_[shardOf(face)];
    const auto consider = [&](SurfaceRef& at, std::uint32_t which, std::uint32_t itsLevel, double above) {
        SurfaceNode* node = at.end(which, nodeBytes_);
        const double own = double(points(node)), all = own + above;
        // As many as a face has that divides at once: its own and a third of that, which it got from those above. Where
        // few are its own, what is above went to its siblings.
        if (3 * all * growth < 4 * double(options_.samplesPerDivision) || 8 * own < all || node->isFinal())
            return;
        node->points |= SurfaceNode::kFinal;
        if (mayDivide(face, itsLevel) && !divide(shard, at, which)) bump(shard.refused, 1);
    };
    if (ref.kind() == SurfaceRef::leaf) return consider(ref, 0, level, inherited);
    const double each = (inherited + double(points(ref.own(nodeBytes_)))) / 4;
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (ref.kind() == SurfaceRef::leaves) {
            consider(ref, k, level + 1, each);  // which may make it an inner one
        } else {
            divideBelow(ref.children()[k], face, level + 1, each, growth);
        }
    }
}

}  // namespace emca::detail
