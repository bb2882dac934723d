#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

#include "emca/recorder/surface_recorder.h"

namespace emca::detail {

struct SurfaceCursorImpl;

/// For counters that many read and one thread writes.
inline void bump(std::atomic<std::uint64_t>& counter, std::uint64_t by) {
    counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}

/// A triangle of the subdivision with what was added to it while it was not divided. Behind the points come a count for
/// each layer and then the layers' sums (doubles: a float stops counting at 2^24), so that a sample touches one or a few
/// neighbouring cache lines: the caches are shared with the renderer. Counters have 32 bits; what does not fit is in
/// SurfaceStore::spilled_. Only the owner of its shard reads or writes it.
struct SurfaceNode {
    static constexpr std::uint32_t kFinal = 1u << 31, kFull = 1u << 30;
    std::uint32_t points;  ///< kFinal: never divides (again)
    bool isFinal() const { return (points & kFinal) != 0; }
};

/// How a triangle is reached: where it ends, without a look at the nodes on the way, whose cache lines stay cold. Not
/// divided: its node. Divided into four that are not: those nodes, one after the other. Else: the four references of its
/// children. Zero: nothing yet. Behind four nodes of one triangle stands the address of that triangle's own.
///
/// Where nothing divides for a while, a face may have a table: an entry for each triangle `levels` below it, so that many
/// steps become one. An entry is what the way there ends at. In front of the entries stands what the table replaces.
class SurfaceRef {
  public:
    enum Kind : std::uintptr_t { inner = 0, leaf = 1, leaves = 2, table = 3 };
    SurfaceRef() = default;
    /// \param entries  64-byte aligned; behind the reference that the table replaces
    static SurfaceRef tableOf(const SurfaceRef* entries, std::uint32_t levels) {
        SurfaceRef ref(entries, table);
        ref.word_ |= std::uintptr_t(levels) << 2;
        return ref;
    }
    SurfaceRef(const void* target, Kind kind) : word_(reinterpret_cast<std::uintptr_t>(target) | kind) {}
    explicit operator bool() const { return word_ != 0; }
    Kind kind() const { return Kind(word_ & 3); }
    SurfaceNode* node() const { return reinterpret_cast<SurfaceNode*>(word_ & ~std::uintptr_t(3)); }  ///< leaf, leaves
    SurfaceRef* children() const { return reinterpret_cast<SurfaceRef*>(word_); }                       ///< inner
    /// Of a leaf itself, of leaves the child: without a branch, as it cannot be predicted.
    SurfaceNode* end(std::uint32_t which, std::size_t nodeBytes) const {
        return reinterpret_cast<SurfaceNode*>((word_ & ~std::uintptr_t(3)) + (word_ >> 1 & 1) * which * nodeBytes);
    }
    bool ends() const { return kind() == leaf || kind() == leaves; }
    std::uint32_t levels() const { return word_ >> 2 & 15; }                                           ///< table
    SurfaceRef* entries() const { return reinterpret_cast<SurfaceRef*>(word_ & ~std::uintptr_t(63)); }  ///< table
    /// Without the table.
    SurfaceRef tree() const { return kind() == table ? entries()[-1] : *this; }
    bool isDivided() const { return kind() != leaf; }
    SurfaceRef child(std::uint32_t which, std::size_t nodeBytes) const {
        return kind() == inner ? children()[which] : SurfaceRef(end(which, nodeBytes), leaf);
    }
    /// The triangle's own node.
    SurfaceNode* own(std::size_t nodeBytes) const {
        if (kind() == leaf) return node();
        const SurfaceNode* below = kind() == leaves ? node() : children()[0].own(nodeBytes);
        return *parentOf(below, nodeBytes);
    }
    /// Where the address of their parent stands. \param nodes  the first of four
    static SurfaceNode** parentOf(const SurfaceNode* nodes, std::size_t nodeBytes) {
        return reinterpret_cast<SurfaceNode**>(reinterpret_cast<std::uintptr_t>(nodes) + 4 * nodeBytes);
    }

