// From records to nodes. Random points on large scenes miss the cache at every step, so records are taken in groups whose
// loads overlap: all their faces, then level by level all their nodes, then all their sums. No atomic operation stands
// between them, since the shard belongs to this thread.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "emca/core/surface_tree.h"
#include "surface_store.h"

namespace emca::detail {

struct SurfaceStore::Lane {
    SurfaceNode* node;
    const std::uint32_t* record;
    std::uint32_t u, v, level;
};

namespace {

constexpr std::uint32_t kLanes = 16;  // more than the machine's outstanding misses gains nothing

inline void prefetchForWriting(const void* address) { __builtin_prefetch(address, 1, 3); }

inline void bump(std::atomic<std::uint64_t>& counter, std::uint64_t by) {
    counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

}  // namespace

SurfaceNode* const SurfaceStore::kFinal = reinterpret_cast<SurfaceNode*>(std::uintptr_t(1));

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
    const std::uint32_t* record = block.data();
    const std::uint32_t count = block.words / recordWords_;
    Lane lanes[kLanes];
    std::uint64_t points = 0;
    for (std::uint32_t done = 0; done < count; done += kLanes) {
        const std::uint32_t lanesUsed = std::min(kLanes, count - done);
        points += enter(shard, record, lanesUsed, lanes);
        record += std::size_t(lanesUsed) * recordWords_;
        if (storesFaces_)
            for (std::uint32_t i = 0, ahead = std::min(kLanes, count - done - lanesUsed); i < ahead; ++i) {
                const std::uint32_t face = record[std::size_t(i) * recordWords_];
                if (const Page* page = pages_[face >> pageBits_])
                    __builtin_prefetch(&page->roots[face & ((1u << pageBits_) - 1)]);
            }
        // Where a lane ends cannot be predicted, so lanes that are done stand still while the others go on.
        for (bool any = true; any;) {
            any = false;
            for (std::uint32_t i = 0; i < lanesUsed; ++i) {
                Lane& lane = lanes[i];
                SurfaceNode* children = lane.node->children;
                const bool go = children > kFinal;
                std::uint32_t u = lane.u, v = lane.v;
                const std::uint32_t which = descend(u, v);
                // As a number: where there are no children, this is no address.
                const std::uintptr_t below = reinterpret_cast<std::uintptr_t>(children) + which * nodeBytes_;
                lane.node = go ? reinterpret_cast<SurfaceNode*>(below) : lane.node;
                lane.u = go ? u : lane.u;
                lane.v = go ? v : lane.v;
                lane.level += go;
                any |= go;
                prefetchForWriting(lane.node);
            }
        }
        for (std::uint32_t i = 0; i < lanesUsed; ++i)
            for (std::size_t line = 64; line < nodeBytes_; line += 64)
                prefetchForWriting(reinterpret_cast<std::byte*>(lanes[i].node) + line);
        for (std::uint32_t i = 0; i < lanesUsed; ++i) addRecord(shard, lanes[i]);
    }
    bump(shard.points, points);
}

/// From records to the nodes of their faces. Returns how many count as points.
std::uint32_t SurfaceStore::enter(SurfaceShard& shard, const std::uint32_t* record, std::uint32_t count, Lane* lanes) {
    std::uint32_t points = 0, coarse = 0;
    for (std::uint32_t i = 0; i < count; ++i, record += recordWords_) {
        const std::uint32_t face = record[0], counted = !(record[2] & kNotCounted);
        SurfaceNode* node = nullptr;
        if (storesFaces_)
            if (const Page* page = pages_[face >> pageBits_]) node = page->roots[face & ((1u << pageBits_) - 1)];
        bool isBin = false;
        if (node == nullptr) [[unlikely]] {
            node = rootOrBin(shard, face);
            isBin = bins_[run(face)] == node;
        }
        prefetchForWriting(node);
        lanes[i] = {node, record, record[1], record[2] & ~kNotCounted, 0};
        points += counted;
        coarse += counted & isBin;
    }
    if (coarse > 0) bump(shard.coarse, coarse);
    return points;
}

void SurfaceStore::addRecord(SurfaceShard& shard, Lane& lane) {
    SurfaceNode* node = lane.node;
    const std::uint32_t* record = lane.record;
    node->points += !(record[2] & kNotCounted);
    const SurfaceLayerLayout* layers = layouts_.data();
    for (const std::uint16_t maskWord : maskWords_) {
        for (std::uint32_t mask = record[maskWord]; mask != 0; mask &= mask - 1) {
            const SurfaceLayerLayout& layer = layers[std::countr_zero(mask)];
            auto* cellOf = cell<SurfaceCell>(node, layer);
            ++cellOf->count;
            const std::uint32_t* value = record + layer.valueWord;
            cellOf->sums[0] += double(std::bit_cast<float>(value[0]));
            if (layer.channels == 3) {
                double* sums = cellOf->sums;
                sums[1] += double(std::bit_cast<float>(value[1]));
                sums[2] += double(std::bit_cast<float>(value[2]));
            }
        }
        layers += 32;
    }
    if (node->points >= options_.samplesPerDivision && node->children == nullptr) [[unlikely]]
        divide(shard, node, record[0], lane.level);
}

void SurfaceStore::divide(SurfaceShard& shard, SurfaceNode* node, std::uint32_t face, std::uint32_t level) {
    node->children = kFinal;
    if (level >= options_.maximumLevel) return;
    const std::uint32_t mesh = meshOf(face);
    const double childArea = std::ldexp(area(mesh, static_cast<std::uint32_t>(face - faceStarts_[mesh])),
                                        -2 * static_cast<int>(level + 1));
    if (!(childArea > 0) || childArea < minimumArea_) return;
    if (std::byte* children = allocate(shard, 4 * nodeBytes_))
        node->children = reinterpret_cast<SurfaceNode*>(children);
    else
        bump(shard.refused, 1);
}

SurfaceNode* SurfaceStore::rootOrBin(SurfaceShard& shard, std::uint32_t face) {
    if (storesFaces_) {
        Page*& page = pages_[face >> pageBits_];
        if (page == nullptr) page = reinterpret_cast<Page*>(allocate(shard, pageBytes_));
        if (page != nullptr) {
            SurfaceNode*& slot = page->roots[face & ((1u << pageBits_) - 1)];
            if (slot == nullptr) slot = reinterpret_cast<SurfaceNode*>(allocate(shard, nodeBytes_));
            if (slot != nullptr) return slot;
        }
    }
    return binOf(face);
}

SurfaceNode* SurfaceStore::binOf(std::uint32_t face) {
    SurfaceNode*& slot = bins_[run(face)];
    if (slot == nullptr) {
        // The budget was divided with room for it.
        slot = static_cast<SurfaceNode*>(::operator new(nodeBytes_));
        std::memset(static_cast<void*>(slot), 0, nodeBytes_);
        slot->children = kFinal;
        addUsed(nodeBytes_);
    }
    return slot;
}

}  // namespace emca::detail
