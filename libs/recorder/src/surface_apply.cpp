// From records to nodes. Random points on large scenes miss the cache at every step, so records are taken in groups whose
// loads overlap: all their faces, then level by level all their nodes, then all their sums. No atomic operation stands
// between them, since the shard belongs to this thread.
#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>

#include "emca/core/surface_tree.h"
#include "surface_store.h"

namespace emca::detail {

struct SurfaceStore::Lane {
    SurfaceRef* slot;  ///< first the one of the face, then of what is below it
    SurfaceNode* node;
    const std::uint32_t* record;
    std::uint32_t path;
};

namespace {

constexpr std::uint32_t kLanes = 16;  // more than the machine's outstanding misses gains nothing

inline void prefetchForWriting(const void* address) { __builtin_prefetch(address, 1, 3); }

}  // namespace

void SurfaceStore::submit(SurfaceBlock* block, std::uint32_t index) {
    SurfaceShard& shard = shards_[index];
    block->next = shard.waiting.load(std::memory_order_relaxed);
    while (!shard.waiting.compare_exchange_weak(block->next, block, std::memory_order_seq_cst,
                                                std::memory_order_relaxed)) {
    }
    applyWaiting(shard);
}

void SurfaceStore::applyWaiting(SurfaceShard& shard) {
    // Sequentially consistent: either the owner, looking again after it let go, sees a block that was just pushed, or who
    // pushed it sees that there is no owner any more.
    while (shard.waiting.load(std::memory_order_seq_cst) != nullptr) {
        if (shard.busy.exchange(true, std::memory_order_seq_cst)) return;
        SurfaceBlock* block = shard.waiting.exchange(nullptr, std::memory_order_acquire);
        while (block != nullptr) {
            SurfaceBlock* next = block->next;
            apply(shard, *block);
            std::atomic<SurfaceBlock*>& returned = block->home->returned;
            block->next = returned.load(std::memory_order_relaxed);
            while (!returned.compare_exchange_weak(block->next, block, std::memory_order_release,
                                                   std::memory_order_relaxed)) {
            }
            block = next;
        }
        shard.busy.store(false, std::memory_order_seq_cst);
    }
}

bool SurfaceStore::help() {
    bool found = false;
    for (std::uint32_t i = 0; i < shardCount_; ++i) {
        if (shards_[i].waiting.load(std::memory_order_relaxed) == nullptr) continue;
        if (shards_[i].busy.load(std::memory_order_relaxed)) continue;
        applyWaiting(shards_[i]);
        found = true;
    }
    return found;
}

void SurfaceStore::apply(SurfaceShard& shard, SurfaceBlock& block) {
    const std::uint32_t words = recordWords(), count = block.words / words;
    const std::uint32_t groups = (count + kLanes - 1) / kLanes;
    const auto begin = [&](std::uint32_t group) { return block.data() + std::size_t(group) * kLanes * words; };
    const auto size = [&](std::uint32_t group) { return std::min(kLanes, count - group * kLanes); };
    // Four groups at once, each a step behind the next: what one step asks for has the time of the three others to come.
    // A triangle that divides in between keeps what the later groups found it for, as it does with points of other threads.
    Lane lanes[4][kLanes];
    for (std::uint32_t step = 0; step < groups + 3; ++step) {
        if (step < groups) findFaces(begin(step), size(step), lanes[step % 4]);
        if (const std::uint32_t group = step - 1; group < groups) leaveFaces(shard, size(group), lanes[group % 4]);
        if (const std::uint32_t group = step - 2; group < groups) findNodes(size(group), lanes[group % 4]);
        if (const std::uint32_t group = step - 3; group < groups) addRecords(shard, size(group), lanes[group % 4]);
    }
}

/// What the faces of records are found by.
void SurfaceStore::findFaces(const std::uint32_t* record, std::uint32_t count, Lane* lanes) const {
    for (std::uint32_t i = 0, words = recordWords(); i < count; ++i, record += words) {
        SurfaceRef* slot = slotOf(record[0]);
        if (slot != nullptr) __builtin_prefetch(slot);
        lanes[i] = {slot, nullptr, record, record[1]};
    }
}

/// The first step down, where a face is divided.
void SurfaceStore::leaveFaces(SurfaceShard& shard, std::uint32_t count, Lane* lanes) {
    for (std::uint32_t i = 0; i < count; ++i) {
        Lane& lane = lanes[i];
        if (lane.slot == nullptr || !*lane.slot) [[unlikely]]
            lane.slot = newSlot(shard, lane.record);
        if (!lane.slot->ends()) step(lane);
    }
}

/// From there to the nodes of the smallest triangles that contain the points, level by level: what is prefetched in one
/// round is there in the next.
void SurfaceStore::findNodes(std::uint32_t count, Lane* lanes) const {
    std::uint32_t active[kLanes], left = count;
    std::iota(active, active + count, 0u);
    while (left > 0) {
        std::uint32_t still = 0;
        for (std::uint32_t k = 0; k < left; ++k) {
            active[still] = active[k];
            still += descend(lanes[active[k]]);
        }
        left = still;
    }
}

/// One step down, to the next reference or to the node. False at the end.
inline bool SurfaceStore::descend(Lane& lane) const {
    const SurfaceRef ref = *lane.slot;
    if (ref.ends()) [[likely]] {
        lane.node = ref.end(firstChild(lane.path), nodeBytes_);
        for (std::size_t line = 0; line < nodeBytes_; line += 64)
            prefetchForWriting(reinterpret_cast<std::byte*>(lane.node) + line);
        return false;
    }
    step(lane);
    return true;
}

/// To the reference below one that does not end.
inline void SurfaceStore::step(Lane& lane) const {
    const SurfaceRef ref = *lane.slot;
    const bool jumps = ref.kind() == SurfaceRef::table;
    const std::uint32_t levels = jumps ? ref.levels() : 1;
    lane.slot = (jumps ? ref.entries() : ref.children()) + (lane.path >> (32 - 2 * levels));
    lane.path <<= 2 * levels;
    __builtin_prefetch(lane.slot);
}

/// Adds the values of one mask, whose bit 0 belongs to `layout`.
inline void SurfaceStore::addValues(SurfaceNode* node, const std::uint32_t* values, std::uint32_t mask,
                                    const SurfaceLayerLayout* layout) {
    for (; mask != 0; mask &= mask - 1) {
        const SurfaceLayerLayout& layer = layout[std::countr_zero(mask)];
        auto* count = inNode<std::uint32_t>(node, layer.count);
        if (++*count == 0) [[unlikely]] spill(count, std::uint64_t(1) << 32);
        const std::uint32_t* value = values + layer.valueWord;
        auto* sums = inNode<double>(node, layer.sums);
        sums[0] += double(std::bit_cast<float>(value[0]));
        if (layer.channels == 3) {
            sums[1] += double(std::bit_cast<float>(value[1]));
            sums[2] += double(std::bit_cast<float>(value[2]));
        }
    }
}

void SurfaceStore::addRecords(SurfaceShard& shard, std::uint32_t count, const Lane* lanes) {
    std::uint64_t points = 0;
    for (std::uint32_t i = 0; i < count; ++i) points += addRecord(shard, lanes[i]);
    bump(shard.points, points);
}

/// How many points it counts as.
inline std::uint32_t SurfaceStore::addRecord(SurfaceShard& shard, const Lane& lane) {
    SurfaceNode* node = lane.node;
    const std::uint32_t* values = lane.record + kPlaceWords;
    const std::uint32_t mask = values[0], counted = ~mask & kSurfaceNotCounted;
    const std::uint32_t points = node->points += counted;
    const SurfaceLayerLayout* layouts = layouts_.data();
    addValues(node, values, mask >> kFirstMaskFlags, layouts);
    for (std::size_t i = 1; i < maskWords_.size(); ++i)
        addValues(node, values, values[maskWords_[i]], layouts + 32 * i - kFirstMaskFlags);
    if (points & SurfaceNode::kFull) [[unlikely]] {
        node->points -= SurfaceNode::kFull;
        spill(&node->points, SurfaceNode::kFull);
    }
    if (points >= pointsToDivide_ && points < SurfaceNode::kFinal) [[unlikely]]
        divide(shard, node, lane.record);
    return counted;
}

SurfaceRef* SurfaceStore::slotOf(std::uint32_t face) const {
    if (!storesFaces_) return nullptr;
    Page* page = pages_[face >> pageBits_];
    return page == nullptr ? nullptr : &page->roots[face & ((1u << pageBits_) - 1)];
}

/// For a record whose face has none yet, which may meanwhile have got it.
SurfaceRef* SurfaceStore::newSlot(SurfaceShard& shard, const std::uint32_t* record) {
    if (SurfaceRef* slot = slotOf(record[0]); slot != nullptr && *slot) return slot;
    if (SurfaceRef* slot = newRoot(shard, record[0])) return slot;
    bump(shard.coarse, ~record[kPlaceWords] & kSurfaceNotCounted);
    return binOf(record[0]);
}

SurfaceRef* SurfaceStore::newRoot(SurfaceShard& shard, std::uint32_t face) {
    if (!storesFaces_ || shard.full) return nullptr;
    Page*& page = pages_[face >> pageBits_];
    if (page == nullptr) page = reinterpret_cast<Page*>(allocate(shard.memory, pageBytes_));
    if (page == nullptr) return nullptr;
    SurfaceNode* node = allocateNodes(shard.memory, 1);
    if (node == nullptr) {
        shard.full = true;  // from here on, half of all samples may come this way
        return nullptr;
    }
    SurfaceRef* slot = slotOf(face);
    *slot = SurfaceRef(node, SurfaceRef::leaf);
    return slot;
}

SurfaceRef* SurfaceStore::binOf(std::uint32_t face) {
    SurfaceRef& slot = bins_[run(face)];
    if (!slot) {
        // The budget was divided with room for it.
        auto* node = static_cast<SurfaceNode*>(::operator new(nodeBytes_));
        std::memset(static_cast<void*>(node), 0, nodeBytes_);
        node->points = SurfaceNode::kFinal;
        slot = SurfaceRef(node, SurfaceRef::leaf);
        addUsed(nodeBytes_);
    }
    return &slot;
}

}  // namespace emca::detail