  private:
    std::uintptr_t word_ = 0;
};

/// Where a layer is in nodes and in records.
struct SurfaceLayerLayout {
    std::uint32_t count = 0, sums = 0;  ///< byte offsets in a node; `channels` sums
    std::uint16_t maskWord = 0, valueWord = 0;  ///< of a record's values
    std::uint8_t bit = 0, channels = 1;
};

/// What a thread has to say about one point, in words of 32 bits: the face of all faces, its surfacePath(), then its
/// values: for each 32 layers (30 in the first) a mask that tells which are there, and room for all.
///
/// In the log it begins with the SurfacePlace instead. That becomes a path when the log is distributed, since the loads
/// that it takes overlap for many points there, and the renderer's own code stays short.
constexpr std::uint32_t kPlaceWords = 2;
constexpr std::uint32_t kNoFace = ~0u;         ///< faces beyond 2^32 - 1 of all meshes do not take part
constexpr std::uint32_t kFirstMaskFlags = 2;   ///< bits of the first mask
/// Records are copied so many words at a time: behind the last of a log or a block there is room for that.
constexpr std::uint32_t kCopyWords = 4;

constexpr std::uint32_t kMaximumLogRecords = 128;  ///< of a half: more than most paths have, few enough to stay in the cache

/// Records for one shard, on their way from the thread that made them to whoever applies them.
struct SurfaceBlock {
    SurfaceBlock* next;       ///< in the shard's list of waiting blocks, or in the home's list of free ones
    SurfaceCursorImpl* home;  ///< where it returns when its records are applied
    std::uint32_t words;      ///< used
    std::uint32_t* data() { return reinterpret_cast<std::uint32_t*>(this + 1); }
};

/// What is left of the chunk that memory is taken from, piece by piece.
struct SurfaceArena {
    std::byte* free = nullptr;
    std::byte* end = nullptr;
};

/// A part of all faces that one thread at a time may change. Handing over is a stack that anybody pushes to and the owner
/// takes as a whole; whoever pushes and finds no owner becomes it. Each thread goes on at once in either case.
struct alignas(64) SurfaceShard {
    std::atomic<SurfaceBlock*> waiting{nullptr};
    std::atomic<bool> busy{false};
    // The rest is the owner's. Counters are read by counts(), hence atomic; only the owner writes them.
    SurfaceArena memory;           ///< of new nodes
    bool full = false;             ///< not even a node is left for it
    std::atomic<std::uint64_t> points{0}, coarse{0}, refused{0};
};

/// Layout, memory and ownership of everything that a SurfaceRecorder collects.
class SurfaceStore {
  public:
    SurfaceStore(std::vector<SurfaceMeshView> meshes, SurfaceOptions options);
    ~SurfaceStore();
    SurfaceStore(const SurfaceStore&) = delete;

    /// Appends a layer. Not after setUp().
    const SurfaceLayerLayout& addLayer(LayerDescription description);
    /// Divides the budget, once all layers are known.
    void setUp();
    bool isSetUp() const { return shardCount_ > 0; }

    SurfaceCursorImpl* acquire();            ///< a cursor that no other thread uses
    void release(SurfaceCursorImpl* cursor);

    /// Hands a full block over, and applies what waits for the shard if nobody else does.
    void submit(SurfaceBlock* block, std::uint32_t shard);
    /// Applies waiting blocks of any shard that has no owner. False if there was nothing to do.
    bool help();
    /// Applies everything that threads hold back. No thread may be recording.
    void flush();
    /// See SurfaceRecorder::passDone.
    void divideAll(double part);

    /// Which shard a face belongs to: a small value, to have at hand where many are asked for.
    struct Sharding {
        std::uint32_t shift = 0, mask = 0;
        std::uint32_t of(std::uint32_t face) const {
            const auto run = static_cast<std::uint32_t>(std::uint64_t(face) >> shift);
            return (run ^ run >> 7 ^ run >> 13) & mask;
        }
    };
    Sharding sharding() const { return {shardShift_, shardCount_ - 1}; }
    std::uint32_t shardOf(std::uint32_t face) const { return sharding().of(face); }
    /// Mesh that a global face belongs to.
    std::uint32_t meshOf(std::uint32_t face) const;
    /// World-space area of a face of the scene; 0 if it has none or a vertex is missing or not finite.
    double area(std::uint32_t mesh, std::uint32_t face) const;
    /// Weights of the second and third vertex; those of the first vertex on a face that has no area.
    static Vec2f barycentrics(const SurfaceMeshView& mesh, const Triangle& triangle, Vec3f position);

    // For post-processing, while no thread records.
    SurfaceRef root(std::uint32_t face) const;
    const SurfaceNode* bin(std::uint32_t face) const { return binOfRun(run(face)); }
    std::uint64_t runCount() const { return runCount_; }
    const SurfaceNode* binOfRun(std::uint64_t index) const { return bins_[index].node(); }
    std::uint64_t run(std::uint32_t face) const { return std::uint64_t(face) >> (pageBits_ + runBits_); }
    std::uint64_t facesPerRun() const { return std::uint64_t(1) << (pageBits_ + runBits_); }
    /// Makes the root of a face exist, for tests that begin with full counters.
    SurfaceNode* rootForTest(std::uint32_t face);
    std::uint32_t* counterForTest(SurfaceNode* node, const SurfaceLayerLayout& layer) { return inNode<std::uint32_t>(node, layer.count); }

