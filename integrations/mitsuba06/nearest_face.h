#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emca/core/mesh.h"
#include "emca/core/vector.h"

namespace emca::mitsuba06 {

/// Finds the triangle of a mesh that is nearest to a point: for points of analytic shapes, whose tessellation lies
/// beside them, and for points on meshes of which a renderer does not say the triangle. A hierarchy of boxes;
/// immutable.
class NearestFace {
  public:
    NearestFace() = default;
    /// Vertices and triangles are copied; indices must be valid.
    explicit NearestFace(const Mesh& mesh);

    /// Index of the triangle, the lowest of those equally near; -1 if there is none or the point is not finite.
    std::int32_t find(Vec3f point) const;

  private:
    struct Box {
        Vec3f min, max;
        float squaredDistance(Vec3f point) const;
    };
    struct Corners {
        Vec3f a, b, c;
        float squaredDistance(Vec3f point) const;
    };
    /// Inner nodes have their left child behind them; leaves have `count` triangles from `first` on.
    struct Node {
        Box box;
        std::uint32_t first = 0;  ///< leaf: into order_; inner node: the right child
        std::uint32_t count = 0;  ///< 0: inner node
    };
    static Box boundsOf(const std::vector<Corners>& corners, std::span<const std::uint32_t> faces);
    void build(std::uint32_t first, std::uint32_t last);

    std::vector<Corners> corners_;      ///< per triangle
    std::vector<std::uint32_t> order_;  ///< triangles, as the leaves refer to them
    std::vector<Node> nodes_;
};

}  // namespace emca::mitsuba06
