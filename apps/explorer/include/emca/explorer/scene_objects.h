#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emca/analysis/color_map.h"
#include "emca/core/mesh.h"
#include "emca/core/vector.h"

// What plugins add to the 3D view. Knows neither Qt nor VTK. Positions: world space, scene units.
namespace emca::explorer {

/// A box of any orientation: its middle and the three half edges, which need not be orthogonal.
struct ObjectBox {
    Vec3f centre;
    Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    static ObjectBox between(Vec3f min, Vec3f max) {
        const Vec3f half = (max - min) * 0.5f;
        return {(min + max) * 0.5f, {half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}};
    }
    friend bool operator==(const ObjectBox&, const ObjectBox&) = default;
};
/// Edges, and sides if `filled` is above 0.
struct BoxSet {
    std::vector<ObjectBox> boxes;
    float lineWidth = 1.5f;       ///< pixels
    float filled = 0.12f;         ///< opacity of the sides, in [0, 1]
};

struct ObjectArrow { Vec3f from, to; };
/// Lines with a head at their end; without heads they are plain lines.
struct ArrowSet {
    std::vector<ObjectArrow> arrows;
    float lineWidth = 2;          ///< pixels
    bool heads = true;
};

/// Round dots of one size on the screen.
struct PointSet {
    std::vector<Vec3f> points;
    float size = 6;               ///< diameter, pixels
};

/// A regular grid of cells with one value each (ObjectColors::values, x fastest, then y, then z). Cells whose value is
/// NaN or outside of `shown` are not drawn. What is drawn are the sides between a drawn cell and one that is not.
struct VoxelGrid {
    Vec3f origin;                                     ///< corner of the first cell
    Vec3f cell{1, 1, 1};                              ///< edges of a cell, each above 0
    std::array<std::uint32_t, 3> size{};              ///< number of cells along x, y, z
    double shownFrom = -std::numeric_limits<double>::infinity(), shownTo = std::numeric_limits<double>::infinity();
};

/// Triangles of any kind, flat.
struct TriangleSet {
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
};

/// Colours of an object's elements: of each one its own if `colors` has them, else by its value if `values` has them,
/// else one for all.
struct ObjectColors {
    analysis::Color8 color{154, 160, 255, 255};       ///< sRGB, with alpha
    std::vector<analysis::Color8> colors;             ///< empty or one per element
    std::vector<float> values;                        ///< empty or one per element
    analysis::ColorMapId map = analysis::ColorMapId::viridis;
    std::optional<analysis::ValueRange> range;        ///< nothing: from the smallest to the largest finite value
    std::string unit;                                 ///< of the values, for labels
};

/// One thing with a switch of its own. Its elements are boxes, arrows, points, cells or triangles.
///
/// Rules, checked by check(): `name` is not empty; `colors.colors`, `colors.values` and `labels` are empty or have one entry
/// per element (a grid needs values); indices of triangles lie inside the positions; edges of a grid's cells are
/// positive; at most kMaximumElements. Elements with a position that is not finite are left out of the picture.
struct SceneObject {
    std::string name;                  ///< for people, in the options of the 3D view
    std::string description;           ///< a sentence or two, for the tool tip; may be empty
    std::variant<BoxSet, ArrowSet, PointSet, VoxelGrid, TriangleSet> shape;
    ObjectColors colors;
    std::vector<std::string> labels;   ///< of the element under the cursor; empty: name, number and value
    float opacity = 1;                 ///< in [0, 1], of everything
    bool onTop = false;                ///< drawn through surfaces, as marks of vertices are

    static constexpr std::size_t kMaximumElements = 8u << 20;
    std::size_t elementCount() const;
};

}  // namespace emca::explorer