    std::uint64_t points(const SurfaceNode* node) const {
        return (node->points & ~SurfaceNode::kFinal) + spilled(&node->points);
    }
    std::uint64_t count(const SurfaceNode* node, const SurfaceLayerLayout& layer) const {
        const auto* counter = inNode<const std::uint32_t>(node, layer.count);
        return *counter + spilled(counter);
    }
    const double* sums(const SurfaceNode* node, const SurfaceLayerLayout& layer) const {
        return inNode<const double>(node, layer.sums);
    }

    SurfaceCounts counts() const;
    const SurfaceOptions& options() const { return options_; }
    const std::vector<SurfaceMeshView>& meshes() const { return meshes_; }
    const std::vector<std::uint64_t>& faceStarts() const { return faceStarts_; }  ///< per mesh, and the end
    const std::vector<LayerDescription>& descriptions() const { return descriptions_; }
    const std::vector<SurfaceLayerLayout>& layouts() const { return layouts_; }
    std::size_t nodeBytes() const { return nodeBytes_; }
    std::uint32_t valueWords() const { return valueWords_; }  ///< of a record
    std::uint32_t recordWords() const { return kPlaceWords + valueWords_; }  ///< in a block
    const std::vector<std::uint16_t>& maskWords() const { return maskWords_; }
    std::uint32_t shardCount() const { return shardCount_; }
    std::size_t blockBytes() const { return blockBytes_; }
    std::uint32_t logRecords() const { return logRecords_; }  ///< of one half
    std::size_t logBytes() const { return sizeof(std::uint32_t) * (2 * std::size_t(logRecords_) * (kSurfacePlaceWords + valueWords_) + kCopyWords); }
    std::uint32_t blocksPerCursor() const { return 2 * shardCount_; }
    void addUsed(std::size_t bytes) { bytesUsed_.fetch_add(bytes, std::memory_order_relaxed); }

  private:
    static constexpr std::uint32_t kMostTableLevels = 8;  ///< 512 KiB: below, triangles are small

    struct Page { SurfaceRef roots[1]; };
    struct Lane;

    template <typename T, typename Node>
    static T* inNode(Node* node, std::uint32_t offset) {
        using Byte = std::conditional_t<std::is_const_v<Node>, const std::byte, std::byte>;
        return reinterpret_cast<T*>(reinterpret_cast<Byte*>(node) + offset);
    }
    void spill(const std::uint32_t* counter, std::uint64_t amount);
    /// What a counter lacks. Not while threads record.
    std::uint64_t spilled(const std::uint32_t* counter) const {
        if (spilled_.empty()) [[likely]] return 0;
        const auto found = spilled_.find(counter);
        return found == spilled_.end() ? 0 : found->second;
    }
    void layOutNodes();
    void divideBudget();
    void applyWaiting(SurfaceShard& shard);
    void apply(SurfaceShard& shard, SurfaceBlock& block);
    void findFaces(const std::uint32_t* record, std::uint32_t count, Lane* lanes) const;
    void leaveFaces(SurfaceShard& shard, std::uint32_t count, Lane* lanes);
    void findNodes(std::uint32_t count, Lane* lanes) const;
    bool descend(Lane& lane) const;
    void step(Lane& lane) const;
    void addRecords(SurfaceShard& shard, std::uint32_t count, const Lane* lanes);
    std::uint32_t addRecord(SurfaceShard& shard, const Lane& lane);
    void addValues(SurfaceNode* node, const std::uint32_t* values, std::uint32_t mask, const SurfaceLayerLayout* layout);
    void divide(SurfaceShard& shard, SurfaceNode* node, const std::uint32_t* record);
    bool divide(SurfaceShard& shard, SurfaceRef& ref, std::uint32_t which);
    void divideBelow(SurfaceRef& ref, std::uint32_t face, std::uint32_t level, double inherited, double growth);
    template <typename Visit>
    void forEachRoot(Visit visit);
    void makeTable(SurfaceRef& ref);
    SurfaceRef* newTable(std::uint32_t levels);
    bool mayDivide(std::uint32_t face, std::uint32_t level) const;
    SurfaceRef* slotOf(std::uint32_t face) const;
    SurfaceRef* newSlot(SurfaceShard& shard, const std::uint32_t* record);
    SurfaceRef* newRoot(SurfaceShard& shard, std::uint32_t face);  ///< null beyond the budget
    SurfaceRef* binOf(std::uint32_t face);
    /// Zeros; null beyond the budget. \param alignment  a power of two up to 64
    std::byte* allocate(SurfaceArena& arena, std::size_t bytes, std::size_t alignment = alignof(SurfaceRef));
    /// Nodes, one after the other, and `more` bytes.
    SurfaceNode* allocateNodes(SurfaceArena& arena, std::size_t count, std::size_t more = 0);
    bool nextChunks(SurfaceArena& arena, std::size_t bytes);

