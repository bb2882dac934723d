// How the budget is divided, and where nodes come from.
#include "surface_store.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>
#include <utility>

#include "emca/core/surface_tree.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace emca::detail {
namespace {

constexpr std::size_t kSlabBytes = 2u << 20;  // one huge page, where the system has them
constexpr std::size_t kMaximumChunkBytes = 32u << 10;
constexpr std::uint32_t kMaximumShards = 256;
constexpr std::size_t kMaximumBlockBytes = 4096;

constexpr std::size_t roundUp(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

/// Memory whose pages the system makes as large as it can: nodes are visited in no order.
std::byte* newSlab(std::size_t bytes) {
    const std::size_t alignment = bytes % kSlabBytes == 0 ? kSlabBytes : 64;
    void* memory = std::aligned_alloc(alignment, roundUp(bytes, alignment));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (memory != nullptr && alignment == kSlabBytes) (void)::madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<std::byte*>(memory);
}

}  // namespace

SurfaceStore::SurfaceStore(std::vector<SurfaceMeshView> meshes, SurfaceOptions options)
    : meshes_(std::move(meshes)), options_(options) {
    options_.samplesPerDivision = std::max(1u, options_.samplesPerDivision);
    pointsToDivide_ = std::min(options_.samplesPerDivision, SurfaceNode::kFull - 1);
    options_.maximumLevel = std::min(options_.maximumLevel, kMaxSurfaceLevel);
}

SurfaceStore::~SurfaceStore() {
    for (std::uint64_t i = 0; i < slabCount_; ++i) std::free(slabs_[i].load(std::memory_order_relaxed));
    for (std::uint64_t i = 0; i < runCount_; ++i) ::operator delete(bins_[i].node());
}

const SurfaceLayerLayout& SurfaceStore::addLayer(LayerDescription description) {
    SurfaceLayerLayout layout;
    layout.channels = static_cast<std::uint8_t>(channelCount(description.kind));
    layout.bit = static_cast<std::uint8_t>((layouts_.size() + kFirstMaskFlags) % 32);
    if (layouts_.empty() || layout.bit == 0) maskWords_.push_back(static_cast<std::uint16_t>(valueWords_++));
    layout.maskWord = maskWords_.back();
    layout.valueWord = static_cast<std::uint16_t>(valueWords_);
    valueWords_ += layout.channels;
    descriptions_.push_back(std::move(description));
    return layouts_.emplace_back(layout);
}

void SurfaceStore::setUp() {
    faceStarts_.assign(1, 0);
    BoundingBox box;
    for (const SurfaceMeshView& mesh : meshes_) {
        faceStarts_.push_back(faceStarts_.back() + mesh.triangles.size());
        if (options_.minimumEdge < 0)
            for (const Vec3f p : mesh.positions) box.extend(p);
    }
    faceCount_ = faceStarts_.back();
    const double edge = options_.minimumEdge < 0 ? double(box.diagonal()) / 8192 : double(options_.minimumEdge);
    minimumArea_ = edge * edge;
    layOutNodes();
    divideBudget();
    shards_ = std::make_unique<SurfaceShard[]>(shardCount_);
}

void SurfaceStore::layOutNodes() {
    nodeBytes_ = sizeof(SurfaceNode);
    const auto place = [&](std::size_t bytes) { return static_cast<std::uint32_t>(std::exchange(nodeBytes_, nodeBytes_ + bytes)); };
    for (SurfaceLayerLayout& layer : layouts_) layer.count = place(sizeof(std::uint32_t));
    nodeBytes_ = roundUp(nodeBytes_, sizeof(double));
    for (SurfaceLayerLayout& layer : layouts_) layer.sums = place(layer.channels * sizeof(double));
    // A node never straddles more cache lines than it must.
    nodeBytes_ = nodeBytes_ <= 64 ? std::bit_ceil(nodeBytes_) : roundUp(nodeBytes_, 32);
    nodeAlignment_ = std::min<std::size_t>(64, nodeBytes_ & (~nodeBytes_ + 1));
}

void SurfaceStore::spill(const std::uint32_t* counter, std::uint64_t amount) {
    const std::lock_guard lock(spilledMutex_);
    spilled_[counter] += amount;
}

void SurfaceStore::divideBudget() {
    const std::size_t budget = options_.budgetBytes;
    // Blocks: what all threads may hold back, and as much on the way.
    const std::size_t threads = 2 * std::max(1u, std::thread::hardware_concurrency());
    const std::size_t leastBlock =
        roundUp(sizeof(SurfaceBlock) + sizeof(std::uint32_t) * (4 * std::size_t(kPlaceWords + valueWords_) + kCopyWords), 64);
    // Enough that threads seldom meet, few enough that the open blocks stay in the cache.
    shardCount_ = std::min(kMaximumShards, std::bit_ceil(static_cast<std::uint32_t>(4 * threads)));
    blockBytes_ = std::max(kMaximumBlockBytes, leastBlock);
    const auto forThreads = [&] { return threads * 2 * shardCount_ * blockBytes_; };
    while (forThreads() > budget / 8 && (shardCount_ > 1 || blockBytes_ > leastBlock)) {
        if (blockBytes_ > std::max<std::size_t>(leastBlock, 512) && shardCount_ <= 16)
            blockBytes_ = std::max(leastBlock, roundUp(blockBytes_ / 2, 64));
        else if (shardCount_ > 1)
            shardCount_ /= 2;
        else
            blockBytes_ = leastBlock;
    }
    logRecords_ = kMaximumLogRecords;
    while (threads * logBytes() > budget / 32 && logRecords_ > 4) logRecords_ /= 2;
    // The table of faces: pages of neighbouring faces, many enough to spread over the shards.
    const std::uint64_t perShard = faceCount_ / (16 * shardCount_);
    pageBits_ = std::min(6u, perShard > 0 ? static_cast<std::uint32_t>(std::bit_width(perShard)) - 1 : 0u);
    pageBytes_ = sizeof(SurfaceRef) << pageBits_;
    const std::uint64_t pageCount = (faceCount_ + (std::uint64_t(1) << pageBits_) - 1) >> pageBits_;
    storesFaces_ = pageCount * sizeof(Page*) <= budget / 8;
    // Bins that are always there, so that no sample can be lost.
    const auto runs = [&] { return (pageCount + (std::uint64_t(1) << runBits_) - 1) >> runBits_; };
    while (runs() > 1 && runs() * (nodeBytes_ + sizeof(SurfaceRef)) > budget / 16) ++runBits_;
    runCount_ = runs();
    shardShift_ = pageBits_ + runBits_;
    bins_ = std::make_unique<SurfaceRef[]>(std::max<std::uint64_t>(1, runCount_));
    addUsed(runCount_ * sizeof(SurfaceRef));
    std::size_t taken = forThreads() + threads * logBytes() + runCount_ * (nodeBytes_ + sizeof(SurfaceRef));
    if (storesFaces_) {
        pages_ = std::make_unique<Page*[]>(std::max<std::uint64_t>(1, pageCount));
        addUsed(pageCount * sizeof(Page*));
        taken += pageCount * sizeof(Page*);
    }
    // All the rest is for nodes.
    const std::size_t nodes = storesFaces_ && budget > taken ? budget - taken : 0;
    const std::size_t leastChunk = roundUp(std::max(4 * nodeBytes_ + sizeof(SurfaceNode*), pageBytes_) + nodeAlignment_, 64);
    chunkBytes_ = std::max(leastChunk, std::min(kMaximumChunkBytes, nodes / (8 * shardCount_) / 64 * 64));
    chunkCount_ = nodes / chunkBytes_;
    chunksPerSlab_ = std::max<std::uint64_t>(1, std::min<std::uint64_t>(kSlabBytes / chunkBytes_, chunkCount_ / 8));
    slabCount_ = chunkCount_ / chunksPerSlab_;
    chunkCount_ = slabCount_ * chunksPerSlab_;
    slabs_ = std::make_unique<std::atomic<std::byte*>[]>(std::max<std::uint64_t>(1, slabCount_));
}

std::byte* SurfaceStore::allocate(SurfaceArena& arena, std::size_t bytes, std::size_t alignment) {
    const auto gap = [&] { return (~reinterpret_cast<std::uintptr_t>(arena.free) + 1) & (alignment - 1); };
    const auto left = static_cast<std::size_t>(arena.end - arena.free);
    if (left < gap() + bytes && !nextChunks(arena, bytes)) return nullptr;
    std::byte* memory = arena.free + gap();
    arena.free = memory + bytes;
    return memory;
}

SurfaceNode* SurfaceStore::allocateNodes(SurfaceArena& arena, std::size_t count, std::size_t more) {
    return reinterpret_cast<SurfaceNode*>(allocate(arena, count * nodeBytes_ + more, nodeAlignment_));
}

/// Room for so many bytes, however they are aligned: one chunk for all but tables. What is left of the last is lost, unless
/// the next follows it.
bool SurfaceStore::nextChunks(SurfaceArena& arena, std::size_t bytes) {
    const std::uint64_t count = std::max<std::uint64_t>(1, (bytes + chunkBytes_ - 1) / chunkBytes_);
    if (count > chunksPerSlab_ || nextChunk_.load(std::memory_order_relaxed) + count > chunkCount_) return false;
    std::uint64_t chunk = nextChunk_.fetch_add(count, std::memory_order_relaxed);
    if (chunk % chunksPerSlab_ + count > chunksPerSlab_) {  // never across slabs; several are taken while no thread records
        chunk = (chunk / chunksPerSlab_ + 1) * chunksPerSlab_;
        nextChunk_.store(chunk + count, std::memory_order_relaxed);
    }
    if (chunk + count > chunkCount_) return false;
    std::atomic<std::byte*>& slab = slabs_[chunk / chunksPerSlab_];
    std::byte* memory = slab.load(std::memory_order_acquire);
    if (memory == nullptr) {
        const std::size_t slabBytes = chunksPerSlab_ * chunkBytes_;
        std::byte* fresh = newSlab(slabBytes);
        if (fresh == nullptr) return false;  // the machine has less than the budget promised
        if (slab.compare_exchange_strong(memory, fresh, std::memory_order_acq_rel)) {
            memory = fresh;
            addUsed(slabBytes);
        } else {
            std::free(fresh);  // another thread was faster
        }
    }
    std::byte* const first = memory + chunk % chunksPerSlab_ * chunkBytes_;
    if (first != arena.end || chunk % chunksPerSlab_ == 0) arena.free = first;
    arena.end = first + count * chunkBytes_;
    std::memset(first, 0, count * chunkBytes_);
    return true;
}

std::uint32_t SurfaceStore::meshOf(std::uint32_t face) const {
    const auto after = std::upper_bound(faceStarts_.begin(), faceStarts_.end(), std::uint64_t(face));
    return static_cast<std::uint32_t>(after - faceStarts_.begin() - 1);
}

double SurfaceStore::area(std::uint32_t mesh, std::uint32_t face) const {
    const SurfaceMeshView& view = meshes_[mesh];
    const Triangle t = view.triangles[face];
    Vec3d p[3];
    for (int i = 0; i < 3; ++i) {
        if (t[i] >= view.positions.size()) return 0;
        const Vec3f q = view.positions[t[i]];
        p[i] = {double(q.x), double(q.y), double(q.z)};
    }
    const double area = 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
    return std::isfinite(area) ? area : 0;
}

Vec2f SurfaceStore::barycentrics(const SurfaceMeshView& view, const Triangle& t, Vec3f position) {
    const std::size_t count = view.positions.size();
    if (t[0] >= count || t[1] >= count || t[2] >= count) return {};
    // Doubles: in thin triangles single precision would move points by many faces of the subdivision.
    const auto wide = [](Vec3f q) { return Vec3d{double(q.x), double(q.y), double(q.z)}; };
    const Vec3d origin = wide(view.positions[t[0]]);
    const Vec3d e1 = wide(view.positions[t[1]]) - origin, e2 = wide(view.positions[t[2]]) - origin;
    const Vec3d d = wide(position) - origin;
    const double a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), p = dot(d, e1), q = dot(d, e2);
    const double scale = 1 / (a * c - b * b);
    const Vec2f weights{float((c * p - b * q) * scale), float((a * q - b * p) * scale)};
    return finiteBits(weights.x) && finiteBits(weights.y) ? weights : Vec2f{};
}

SurfaceRef SurfaceStore::root(std::uint32_t face) const {
    const SurfaceRef* slot = slotOf(face);
    return slot == nullptr ? SurfaceRef() : slot->tree();
}

SurfaceNode* SurfaceStore::rootForTest(std::uint32_t face) { return newRoot(shards_[shardOf(face)], face)->node(); }

SurfaceCounts SurfaceStore::counts() const {
    SurfaceCounts counts;
    for (std::uint32_t i = 0; i < shardCount_; ++i) {
        counts.points += shards_[i].points.load(std::memory_order_relaxed);
        counts.coarse += shards_[i].coarse.load(std::memory_order_relaxed);
        counts.refusedDivisions += shards_[i].refused.load(std::memory_order_relaxed);
    }
    {
        const std::lock_guard lock(cursorsMutex_);
        for (const auto& cursor : cursors_) counts.invalid += cursor->invalid.load(std::memory_order_relaxed);
    }
    counts.bytesUsed = bytesUsed_.load(std::memory_order_relaxed);
    counts.budgetBytes = options_.budgetBytes;
    return counts;
}

}  // namespace emca::detail
