#pragma once

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
    std::uint16_t maskWord = 0, valueWord = 0;
    std::uint8_t bit = 0, channels = 1;
};

/// What a thread has to say about one point, in words of 32 bits: the face of all faces, its surfacePath(), then for each
/// 32 layers (30 in the first) a mask that tells which values are there, and room for all values.
///
/// A position becomes a path only when its block is applied, where the loads of many triangles overlap: it stands in a
/// record of its own before the point's, whose face does not exist; the path of the point's is the mesh until then.
constexpr std::uint32_t kPlaceWords = 2;
constexpr std::uint32_t kNoFace = SurfaceCursorState::kNoFace;
/// Bits of the first mask.
constexpr std::uint32_t kNotCounted = 1, kFirstMaskFlags = 1;

/// Records for one shard, on their way from the thread that made them to whoever applies them.
struct SurfaceBlock {
    SurfaceBlock* next;       ///< in the shard's list of waiting blocks, or in the home's list of free ones
    SurfaceCursorImpl* home;  ///< where it returns when its records are applied
    std::uint32_t words;      ///< used
    bool hasPositions;
    std::uint32_t* data() { return reinterpret_cast<std::uint32_t*>(this + 1); }
};

/// A part of all faces that one thread at a time may change. Handing over is a stack that anybody pushes to and the owner
/// takes as a whole; whoever pushes and finds no owner becomes it. Each thread goes on at once in either case.
struct alignas(64) SurfaceShard {
    std::atomic<SurfaceBlock*> waiting{nullptr};
    std::atomic<bool> busy{false};
    // The rest is the owner's. Counters are read by counts(), hence atomic; only the owner writes them.
    std::byte* free = nullptr;     ///< of the chunk that new nodes come from
    std::byte* freeEnd = nullptr;
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

    std::uint32_t shardOf(std::uint32_t face) const { return common_.shardOf(face); }
    /// What cursors copy: how records are laid out and where they go.
    const SurfaceCursorState& cursorState() const { return common_; }
    /// Mesh that a global face belongs to.
    std::uint32_t meshOf(std::uint32_t face) const;
    /// World-space area of a face of the scene; 0 if it has none or a vertex is missing or not finite.
    double area(std::uint32_t mesh, std::uint32_t face) const;
    /// From a position to a path; that of the first vertex on a face that has no area.
    static std::uint32_t pathOf(const SurfaceMeshView& mesh, const Triangle& triangle, Vec3f position);

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
    std::uint32_t recordWords() const { return recordWords_; }
    const std::vector<std::uint16_t>& maskWords() const { return maskWords_; }  ///< of a record
    std::uint32_t shardCount() const { return shardCount_; }
    std::size_t blockBytes() const { return blockBytes_; }
    std::uint32_t blocksPerCursor() const { return 2 * shardCount_; }
    void addUsed(std::size_t bytes) { bytesUsed_.fetch_add(bytes, std::memory_order_relaxed); }

  private:
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
    void resolvePositions(SurfaceBlock& block) const;
    void prefetchFaces(const std::uint32_t* record, std::uint32_t count) const;
    void enter(SurfaceShard& shard, const std::uint32_t* record, std::uint32_t count, Lane* lanes);
    void descendAll(Lane* lanes, std::uint32_t count) const;
    void addRecord(SurfaceShard& shard, Lane& lane);
    void addValues(SurfaceNode* node, const std::uint32_t* record, std::uint32_t mask, const SurfaceLayerLayout* layout);
    void divide(SurfaceShard& shard, SurfaceNode* node, const std::uint32_t* record);
    bool divide(SurfaceShard& shard, SurfaceRef& ref, std::uint32_t which);
    void divideBelow(SurfaceRef& ref, std::uint32_t face, std::uint32_t level, double inherited, double growth);
    void makeTable(SurfaceShard& shard, SurfaceRef& ref);
    bool mayDivide(std::uint32_t face, std::uint32_t level) const;
    SurfaceRef* slotOf(std::uint32_t face) const;
    SurfaceRef* newRoot(SurfaceShard& shard, std::uint32_t face);  ///< null beyond the budget
    SurfaceRef* binOf(std::uint32_t face);
    /// Zeros; null beyond the budget. \param alignment  a power of two up to 64
    std::byte* allocate(SurfaceShard& shard, std::size_t bytes, std::size_t alignment = alignof(SurfaceRef));
    /// Nodes, one after the other, and `more` bytes.
    SurfaceNode* allocateNodes(SurfaceShard& shard, std::size_t count, std::size_t more = 0);
    bool nextChunk(SurfaceShard& shard);

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
    std::uint32_t recordWords_ = kPlaceWords;

    SurfaceCursorState common_;
    std::uint32_t pageBits_ = 0, runBits_ = 0, shardCount_ = 0;
    std::size_t blockBytes_ = 0, chunkBytes_ = 0, chunksPerSlab_ = 1, pageBytes_ = 0;
    std::uint64_t chunkCount_ = 0;
    bool storesFaces_ = true;  ///< false if the budget does not even hold a table of faces: bins only
    std::unique_ptr<SurfaceShard[]> shards_;
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

/// One thread's open blocks, one per shard.
struct SurfaceCursorImpl : SurfaceCursorState {
    explicit SurfaceCursorImpl(SurfaceStore& owner);
    ~SurfaceCursorImpl();

    void replaceBlock(std::uint32_t shard);
    void closeBlock(std::uint32_t shard);  ///< and hand it over
    std::uint32_t* appendPlace(const SurfacePlace& place, std::uint32_t shard);
    SurfaceBlock* newBlock();

    SurfaceStore& store;
    std::vector<Open> openRecords;
    std::vector<SurfaceBlock*> openBlocks;         ///< per shard, or null
    std::atomic<SurfaceBlock*> returned{nullptr};  ///< blocks of ours that others have applied
    SurfaceBlock* freeBlocks = nullptr;
    std::vector<SurfaceBlock*> blocks;             ///< all of ours
    std::atomic<std::uint64_t> invalid{0};
};

/// Post-processing; see SurfaceRecorder::finish.
SurfaceField makeField(const SurfaceStore& store);

}  // namespace emca::detail