    std::vector<SurfaceMeshView> meshes_;
    SurfaceOptions options_;
    std::vector<std::uint64_t> faceStarts_;
    std::uint64_t faceCount_ = 0;
    double minimumArea_ = 0;
    std::uint32_t pointsToDivide_ = 0;  ///< of a node; SurfaceNode::kFinal: none divides

    std::vector<LayerDescription> descriptions_;
    std::vector<SurfaceLayerLayout> layouts_;
    std::vector<std::uint16_t> maskWords_;
    std::size_t nodeBytes_ = 0, nodeAlignment_ = 0;
    std::uint32_t valueWords_ = 0;

    std::uint32_t pageBits_ = 0, runBits_ = 0, shardShift_ = 0, shardCount_ = 0, logRecords_ = 0;
    std::size_t blockBytes_ = 0, chunkBytes_ = 0, chunksPerSlab_ = 1, pageBytes_ = 0;
    std::uint64_t chunkCount_ = 0;
    bool storesFaces_ = true;  ///< false if the budget does not even hold a table of faces: bins only
    std::unique_ptr<SurfaceShard[]> shards_;
    SurfaceArena tables_;  ///< where tables come from, while no thread records
    std::array<std::vector<SurfaceRef*>, kMostTableLevels + 1> freeTables_;  ///< by their levels
    std::unique_ptr<Page*[]> pages_;        ///< 2^pageBits faces each; written by the owner of their shard
    std::unique_ptr<SurfaceRef[]> bins_;  ///< one per run of 2^runBits pages, for faces without storage
    std::unique_ptr<std::atomic<std::byte*>[]> slabs_;
    std::uint64_t slabCount_ = 0, runCount_ = 0;
    std::atomic<std::uint64_t> nextChunk_{0};
    std::atomic<std::uint64_t> bytesUsed_{0};
    std::mutex spilledMutex_;  // taken once in a thousand million samples
    std::unordered_map<const std::uint32_t*, std::uint64_t> spilled_;

    mutable std::mutex cursorsMutex_;  // threads come and go rarely
    std::vector<std::unique_ptr<SurfaceCursorImpl>> cursors_;
    std::vector<SurfaceCursorImpl*> idle_;
};

/// One thread's log, and its open blocks, one per shard.
struct SurfaceCursorImpl : SurfaceCursorState {
    explicit SurfaceCursorImpl(SurfaceStore& owner);
    ~SurfaceCursorImpl();

    void turn();
    /// Hands over all that is held back. Points located before take values as late ones do.
    void flush();
    bool isPlace(const SurfacePlace& at) const;

    std::atomic<SurfaceBlock*> returned{nullptr};  ///< blocks of ours that others have applied
    std::atomic<std::uint64_t> invalid{0};

  private:
    /// Where the next record of a shard goes.
    struct Open {
        std::uint32_t* next = nullptr;
        std::uint32_t* full = nullptr;  ///< from here on, there is no room for a record
        SurfaceBlock* block = nullptr;
    };
    std::uint32_t globalFace(std::uint32_t mesh, std::uint32_t face) const;
    std::uint32_t* half(std::uint32_t of) const { return log_.get() + std::size_t(of % 2) * halfWords_; }
    void distribute(std::uint32_t* record, const std::uint32_t* last);
    void findBarycentrics(std::uint32_t* record, const std::uint32_t* last) const;
    void closeBlock(std::uint32_t shard);  ///< and hand it over
    void replaceBlock(std::uint32_t shard);
    SurfaceBlock* newBlock();

    SurfaceStore& store_;
    const std::uint64_t* faceStarts_;  ///< per mesh, and the end
    std::uint32_t meshCount_;
    std::unique_ptr<std::uint32_t[]> log_;
    std::size_t halfWords_ = 0;
    bool otherHalf_ = false;        ///< is full
    std::vector<Open> open_;        ///< per shard
    SurfaceBlock* freeBlocks_ = nullptr;
    std::vector<SurfaceBlock*> blocks_;  ///< all of ours
};

/// Post-processing; see SurfaceRecorder::finish.
SurfaceField makeField(const SurfaceStore& store);

}  // namespace emca::detail
