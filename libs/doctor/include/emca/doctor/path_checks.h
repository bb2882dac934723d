#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/path_set.h"
#include "emca/doctor/finding.h"

// Whether recorded paths are what a renderer meant to record. Each class takes the paths of any number of traces, one
// after the other, and then says what it found; none keeps them. Not thread-safe.
namespace emca::doctor {

/// Every recorded number finite? Counted by quantity.
class ValueCheck {
  public:
    void add(const PathSet& paths);
    /// Positions that are not finite cannot be drawn and fail; other values warn, as they may be the very fault that a
    /// person is after.
    Finding finding() const;

  private:
    struct Counts {
        std::uint64_t values = 0, nan = 0, infinite = 0;
        bool place = false;         ///< a position: where views draw something
        std::string example;        ///< "pixel (3, 4), path 7, depth 2"
        Pixel pixel;
    };
    void take(const std::string& quantity, bool place, std::span<const float> values, const PathSet& paths, Index owner, bool ofPath);
    void takeColumn(const PathSet& paths, const Column& column);
    std::map<std::string, Counts> counts_;
    std::uint64_t values_ = 0;
};

/// As many paths as samples, depths without gaps, nothing dropped.
class PathCheck {
  public:
    /// \param pixel     whose paths these are
    /// \param expected  samples of that pixel; 0: unknown
    void add(const PathSet& paths, Pixel pixel, std::uint64_t expected, const RecordingStats& stats);
    Finding finding() const;
    std::uint64_t paths() const { return paths_; }
    bool hasSplats() const { return splats_ > 0; }
    bool hasEstimates() const { return estimates_ > 0; }

  private:
    std::uint64_t pixels_ = 0, paths_ = 0, vertices_ = 0, splats_ = 0, estimates_ = 0;
    std::uint64_t pathsWithoutVertices_ = 0, verticesWithoutPosition_ = 0, gaps_ = 0;
    std::uint64_t fewer_ = 0, more_ = 0;
    std::string countExample_, gapExample_;
    std::vector<SuspectPixel> suspects_;
    RecordingStats dropped_;
};

/// Do vertices lie on the surfaces that setIntersectionSurface names?
class SurfaceCheck {
  public:
    /// \param meshes  must outlive this
    explicit SurfaceCheck(const std::vector<Mesh>& meshes);
    ~SurfaceCheck();
    void add(const PathSet& paths);
    Finding finding() const;

  private:
    class Curvature;
    struct Off { std::uint64_t count = 0; double distance = 0; std::string example; Pixel pixel; };
    void place(const PathSet& paths, Index vertex, PathSet::Surface surface, Vec3f position);
    static void note(Off& off, double distance, const PathSet& paths, Index vertex, std::string surface);
    const std::vector<Mesh>& meshes_;
    std::vector<double> sizes_;                            ///< diagonal of each mesh
    std::map<std::size_t, std::unique_ptr<Curvature>> curvatures_;
    double scene_ = 0;                                     ///< diagonal of everything
    std::uint64_t surfaces_ = 0, placed_ = 0;
    Off outOfRange_, curved_, slightly_, off_;
};

/// "pixel (3, 4), path 7, depth 2": where a recorded value is to be found again.
std::string placeName(const PathSet& paths, Index vertex);
std::string pathName(const PathSet& paths, Index path);

/// Whether two sets hold the same paths with the same final estimates, bit by bit, and as many vertices.
/// \return empty if so, else what is different, with an example
std::string differenceOf(const PathSet& a, const PathSet& b);

}  // namespace emca::doctor
