#include "emca/adapter/parametric_mesh.h"

#include <algorithm>

namespace emca::adapter {

namespace {

/// Which cell, and where in it. \param cells  along this parameter
struct CellPlace {
    std::uint32_t cell;
    float within;  ///< [0, 1]
};

CellPlace placeOf(float parameter, std::uint32_t cells) {
    const float scaled = parameter > 0 ? std::min(parameter, 1.f) * static_cast<float>(cells) : 0.f;  // NaN: 0
    const std::uint32_t cell = std::min(static_cast<std::uint32_t>(scaled), cells - 1);
    return {cell, scaled - static_cast<float>(cell)};
}

}  // namespace

Mesh ParametricMesh::mesh(const std::function<Vec3f(Vec2f uv)>& position) const {
    Mesh mesh;
    mesh.positions.reserve(std::size_t(columns + 1) * (rows + 1));
    mesh.triangles.reserve(faceCount());
    for (std::uint32_t row = 0; row <= rows; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column)
            mesh.positions.push_back(position({static_cast<float>(column) / static_cast<float>(columns), static_cast<float>(row) / static_cast<float>(rows)}));
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.triangles.push_back(flipped ? Triangle{a, c, b} : Triangle{a, b, c});
    };
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * (columns + 1) + column, d = a + columns + 1;
            if (row > 0 || !firstRowIsPoint) add(a, a + 1, d + 1);
            if (row + 1 < rows || !lastRowIsPoint) add(a, d + 1, d);
        }
    }
    return mesh;
}

std::int32_t ParametricMesh::face(Vec2f uv) const {
    const CellPlace u = placeOf(uv.x, columns), v = placeOf(uv.y, rows);
    const bool single = (v.cell == 0 && firstRowIsPoint) || (v.cell + 1 == rows && lastRowIsPoint);
    const std::uint32_t before = v.cell * 2 * columns - (firstRowIsPoint && v.cell > 0 ? columns : 0);
    return static_cast<std::int32_t>(single ? before + u.cell : before + 2 * u.cell + (v.within > u.within ? 1 : 0));
}

}  // namespace emca::adapter
